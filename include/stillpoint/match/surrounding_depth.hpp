// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// On which surfaces may a feature without a depth lie?   The ones beside it.

#include <algorithm>
#include <array>
#include <limits>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/guarded_depth.hpp"

namespace stillpoint {

/// The nearest and the farthest surface beside a pixel, metres; both 0 where there is none.
struct SurroundingDepth {
  double nearest_m = 0, farthest_m = 0;
};

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
  SurroundingDepth found{std::numeric_limits<double>::infinity(), 0.0};
  if (frame.depth.empty()) return SurroundingDepth{};
  const DepthScale to_depth(frame.gray, frame.depth.image);
  for (const auto& [x, y] : kDirections) {
    for (int distance = kStep_px; distance <= reach_px; distance += kStep_px) {
      const Vector2f beside = pixel + static_cast<float>(distance) * Vector2f(x, y);
      const double depth_m = guard.at(frame.depth, to_depth(beside), noise);
      if (!(depth_m > 0)) continue;
      found.nearest_m = std::min(found.nearest_m, depth_m);
      found.farthest_m = std::max(found.farthest_m, depth_m);
      break;
    }
  }
  return found.farthest_m > 0 ? found : SurroundingDepth{};
}

}  // namespace stillpoint
