// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The answer in the form that a host takes: flags a feature, weights a feature, a mask over the image, a depth image
// with holes.   `FrameResult` gives flags and mask; here are the other two, and what leads from one to another.
//
//   keep() ──────────────► mask() ──────────► masked_depth()
//      │  ▲                  │
//      ▼  └── flags_from_weights, flags_from_mask
//   weights()
//
// All write into the caller's buffers, which are reused; what they read is never changed.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// How much each feature may say in an estimate: 1 − the probability that it moves, times its trust, so that what has
/// moved before and is parked now can't drag a pose when it starts again. Where nobody gives a probability it is the
/// trust of a feature that is kept and 0 for one that is dropped. Suspicion errs: no trust below 0.35, so that
/// what was wrongly suspected still holds a pose where little else is left (docs/trackers.md has the sweep).
/// @param weights  becomes one entry a feature, 0 to 1, in the order of the key points. A feature that only the
///                 keep-floor kept has the small weight that it deserves.
inline void weights(const FrameResult& result, std::vector<float>& weights) {
  constexpr float kLeastTrust = 0.35f;
  weights.resize(result.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Label& label = result.verdict(i);
    const float stands = label.probability >= 0.0f ? 1.0f - std::min(label.probability, 1.0f)
                         : label.keep              ? 1.0f
                                                   : 0.0f;
    weights[i] = stands * std::max(label.trust, kLeastTrust);
  }
}

/// One byte a feature, as `FrameResult::keep`: 1 where the weight is at least `least`. NaN drops.
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

/// One byte a feature: 1 where the mask at its rounded pixel is not 0. What lies outside of the mask is kept.
/// @param mask  gray8, 255 keeps, 0 drops
inline void flags_from_mask(const ImageView& mask, span<const Vector2f> pixels, std::vector<std::uint8_t>& keep) {
  keep.resize(pixels.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = mask_drops(mask, pixels[i]) ? 0 : 1;
}

/// A copy of the depth image with 0, no depth, where the mask drops: for hosts that take depth and no mask.
/// @param depth   16 bit or float, of any size with the mask's field of view
/// @param mask    gray8, 255 keeps, 0 drops; an empty one drops nothing
/// @param masked  becomes an image of the depth's size and format
inline void masked_depth(const DepthView& depth, const ImageView& mask, ImageBuffer& masked) {
  masked.assign(depth.image);
  if (mask.empty() || depth.empty()) return;
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
