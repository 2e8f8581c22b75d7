// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// On which surfaces may a feature without a depth lie?   The ones beside it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/depth/guarded_depth.hpp"

namespace stillpoint {

/// The nearest and the farthest surface beside a pixel, metres; both 0 where there is none.
struct SurroundingDepth {
  double nearest_m = 0, farthest_m = 0;

  static constexpr double kSupposedSpread = 0.1;  ///< standard deviation of a supposed inverse depth, as a share of it
  static constexpr double kBridgedSpread = 0.03;  ///< the same, where all that is beside it is one surface

  /// Whether both are one surface.
  template <class Noise>
  bool is_bridged(const Noise& noise) const {
    return farthest_m - nearest_m < DepthTolerance().at(noise.sigma(nearest_m));
  }
};

namespace detail {

/// Quicker than to ask for the depth: most of what is beside a feature without one is a hole, too.
inline bool is_hole(const DepthView& depth, int u, int v) noexcept {
  return depth.image.format == PixelFormat::depth16 && depth.image.row<std::uint16_t>(v)[u] == 0;
}

}  // namespace detail

/// Walks in eight directions to the first pixel with a depth each.
template <class Noise>
SurroundingDepth surrounding_depth(const FrameView& frame, const Vector2f& pixel, int reach_px,
                                   const GuardedDepth& guard, const Noise& noise) {
  constexpr int kStep_px = 2;
  constexpr float kDiagonal = 0.70710678f;
  constexpr std::array<std::array<float, 2>, 8> kDirections{{{1, 0},
                                                             {kDiagonal, kDiagonal},
                                                             {0, 1},
                                                             {-kDiagonal, kDiagonal},
                                                             {-1, 0},
                                                             {-kDiagonal, -kDiagonal},
                                                             {0, -1},
                                                             {kDiagonal, -kDiagonal}}};
  if (frame.depth.empty()) return {};
  SurroundingDepth found{std::numeric_limits<double>::infinity(), 0.0};
  const DepthScale to_depth(frame.gray, frame.depth.image);
  const Vector2f start = to_depth(pixel);
  for (const auto& [x, y] : kDirections) {
    const Vector2f direction(x * to_depth.x, y * to_depth.y);
    for (int distance = kStep_px; distance <= reach_px; distance += kStep_px) {
      const Vector2f at = start + static_cast<float>(distance) * direction;
      const bool is_inside = frame.depth.image.border_distance_px(at.x(), at.y()) >= 0.5f;  // so that it fits an int
      if (!is_inside || detail::is_hole(frame.depth, rounded(at.x()), rounded(at.y()))) continue;
      const double depth_m = guard.at(frame.depth, at, noise);
      if (!(depth_m > 0)) continue;
      found.nearest_m = std::min(found.nearest_m, depth_m);
      found.farthest_m = std::max(found.farthest_m, depth_m);
      break;
    }
  }
  return found.farthest_m > 0 ? found : SurroundingDepth{};
}

}  // namespace stillpoint
