// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the last frame knew of a place: weighted means over the remembered points around it, four points at a time.

#include <opencv2/core/hal/intrin.hpp>

#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// A feature or a surface cell of the last frame.
struct RememberedPoint {
  Vector2f pixel = Vector2f::Zero();
  float depth_m = 0;       ///< 0 none
  float log_odds = 0;      ///< of moving
  float suspicion = 0;     ///< 0 to 1
  bool is_feature = true;  ///< a surface cell has no log-odds
};

/// How the remembered points around a place are weighed.
struct NeighbourWeights {
  float reach_px = 25.0f;    ///< those within have a vote in the suspicion
  float feature_px = 15.0f;  ///< those within may be the same feature
};

/// The points of one frame, sorted for look-ups. Lives in the workspace.
class RememberedPoints {
 public:
  /// Weighted sums over what is near a place.
  struct Sums {
    float feature_weight = 0, log_odds = 0;
    float votes = 0, suspicion = 0;
  };

  RememberedPoints(span<const Vector2f> pixels, span<const RememberedPoint> points, const NeighbourWeights& weights,
                   Workspace& workspace)
      // Cells of half the reach: fewer points are visited that lie beyond it.
      : weights_(weights),
        grid_(pixels, 0.5f * weights.reach_px, workspace, [](std::size_t) { return true; }),
        x_(workspace.take<float>(padded())),
        y_(workspace.take<float>(padded())),
        depth_m_(workspace.take<float>(padded())),
        log_odds_(workspace.take<float>(padded())),
        suspicion_(workspace.take<float>(padded())),
        is_feature_(workspace.take<float>(padded())) {
    for (std::size_t rank = 0; rank < grid_.size(); ++rank) {
      const RememberedPoint& point = points[grid_.index(rank)];
      x_[rank] = point.pixel.x();
      y_[rank] = point.pixel.y();
      depth_m_[rank] = point.depth_m;
      log_odds_[rank] = point.log_odds;
      suspicion_[rank] = point.suspicion;
      is_feature_[rank] = point.is_feature ? 1.0f : 0.0f;
    }
  }

  /// @param depth_m      0 none
  /// @param tolerance_m  by which depths on its surface may differ
  Sums around(const Vector2f& pixel, float depth_m, float tolerance_m) const {
    using cv::v_float32x4;
    const auto all = [](float value) { return cv::v_setall_f32(value); };
    const v_float32x4 zero = all(0.0f), one = all(1.0f), x = all(pixel.x()), y = all(pixel.y()), depth = all(depth_m);
    const v_float32x4 per_reach = all(1.0f / (weights_.reach_px * weights_.reach_px)),
                      per_feature = all(1.0f / (weights_.feature_px * weights_.feature_px));
    const v_float32x4 tolerance = all(tolerance_m);
    // One with a depth, one without: perhaps the same surface. In the vote they only count where there are no others.
    const v_float32x4 other_kind = all(0.2f), vote_of_other_kind = all(0.02f);
    const v_float32x4 has_depth = depth > zero, lane(0.0f, 1.0f, 2.0f, 3.0f);
    v_float32x4 feature_weight = zero, log_odds = zero, votes = zero, suspicion = zero;
    grid_.runs_around(pixel, weights_.reach_px, [&](std::size_t first, std::size_t last) {
      for (std::size_t rank = first; rank < last; rank += 4) {
        const v_float32x4 taken = lane < all(static_cast<float>(last - rank));
        const v_float32x4 off_x = cv::v_load(&x_[rank]) - x, off_y = cv::v_load(&y_[rank]) - y;
        const v_float32x4 squared = off_x * off_x + off_y * off_y;
        const v_float32x4 their_depth = cv::v_load(&depth_m_[rank]);
        const v_float32x4 other = has_depth ^ (their_depth > zero);
        const v_float32x4 one_surface = cv::v_absdiff(depth, their_depth) <= tolerance;
        const v_float32x4 same = taken & (one_surface | other);
        const v_float32x4 vote =
            same & (cv::v_max(zero, one - squared * per_reach) * cv::v_select(other, vote_of_other_kind, one));
        votes += vote;
        suspicion += vote * cv::v_load(&suspicion_[rank]);
        const v_float32x4 near = cv::v_max(zero, one - squared * per_feature);
        const v_float32x4 weight =
            same & (near * near * cv::v_load(&is_feature_[rank]) * cv::v_select(other, other_kind, one));
        feature_weight += weight;
        log_odds += weight * cv::v_load(&log_odds_[rank]);
      }
    });
    return {cv::v_reduce_sum(feature_weight), cv::v_reduce_sum(log_odds), cv::v_reduce_sum(votes),
            cv::v_reduce_sum(suspicion)};
  }

 private:
  std::size_t padded() const noexcept { return grid_.size() + 3; }  // four are read from the last

  NeighbourWeights weights_;
  PixelGrid grid_;
  span<float> x_, y_, depth_m_, log_odds_, suspicion_, is_feature_;  // by rank
};

}  // namespace stillpoint
