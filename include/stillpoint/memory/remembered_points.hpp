// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the last frame knew of a place: weighted means over the remembered points around it, four points at a time.

#include <array>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/lanes.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// A feature or a surface cell of the last frame.
struct RememberedPoint {
  Vector2f pixel = Vector2f::Zero();
  float depth_m = 0;        ///< 0 none
  float log_odds = 0;       ///< of moving
  float dynamic_prior = 0;  ///< 0 to 1
  bool is_feature = true;   ///< a surface cell has no log-odds
  float certainty = 1;      ///< 0 to 1: how much is known of its dynamic prior; so much counts its vote
};

/// How the remembered points around a place are weighed.
struct NeighbourWeights {
  float reach_px = 25.0f;    ///< those within have a vote in the dynamic prior
  float feature_px = 15.0f;  ///< those within may be the same feature
};

/// The points of one frame, sorted for look-ups. Lives in the workspace.
class RememberedPoints {
 public:
  /// Weighted sums over what is near a place.
  struct Sums {
    float feature_weight = 0, log_odds = 0;
    float votes = 0, dynamic_prior = 0;  ///< by certainty
    float asked = 0;                     ///< what the votes would be if all were certain
  };

  RememberedPoints(span<const Vector2f> pixels, span<const RememberedPoint> points, const NeighbourWeights& weights,
                   Workspace& workspace)
      : weights_(weights),
        grid_(pixels, weights.reach_px / kCellsPerReach, workspace, [](std::size_t) { return true; }),
        x_(workspace.take<float>(padded())),
        y_(workspace.take<float>(padded())),
        depth_m_(workspace.take<float>(padded())),
        has_depth_(workspace.take<float>(padded())),
        log_odds_(workspace.take<float>(padded())),
        dynamic_prior_(workspace.take<float>(padded())),
        is_feature_(workspace.take<float>(padded())),
        certainty_(workspace.take<float>(padded())) {
    for (std::size_t rank = 0; rank < grid_.size(); ++rank) {
      const RememberedPoint& point = points[grid_.index(rank)];
      x_[rank] = point.pixel.x();
      y_[rank] = point.pixel.y();
      depth_m_[rank] = point.depth_m;
      has_depth_[rank] = point.depth_m > 0 ? 1.0f : 0.0f;
      log_odds_[rank] = point.log_odds;
      dynamic_prior_[rank] = point.dynamic_prior;
      is_feature_[rank] = point.is_feature ? 1.0f : 0.0f;
      certainty_[rank] = point.certainty;
    }
  }

  /// @param depth_m      0 none
  /// @param tolerance_m  by which depths on its surface may differ
  Sums around(const Vector2f& pixel, float depth_m, float tolerance_m) const {
    using Four = FloatLanes;
    const Four none = {}, all = none + 1.0f;
    const float per_reach = 1.0f / (weights_.reach_px * weights_.reach_px);
    const float per_feature = 1.0f / (weights_.feature_px * weights_.feature_px);
    // One with a depth, one without: perhaps the same surface. In the vote they only count where there are no others.
    constexpr float kOtherKind = 0.2f, kVoteOfOtherKind = 0.02f;
    const float has_depth = depth_m > 0 ? 1.0f : 0.0f;
    const Four lane = {0.0f, 1.0f, 2.0f, 3.0f};
    Four feature_weight = none, log_odds = none, votes = none, dynamic_prior = none, asked = none;
    // Runs first, sums later: compilers do not inline a visitor of this size, and then keep its sums in memory.
    std::array<Run, kMostRuns> runs;
    std::size_t count = 0;
    grid_.runs_around(pixel, weights_.reach_px, [&](std::size_t first, std::size_t last) {
      if (first < last) runs[count++] = {first, last};
    });
    for (std::size_t k = 0; k < count; ++k) {
      const Run run = runs[k];
      auto left = static_cast<float>(static_cast<int>(run.last - run.first));
      for (std::size_t rank = run.first; rank < run.last; rank += 4, left -= 4.0f) {
        const Four off_x = four(x_, rank) - pixel.x(), off_y = four(y_, rank) - pixel.y();
        const Four squared = off_x * off_x + off_y * off_y;
        const Four off_m = depth_m - four(depth_m_, rank);
        const auto alike = four(has_depth_, rank) == has_depth;
        const auto counts = (lane < left) & (~alike | ((off_m <= tolerance_m) & (off_m >= -tolerance_m)));
        const Four say =
            where(counts, larger(1.0f - squared * per_reach, none) * where(alike, all, kVoteOfOtherKind * all), none);
        const Four vote = say * four(certainty_, rank);
        asked += say;
        votes += vote;
        dynamic_prior += vote * four(dynamic_prior_, rank);
        const Four near = larger(1.0f - squared * per_feature, none);
        const Four kind = where(alike, all, kOtherKind * all);
        const Four weight = where(counts, near * near * four(is_feature_, rank) * kind, none);
        feature_weight += weight;
        log_odds += weight * four(log_odds_, rank);
      }
    }
    return {sum_of(feature_weight), sum_of(log_odds), sum_of(votes), sum_of(dynamic_prior), sum_of(asked)};
  }

 private:
  struct Run {
    std::size_t first, last;
  };
  static constexpr float kCellsPerReach = 2;  // small cells: fewer points are visited that lie beyond it
  // A circle touches 2 · 2 + 1 rows of cells, and one more by rounding.
  static constexpr std::size_t kMostRuns = 2 * static_cast<std::size_t>(kCellsPerReach) + 2;

  static FloatLanes four(span<float> values, std::size_t first) noexcept { return float_lanes(&values[first]); }
  std::size_t padded() const noexcept { return grid_.size() + 3; }  // four are read from the last

  NeighbourWeights weights_;
  PixelGrid grid_;
  span<float> x_, y_, depth_m_, has_depth_, log_odds_, dynamic_prior_, is_feature_, certainty_;  // by rank
};

}  // namespace stillpoint
