// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Masks: gray8 images in which 255 keeps and 0 drops, and nothing lies between.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

inline constexpr std::uint8_t kMaskKeeps = 255, kMaskDrops = 0;

/// @param user  begins the message
/// @param mask  what is looked at
/// @throws Error unless the mask is gray8
inline void require_mask(const char* user, const ImageView& mask) {
  if (mask.empty() || mask.format != PixelFormat::gray8)
    throw Error(std::string(user) + ": the mask is " + (mask.empty() ? "empty" : "no gray8 image") +
                ", expected gray8, one byte per pixel");
}

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
  // In double: neither the radius nor the place of a far centre need fit into an int once they are added.
  const double radius = radius_px;
  const double u0 = std::round(static_cast<double>(centre.x())), v0 = std::round(static_cast<double>(centre.y()));
  const int first = static_cast<int>(std::max(v0 - radius, 0.0));
  const int last = static_cast<int>(std::min(v0 + radius, view.height - 1.0));
  for (int v = first; v <= last; ++v) {
    const double half = std::floor(std::sqrt(std::max(radius * radius - (v - v0) * (v - v0), 0.0)));
    const int begin = static_cast<int>(std::clamp(u0 - half, 0.0, static_cast<double>(view.width)));
    const int end = static_cast<int>(std::clamp(u0 + half + 1, 0.0, static_cast<double>(view.width)));
    if (begin < end) std::fill(mask.row<std::uint8_t>(v) + begin, mask.row<std::uint8_t>(v) + end, kMaskDrops);
  }
}

}  // namespace stillpoint
