// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What one stage needs of another, and what it provides. A stage says so by two member types:
//
//   using Needs = Capabilities<capability::past_observations, capability::metric_depth>;
//   using Provides = Capabilities<capability::log_likelihoods>;
//
// A set in which a need is not met does not compile (pipeline/stage_fit.hpp). A stage without `Needs` needs nothing;
// one without `Provides`, as one of a host's own, is taken at its word: it provides everything.

#include <type_traits>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

namespace capability {

struct metric_depth {};       ///< of a depth lookup: features have depths in metres
struct whole_boxes {};        ///< of a prior: a region is all of its box, not only what is as deep as its middle
struct matches {};            ///< of a matcher: features or corners of its own, found in the reference frame
struct feature_matches {};    ///< of a matcher: the host's features, found in the reference frame
struct past_observations {};  ///< of a matcher: the host's features, looked for in older frames
struct metric_motion {};      ///< of an ego-motion: its translation is in metres
struct subpixel_motion {};    ///< of an ego-motion: it says to a fraction of a pixel where static points are seen
struct log_likelihoods {};    ///< of a scorer: scores are in nats
struct tail_threshold {};     ///< of a gate: the level that static features exceed at a rate, in nats
struct log_odds {};           ///< of a classifier: labels have log-odds, a memory decides
struct verdicts {};           ///< of a classifier: labels are decided

}  // namespace capability

template <class... Tags>
struct Capabilities {
  template <class Tag>
  static constexpr bool contain = (std::is_same_v<Tag, Tags> || ...);
};

template <class Stage, class Tag, class = void>
struct needs : std::false_type {};
template <class Stage, class Tag>
struct needs<Stage, Tag, std::void_t<typename Stage::Needs>> : std::bool_constant<Stage::Needs::template contain<Tag>> {
};

template <class Stage, class Tag, class = void>
struct provides : std::true_type {};
template <class Stage, class Tag>
struct provides<Stage, Tag, std::void_t<typename Stage::Provides>>
    : std::bool_constant<Stage::Provides::template contain<Tag>> {};

/// Does `Providing` give `Needing` what it needs, as far as `Tag` goes?
template <class Needing, class Providing, class Tag>
inline constexpr bool meets = !needs<Needing, Tag>::value || provides<Providing, Tag>::value;

}  // namespace stillpoint
