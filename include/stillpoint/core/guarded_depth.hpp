// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Depth that is trusted only where its neighbours agree.

#include <algorithm>
#include <cmath>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// Depth at the rounded pixel, if its 3 × 3 neighbourhood is one surface: at a hole or a jump there is none, and
/// nothing is interpolated across an edge.
struct GuardedDepth {
  struct Options {
    int fewest_neighbours = 6;         ///< of the nine pixels that must have a depth
    double jump_m = 0.03;              ///< more difference within the neighbourhood is an edge, at depth 0 …
    double jump_per_square_m = 0.011;  ///< … and this much more per square metre of depth: six Kinect sigmas
  };
  Options options;

  /// @return metres, 0 where there is none.
  double at(const DepthView& depth, const Vector2f& pixel) const noexcept {
    // Also false for NaN, and for what is too far away for lround.
    if (!(depth.image.border_distance_px(pixel.x(), pixel.y()) >= 0.5f)) return 0.0;
    const auto u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (u < 1 || v < 1 || u + 1 >= depth.image.width || v + 1 >= depth.image.height) return 0.0;
    const auto centre = static_cast<double>(depth.metres(u, v));
    if (!(centre > 0)) return 0.0;
    int neighbours = 0;
    double nearest = centre, farthest = centre;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const auto there = static_cast<double>(depth.metres(u + i, v + j));
        if (!(there > 0)) continue;
        ++neighbours;
        nearest = std::min(nearest, there);
        farthest = std::max(farthest, there);
      }
    }
    const bool one_surface = farthest - nearest <= options.jump_m + options.jump_per_square_m * centre * centre;
    return neighbours >= options.fewest_neighbours && one_surface ? centre : 0.0;
  }

  /// The same at a pixel of the gray image, whose depth image may have another size.
  double at(const FrameView& frame, const Vector2f& pixel) const noexcept {
    return frame.depth.empty() ? 0.0 : at(frame.depth, DepthScale(frame.gray, frame.depth.image)(pixel));
  }
};

}  // namespace stillpoint
