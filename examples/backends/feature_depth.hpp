// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The depth of a feature, where it has one that can be relied on.

#include <opencv2/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_lookup.hpp"

namespace examples {

/// Which depths a feature may have.
struct DepthLimits {
  double step = 0.03;       ///< neighbours that differ by this share of the depth are an edge: no depth
  double farthest_m = 6.0;  ///< depth beyond says little
};

/// Mean depth of 3x3 pixels of the depth image, 0 where one of them has none or lies on another surface.
/// @param pixel  of the frame's image; the depth image may be of another size
inline double depth_at(const stillpoint::FrameView& frame, const cv::Point2f& pixel, const DepthLimits& limits) {
  const stillpoint::DepthView& depth = frame.depth;
  const stillpoint::DepthScale to_depth(frame.image(), depth.image);
  const stillpoint::Vector2f depth_pixel = to_depth({pixel.x, pixel.y});
  const int u = cvRound(depth_pixel.x()), v = cvRound(depth_pixel.y());
  if (!depth.image.contains(u - 1, v - 1) || !depth.image.contains(u + 1, v + 1)) return 0.0;
  const double centre_m = depth.metres(u, v);
  if (!(centre_m > 0) || centre_m > limits.farthest_m) return 0.0;
  double sum_m = 0.0;
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const double depth_m = depth.metres(u + du, v + dv);
      if (!(depth_m > 0) || std::abs(depth_m - centre_m) > limits.step * centre_m) return 0.0;
      sum_m += depth_m;
    }
  return sum_m / 9.0;
}

/// How many of a frame's features have a depth.
template <class Frame>
std::size_t count_depths(const Frame& frame) {
  return static_cast<std::size_t>(
      std::count_if(frame.depth_m.begin(), frame.depth_m.end(), [](double depth_m) { return depth_m > 0; }));
}

}  // namespace examples
