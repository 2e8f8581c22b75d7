// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Painting masks: gray8 images in which 255 keeps and 0 drops, and nothing lies between.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

inline constexpr std::uint8_t kMaskKeeps = 255, kMaskDrops = 0;

/// Makes a mask of this size that keeps everything. Its memory is reused.
inline void keep_everywhere(int width, int height, ImageBuffer& mask) {
  mask.resize(width, height, PixelFormat::gray8);
  for (int v = 0; v < height; ++v) std::fill_n(mask.row<std::uint8_t>(v), width, kMaskKeeps);
}

/// Drops the pixels within `radius_px` of a point, which may lie outside of the mask. A point that is not finite drops
/// nothing.
inline void drop_disc(const Vector2f& centre, int radius_px, ImageBuffer& mask) {
  const ImageView view = mask.view();
  if (!(view.border_distance_px(centre.x(), centre.y()) >= -1.0f - static_cast<float>(radius_px))) return;
  const double radius_sq_px = static_cast<double>(radius_px) * radius_px;
  const int u0 = static_cast<int>(std::lround(centre.x())), v0 = static_cast<int>(std::lround(centre.y()));
  for (int v = std::max(v0 - radius_px, 0); v <= std::min(v0 + radius_px, view.height - 1); ++v) {
    const int half = static_cast<int>(std::sqrt(radius_sq_px - static_cast<double>(v - v0) * (v - v0)));
    const int begin = std::max(u0 - half, 0), end = std::min(u0 + half + 1, view.width);
    if (begin < end) std::fill(mask.row<std::uint8_t>(v) + begin, mask.row<std::uint8_t>(v) + end, kMaskDrops);
  }
}

}  // namespace stillpoint
