// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What did we know of this feature, and of this place?   Two memories, from frame to frame.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Log-odds add up over frames and forget; they give the verdicts. Suspicion is sticky, inherited by new features whose
/// neighbours on the same surface are suspect by majority, and only lowers the say in the ego-motion: what moved once
/// and stands still now will drag the pose when it starts again. Surface cells hand it on too, where there is no
/// corner: a sleeve that comes into view belongs to the man whose collar was seen moving. If suspicion drove verdicts,
/// false alarms would spread from surface to surface.
class EvidenceMemory {
 public:
  struct Options {
    float persistence = 0.7f;     ///< share of the log-odds that is left after a frame
    float most_log_odds = 3.0f;   ///< log-odds are held within ± this
    float drop_above = 0.0f;      ///< a feature is dynamic above this …
    float keep_below = -2.0f;     ///< … and stands still again below this, if it was dynamic before
    float suspect_above = 1.0f;   ///< log-odds that make a feature suspect
    float suspicion_gain = 0.4f;  ///< what a frame adds: a flicker at a silhouette leaves no lasting suspicion
    float suspicion_persistence = 0.995f;
    float restlessness = 0.6f;   ///< share of the lower bound that full suspicion takes away: it will move again
    float least_trust = 0.01f;   ///< say of a feature of full suspicion
    float feature_px = 15.0f;    ///< how far a feature may have moved and still be recognised
    float neighbour_px = 25.0f;  ///< neighbours that hand suspicion on
    float minority = 0.25f;      ///< share of suspect neighbours below which none is handed on; above 1 − this, all
    double surface_m = 0.06;     ///< depths that differ less are one surface …
    double surface_per_square_m = 0.0076;  ///< … and this much more per square metre of depth
  };
  Options options;

  /// Looks every feature and surface cell up in what is remembered, and fills their trust and log-odds.
  void recall(Matches& matches, Workspace& workspace) {
    recalled_.assign(matches.size(), Memory{});
    recalled_of_cell_.assign(matches.sightings.surfaces.size(), Memory{});
    if (pixel_.empty()) return;
    const Workspace::Scope scope(workspace);
    // Cells of half the reach: fewer points are visited that lie beyond it.
    const PixelGrid grid(pixel_, 0.5f * options.neighbour_px, workspace, [](std::size_t) { return true; });
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Vector2f pixel = matches.matched(i) ? matches.reference.pixel[i] : matches.current.pixel[i];
      recalled_[i] = look_up(grid, pixel, matches.current.depth_m[i]);
      matches.trust[i] = trust(recalled_[i].suspicion);
      matches.recalled_log_odds[i] = recalled_[i].log_odds;
    }
    for (std::size_t s = 0; s < recalled_of_cell_.size(); ++s) {
      SurfaceCell& cell = matches.sightings.surfaces[s];
      recalled_of_cell_[s] = look_up(grid, cell.pixel, cell.point.z());
      cell.trust = trust(recalled_of_cell_[s].suspicion);
    }
  }

  /// Adds this frame's log-odds to what is remembered, and decides.
  void update(const Matches& matches, const Motion&, span<const FeatureScore>, span<Label> labels, Workspace&) {
    pixel_ = matches.current.pixel;
    depth_m_ = matches.current.depth_m;
    memory_.resize(matches.size());
    feature_count_ = matches.size();
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Memory before = recalled_[i];
      Label& label = labels[i];
      const float now = label.log_odds;
      const float least = -options.most_log_odds * (1.0f - options.restlessness * before.suspicion);
      label.log_odds = std::clamp(options.persistence * before.log_odds + now, least, options.most_log_odds);
      label.trust = matches.trust[i];
      decide(label, now, before.log_odds > options.drop_above);
      memory_[i].log_odds = label.log_odds;
      memory_[i].suspicion = before.suspicion;
      if (label.log_odds > options.suspect_above)
        memory_[i].suspicion += options.suspicion_gain * (1.0f - before.suspicion);
    }
    for (std::size_t s = 0; s < recalled_of_cell_.size(); ++s) {
      const SurfaceCell& cell = matches.sightings.surfaces[s];
      pixel_.push_back(cell.pixel);
      depth_m_.push_back(cell.point.z());
      memory_.push_back(recalled_of_cell_[s]);
    }
  }

  void reset() noexcept {
    pixel_.clear();
    depth_m_.clear();
    memory_.clear();
    recalled_.clear();
    recalled_of_cell_.clear();
  }

 private:
  struct Memory {
    float log_odds = 0;
    float suspicion = 0;  ///< 0 to 1
  };

  float trust(float suspicion) const noexcept { return 1.0f - (1.0f - options.least_trust) * suspicion; }

  Memory look_up(const PixelGrid& grid, const Vector2f& pixel, double depth_m) const {
    const double tolerance_m = options.surface_m + options.surface_per_square_m * depth_m * depth_m;
    const float feature_sq = options.feature_px * options.feature_px,
                reach_sq = options.neighbour_px * options.neighbour_px;
    float feature_weight = 0, log_odds = 0, votes = 0, suspicion = 0;
    grid.within(pixel, options.neighbour_px, [&](std::size_t j, float squared) {
      const bool both = depth_m > 0 && depth_m_[j] > 0;
      if (both && std::abs(depth_m - depth_m_[j]) > tolerance_m) return;
      const bool same_kind = (depth_m > 0) == (depth_m_[j] > 0);
      // One with a depth, one without: perhaps the same surface. In the vote they only count where there are no others.
      constexpr float kOtherKind = 0.2f, kVoteOfOtherKind = 0.02f;
      const float vote = (1 - squared / reach_sq) * (same_kind ? 1.0f : kVoteOfOtherKind);
      votes += vote;
      suspicion += vote * memory_[j].suspicion;
      if (j >= feature_count_ || !(squared < feature_sq)) return;
      const float same = (1 - squared / feature_sq) * (1 - squared / feature_sq) * (same_kind ? 1.0f : kOtherKind);
      feature_weight += same;
      log_odds += same * memory_[j].log_odds;
    });
    Memory memory;
    if (feature_weight > 0) memory.log_odds = log_odds / feature_weight;
    if (votes > 0) {
      const float majority = (suspicion / votes - options.minority) / (1 - 2 * options.minority);
      memory.suspicion = options.suspicion_persistence * std::clamp(majority, 0.0f, 1.0f);
    }
    return memory;
  }

  void decide(Label& label, float now, bool was_dynamic) const noexcept {
    const bool dynamic = label.log_odds > (was_dynamic ? options.keep_below : options.drop_above);
    label.keep = !dynamic;
    label.probability = 1.0f / (1.0f + std::exp(-label.log_odds));
    const bool knows = label.reason == Reason::consistent || label.reason == Reason::neighbours;
    label.verdict = dynamic ? Verdict::dynamic : knows ? Verdict::kept : Verdict::unknown;
    if (!dynamic) return;
    if (!(now > 0))
      label.reason = Reason::remembered;
    else
      label.reason = label.reason == Reason::consistent ? Reason::inconsistent : Reason::neighbours;
  }

  // Of the last frame, its features before its surface cells.
  std::vector<Vector2f> pixel_;
  std::vector<double> depth_m_;
  std::vector<Memory> memory_;
  std::size_t feature_count_ = 0;
  std::vector<Memory> recalled_, recalled_of_cell_;
};

}  // namespace stillpoint
