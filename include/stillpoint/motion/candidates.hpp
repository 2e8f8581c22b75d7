// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which matches may tell how the camera moved?   The paper, section 3.3.

#include <cstddef>
#include <cstdint>

#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

struct CandidateOptions {
  float region_margin_px = 5.0f;  ///< nearer to a region's outline a feature stays out (the paper names no figure)
  std::size_t enough = 8;         ///< with fewer, features of dynamic regions join (the paper, 3.3)
};

/// The matches that take part in ego-motion: matched (not near the image border), with finite pixels, outside dynamic
/// regions and not near a region's outline. If they are fewer than `enough`, those inside a dynamic region and in no
/// fixed one join; a feature in both stays out always.
/// @param eligible  `bool(std::size_t feature)`, a further condition on each
/// @param workspace holds the answer
/// @return          indices of features, ascending
template <class Eligible>
span<const std::uint32_t> select_candidates(const Matches& matches, const Regions& regions,
                                            const CandidateOptions& options, Workspace& workspace,
                                            const Eligible& eligible) {
  const auto may_take_part = [&](std::size_t i, bool with_dynamic) {
    if (matches.state[i] != MatchState::matched || !eligible(i)) return false;
    if (!matches.current.undistorted[i].allFinite() || !matches.reference.undistorted[i].allFinite()) return false;
    if (i >= regions.of_feature.size()) return true;  // no prior: nothing is known to move
    const Membership& region = regions.of_feature[i];
    if (!(region.edge_distance_px >= options.region_margin_px)) return false;
    return !region.in_dynamic || (with_dynamic && !region.in_fixed);
  };
  const span<std::uint32_t> candidates = workspace.take<std::uint32_t>(matches.size());
  std::size_t count = 0;
  for (const bool with_dynamic : {false, true}) {
    count = 0;
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (may_take_part(i, with_dynamic)) candidates[count++] = static_cast<std::uint32_t>(i);
    if (count >= options.enough) break;
  }
  return {candidates.data(), count};
}

template <class Visit>
void each_option(CandidateOptions& candidates, Visit& visit) {
  visit("region_margin_px", candidates.region_margin_px, OptionRange{0, 1000});
  visit("enough", candidates.enough, OptionRange{0, 1e6});
}

}  // namespace stillpoint
