// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The answer for hosts that take depth and no mask: a depth image with holes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/mask.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {
/// A copy of the depth image with 0, no depth, where the mask drops: for hosts that take depth and no mask.
/// @param depth   16 bit or float, of any size with the mask's field of view
/// @param mask    gray8, 255 keeps, 0 drops; an empty one drops nothing
/// @param masked  becomes an image of the depth's size and format
/// @throws Error if the mask is of another format.
inline void masked_depth(const DepthView& depth, const ImageView& mask, ImageBuffer& masked) {
  masked.assign(depth.image);
  if (mask.empty() || depth.empty()) return;
  require_mask("masked_depth", mask);
  const DepthScale to_mask(depth.image, mask);  // the same map the other way round
  const std::size_t bytes = bytes_per_pixel(depth.image.format);
  for (int v = 0; v < depth.image.height; ++v) {
    std::uint8_t* const row = masked.row<std::uint8_t>(v);
    for (int u = 0; u < depth.image.width; ++u) {
      const Vector2f pixel = to_mask(Vector2f(static_cast<float>(u), static_cast<float>(v)));
      const int mu = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, mask.width - 1);
      const int mv = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, mask.height - 1);
      if (mask.row<std::uint8_t>(mv)[mu] == 0) std::memset(row + static_cast<std::size_t>(u) * bytes, 0, bytes);
    }
  }
}

}  // namespace stillpoint
