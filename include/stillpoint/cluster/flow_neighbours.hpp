// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features move together, when there is no depth?   Neighbours that go the same way share their evidence.

#include <algorithm>
#include <cstddef>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Gives every feature the log-odds of this frame: its own evidence and its neighbours', minus the threshold, and what
/// the regions say of its place. A feature without a match takes its neighbours' alone.
class FlowNeighbours {
 public:
  using Needs = Capabilities<capability::log_likelihoods, capability::tail_threshold>;
  using Provides = Capabilities<capability::log_odds>;

  struct Options {
    float reach_px = 30.0f;        ///< how far neighbours are
    float same_flow_px = 1.5f;     ///< steps since the reference frame that differ less are one motion …
    float same_flow_share = 0.1f;  ///< … and by this share of their length more
    float own_share = 0.4f;        ///< of a feature's own evidence in its log-odds; the rest is the neighbours' mean
    float lowest = -0.5f;          ///< a single score is held above this, nats
    float alone = -1.0f;           ///< log-odds of a feature that knows nothing and has no neighbours
    float dynamic_shift = 1.5f;    ///< what lies in a dynamic region; the background seen there as well
    float outside_shift = -1.0f;   ///< what lies in none, also where there is no detector: flow alone errs
    float movable_shift = 0.2f;
    float fixed_shift = -0.3f;
  };
  Options options;

  void classify(const Observations& observations, const Evidence& evidence, span<Label> labels,
                Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const Regions& regions = observations.regions;
    const span<const FeatureScore> scores = evidence.scores;
    const Workspace::Scope scope(workspace);
    const PixelGrid grid(matches.current.pixel, options.reach_px, workspace,
                         [&](std::size_t i) { return scores[i].scored(); });
    for (std::size_t i = 0; i < matches.size(); ++i) {
      Label& label = labels[i];
      const Vote vote = neighbours(matches, scores, grid, i);
      label.reason = scores[i].scored()                        ? Reason::consistent
                     : matches.state[i] == MatchState::outside ? Reason::outside_image
                     : vote.weight > 0                         ? Reason::neighbours
                                                               : Reason::no_match;
      if (!scores[i].scored() && !(vote.weight > 0)) {
        label.log_odds = options.alone;
        continue;
      }
      const float others = vote.weight > 0 ? vote.sum / vote.weight : clamped(scores[i]);
      const float own = scores[i].scored() ? clamped(scores[i]) : others;
      const Membership& region = regions.of_feature[i];
      label.log_odds = options.own_share * own + (1 - options.own_share) * others -
                       static_cast<float>(evidence.threshold.level) +
                       (region.in_dynamic   ? options.dynamic_shift
                        : region.in_movable ? options.movable_shift
                        : region.in_fixed   ? options.fixed_shift
                                            : options.outside_shift);
    }
  }

 private:
  struct Vote {
    float weight = 0, sum = 0;
  };

  float clamped(const FeatureScore& score) const noexcept { return std::max(score.value, options.lowest); }

  Vote neighbours(const Matches& matches, span<const FeatureScore> scores, const PixelGrid& grid, std::size_t i) const {
    const auto step = [&matches](std::size_t k) -> Vector2f {
      return matches.current.pixel[k] - matches.reference.pixel[k];
    };
    const bool has_step = matches.matched(i);
    const Vector2f own = has_step ? step(i) : Vector2f::Zero();
    const float limit_px = options.same_flow_px + options.same_flow_share * own.norm();
    Vote vote;
    grid.within(matches.current.pixel[i], options.reach_px, [&](std::size_t j, float squared) {
      if (j == i || (has_step && !((step(j) - own).squaredNorm() <= limit_px * limit_px))) return;
      const float near = 1 - squared / (options.reach_px * options.reach_px);
      vote.weight += near;
      vote.sum += near * clamped(scores[j]);
    });
    return vote;
  }
};

template <class Visit>
void each_option(FlowNeighbours& stage, Visit& visit) {
  visit("reach_px", stage.options.reach_px, OptionRange{1, 500});
  visit("same_flow_px", stage.options.same_flow_px, OptionRange{0, 100});
  visit("same_flow_share", stage.options.same_flow_share, OptionRange{0, 10});
  visit("own_share", stage.options.own_share, OptionRange{0, 1});
  visit("lowest", stage.options.lowest, OptionRange{-100, 100});
  visit("alone", stage.options.alone, OptionRange{-100, 100});
  visit("dynamic_shift", stage.options.dynamic_shift, OptionRange{-100, 100});
  visit("outside_shift", stage.options.outside_shift, OptionRange{-100, 100});
  visit("movable_shift", stage.options.movable_shift, OptionRange{-100, 100});
  visit("fixed_shift", stage.options.fixed_shift, OptionRange{-100, 100});
}

}  // namespace stillpoint
