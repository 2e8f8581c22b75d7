// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where depth jumps from one surface to another the image mostly changes, too: how the two lie on each other shows
// there.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "stillpoint/core/frame.hpp"

namespace stillpoint {

constexpr int kDepthJumpReach_px = 4;  ///< of the depth image: what is compared lies so far apart

/// Finds jumps of a tenth of the depth along a row.
/// @param rows   how many rows are looked at, evenly spread
/// @param visit  called with (int u, int v, float nearer_m): the pixel of the depth image in the middle of what was
///               compared, and the depth of the nearer side, metres
template <class Visit>
void for_each_depth_jump(const DepthView& depth, int rows, Visit&& visit) {
  constexpr float kJump = 0.1f;
  const int width = depth.image.width, height = depth.image.height;
  const int stride_px = std::max(height / rows, 1);
  for (int v = stride_px / 2; v < height; v += stride_px) {
    float before_m = depth.metres(0, v);
    for (int u = kDepthJumpReach_px; u < width; u += kDepthJumpReach_px) {
      const float here_m = depth.metres(u, v);
      const float nearer_m = std::min(before_m, here_m);
      if (nearer_m > 0 && std::abs(here_m - before_m) > kJump * nearer_m)
        visit(u - kDepthJumpReach_px / 2, v, nearer_m);
      before_m = here_m;
    }
  }
}

/// Where depth changes most within a jump, half way between two pixels of a row. A hole there counts as the farther
/// side: what the sensor can't see is behind the nearer surface, which ends where the hole begins.
/// @param u  in the middle of what was compared
inline float depth_jump_at(const DepthView& depth, int u, int v) noexcept {
  constexpr int kHalf_px = kDepthJumpReach_px / 2;
  const float farther_m = std::max(depth.metres(u - kHalf_px, v), depth.metres(u + kHalf_px, v));
  const auto depth_or_farther_m = [&](int x) {
    const float there_m = depth.metres(x, v);
    return there_m > 0.0f ? there_m : farther_m;
  };
  float greatest_m = -1.0f, before_m = depth_or_farther_m(u - kHalf_px);
  int right = u;
  for (int x = u - kHalf_px + 1; x <= u + kHalf_px; ++x) {
    const float here_m = depth_or_farther_m(x), step_m = std::abs(here_m - before_m);
    before_m = here_m;
    if (step_m <= greatest_m) continue;
    greatest_m = step_m;
    right = x;
  }
  return static_cast<float>(right) - 0.5f;
}

/// How much a gray image changes along its row, from `reach_px` left of a pixel to as far on its right; gray levels. A
/// pixel outside is the nearest inside.
inline int gray_step(const ImageView& gray, int x, int y, int reach_px) noexcept {
  const std::uint8_t* const row = gray.row<std::uint8_t>(std::clamp(y, 0, gray.height - 1));
  const int left = std::clamp(x - reach_px, 0, gray.width - 1), right = std::clamp(x + reach_px, 0, gray.width - 1);
  return std::abs(static_cast<int>(row[right]) - static_cast<int>(row[left]));
}

}  // namespace stillpoint
