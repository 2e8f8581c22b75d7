// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Depth that is trusted only where its neighbours agree.

#include <cstdint>
#include <limits>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// Depth at the rounded pixel, if its 3 × 3 neighbourhood is one surface: at a hole or a jump there is none, and
/// nothing is interpolated across an edge.
struct GuardedDepth {
  // No options in files.
  int fewest_neighbours = 6;         ///< of the nine pixels that must have a depth
  double jump_m = 0.03;              ///< more difference within the neighbourhood is an edge, at depth 0 …
  double jump_per_square_m = 0.011;  ///< … and this much more per square metre of depth: six Kinect sigmas

  /// @return metres, 0 where there is none.
  double at(const DepthView& depth, const Vector2f& pixel) const noexcept {
    // Also false for NaN, and for what is too far away for an int.
    if (!(depth.image.border_distance_px(pixel.x(), pixel.y()) >= 0.5f)) return 0.0;
    const int u = rounded(pixel.x()), v = rounded(pixel.y());
    if (u < 1 || v < 1 || u + 1 >= depth.image.width || v + 1 >= depth.image.height) return 0.0;
    return depth.image.format == PixelFormat::depth16 ? at<std::uint16_t>(depth, u, v) : at<float>(depth, u, v);
  }

  /// The same at a pixel of the gray image, whose depth image may have another size.
  double at(const FrameView& frame, const Vector2f& pixel) const noexcept {
    return frame.depth.empty() ? 0.0 : at(frame.depth, DepthScale(frame.gray, frame.depth.image)(pixel));
  }

 private:
  /// Compared in the units of the image: metres of the extremes alone.
  template <class Depth>
  double at(const DepthView& depth, int u, int v) const noexcept {
    const Depth centre = depth.image.row<Depth>(v)[u];
    if (!is_depth(centre)) return 0.0;
    int neighbours = 0;
    Depth nearest = centre, farthest = centre;
    for (int j = -1; j <= 1; ++j) {
      const Depth* const row = depth.image.row<Depth>(v + j) + u;
      for (int i = -1; i <= 1; ++i) {
        const bool counts = is_depth(row[i]);
        neighbours += counts;
        nearest = counts && row[i] < nearest ? row[i] : nearest;
        farthest = counts && row[i] > farthest ? row[i] : farthest;
      }
    }
    if (neighbours < fewest_neighbours) return 0.0;
    const auto centre_m = static_cast<double>(depth.metres(centre));
    const double difference_m =
        static_cast<double>(depth.metres(farthest)) - static_cast<double>(depth.metres(nearest));
    return difference_m <= jump_m + jump_per_square_m * centre_m * centre_m ? centre_m : 0.0;
  }

  static bool is_depth(std::uint16_t raw) noexcept { return raw > 0; }
  static bool is_depth(float raw_m) noexcept { return raw_m > 0.0f && raw_m < std::numeric_limits<float>::infinity(); }
};

}  // namespace stillpoint
