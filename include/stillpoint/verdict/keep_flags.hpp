// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From weights or a mask to one flag per feature, the form of `FrameResult::keep()`.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/mask.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {
/// One byte per feature, as `FrameResult::keep`: 1 where the weight is at least `least`. NaN drops.
inline void flags_from_weights(span<const float> weights, std::vector<std::uint8_t>& keep, float least = 0.5f) {
  keep.resize(weights.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = weights[i] >= least ? 1 : 0;
}

/// Is the mask at the rounded pixel 0? What lies outside of the mask, and NaN, is not dropped.
/// @param mask   gray8, 255 keeps, 0 drops; an empty one drops nothing
/// @param pixel  of the mask
inline bool mask_drops(const ImageView& mask, const Vector2f& pixel) noexcept {
  if (!(mask.border_distance_px(pixel.x(), pixel.y()) >= -0.5f)) return false;  // NaN too
  const auto u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  return mask.contains(u, v) && mask.row<std::uint8_t>(v)[u] == 0;
}

/// One byte per feature: 1 where the mask at its rounded pixel is not 0. What lies outside of the mask is kept.
/// @param mask  gray8, 255 keeps, 0 drops; an empty one drops nothing
/// @throws Error if the mask is of another format.
inline void flags_from_mask(const ImageView& mask, span<const Vector2f> pixels, std::vector<std::uint8_t>& keep) {
  if (!mask.empty()) require_mask("flags_from_mask", mask);
  keep.resize(pixels.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = mask_drops(mask, pixels[i]) ? 0 : 1;
}

}  // namespace stillpoint
