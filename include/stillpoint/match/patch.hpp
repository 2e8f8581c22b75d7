// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Small square patches, cut out of an image.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/match/patch_pixels.hpp"

namespace stillpoint {

/// What a patch looks like: gray values and their slopes, where the mask allows; 0 elsewhere.
struct Patch {
  static constexpr int kSide = PatchPixels::kSide;  ///< 8 pixels: −4 … +3 round its centre
  static constexpr int kHalf = kSide / 2;
  static constexpr int kMargin = kHalf + 1;  ///< a centre nearer to the border cannot be cut out
  static constexpr int kFewestPixels = 25;   ///< of 64 that must lie on the centre's surface

  PatchPixels value;
  PatchPixels slope_x, slope_y;       ///< differences across two pixels: twice the gradient
  PatchPixels mask;                   ///< −1 takes part, 0 does not
  int count = 0;                      ///< how many take part
  int sum = 0, sum_x = 0, sum_y = 0;  ///< Σ value, Σ slope
  int along_x = 0, along_y = 0;       ///< Σ slope · value
  float energy = 0;                   ///< Σ value², values without their mean
  float hxx = 0, hxy = 0, hyy = 0;    ///< Σ gradient gradientᵀ, gradients without their mean: the structure tensor

  /// Whether enough of it takes part to be compared.
  bool is_comparable() const noexcept { return count >= kFewestPixels; }

  /// Whether the mask leaves pixels out.
  bool is_partial() const noexcept { return count < static_cast<int>(PatchPixels::kCount); }

  /// `count` Σ a b of two quantities without their means, from the sums of what they are: exact until it is rounded.
  float centred(std::int64_t product, std::int64_t sum_a, std::int64_t sum_b) const noexcept {
    return static_cast<float>(count * product - sum_a * sum_b);
  }
};

/// Which pixels of a patch lie on the surface of its centre. Pixels without a depth are taken to.
class PatchMask {
 public:
  PatchMask() = default;  ///< all of them
  /// @param tolerance_m  by which depths on the surface may differ
  PatchMask(const DepthView& depth, double depth_m, double tolerance_m) : depth_(depth_m > 0 ? &depth : nullptr) {
    const double units = depth.image.format == PixelFormat::depth16 ? depth.factor : 1.0;
    nearest_ = static_cast<float>((depth_m - tolerance_m) * units);
    farthest_ = static_cast<float>((depth_m + tolerance_m) * units);
  }
  PatchMask(const DepthView& depth, const Vector2f& pixel, double tolerance_m)
      : PatchMask(depth, depth_at(depth, pixel), tolerance_m) {}

  /// Masks need pixel for pixel the same image.
  bool applies_to(const ImageView& image) const noexcept {
    return depth_ != nullptr && depth_->image.width == image.width && depth_->image.height == image.height;
  }

  /// Fills the mask of a patch whose first pixel is (u, v).
  void fill(int u, int v, PatchPixels& mask) const noexcept {
    if (depth_->image.format == PixelFormat::depth16) {
      constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
      fill(u, v, static_cast<std::uint16_t>(std::clamp(std::ceil(nearest_), 0.0f, kMost)),
           static_cast<std::uint16_t>(std::clamp(std::floor(farthest_), 0.0f, kMost)), mask);
    } else {
      fill(u, v, nearest_, farthest_, mask);
    }
  }

 private:
  /// Compared in the units of the image: no division a pixel. What is not finite and above 0 is no depth.
  template <class Depth>
  void fill(int u, int v, Depth nearest, Depth farthest, PatchPixels& mask) const noexcept {
    constexpr Depth kMost = std::numeric_limits<Depth>::max();
    for (int j = 0; j < Patch::kSide; ++j) {
      const Depth* const depth = depth_->image.row<Depth>(v + j) + u;
      std::int16_t* const row = mask.row(j);
      for (int i = 0; i < Patch::kSide; ++i) {
        const Depth there = depth[i];
        const bool here = ((there >= nearest) & (there <= farthest)) | !((there > 0) & (there <= kMost));
        row[i] = here ? std::int16_t{-1} : std::int16_t{0};
      }
    }
  }

  static double depth_at(const DepthView& depth, const Vector2f& pixel) noexcept {
    const auto u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
    return depth.image.contains(u, v) ? static_cast<double>(depth.metres(u, v)) : 0.0;
  }

  const DepthView* depth_ = nullptr;
  float nearest_ = 0, farthest_ = 0;  // in the units of the depth image
};

/// Cuts a patch out.
/// @param centre  a pixel, rounded already
/// @return false when the centre is too near to the border or nothing is left of the patch.
inline bool cut_patch(const ImageView& gray, const Vector2f& centre, const PatchMask& mask, Patch& patch) noexcept {
  if (!(gray.border_distance_px(centre.x(), centre.y()) >= static_cast<float>(Patch::kMargin))) return false;
  const auto u = static_cast<int>(centre.x()), v = static_cast<int>(centre.y());
  if (mask.applies_to(gray))
    mask.fill(u - Patch::kHalf, v - Patch::kHalf, patch.mask);
  else
    patch.mask.pixel.fill(-1);
  // Lines from one above the patch to one below, and their neighbours to the left and right. Copied together first:
  // a loop over all pixels becomes vector instructions, one over the eight of a line does not.
  constexpr std::size_t kSide = Patch::kSide, kCount = PatchPixels::kCount;
  const std::uint8_t* line = gray.row<std::uint8_t>(v - Patch::kHalf - 1) + (u - Patch::kHalf);
  std::array<std::uint8_t, kCount + 2 * kSide> lines;
  std::array<std::uint8_t, kCount> left, right;
  std::memcpy(lines.data(), line, kSide);
  for (std::size_t k = 0; k < kCount; k += kSide) {
    line += gray.stride_bytes;
    std::memcpy(&lines[k + kSide], line, kSide);
    std::memcpy(&left[k], line - 1, kSide);
    std::memcpy(&right[k], line + 1, kSide);
  }
  std::memcpy(&lines[kCount + kSide], line + gray.stride_bytes, kSide);
  for (std::size_t k = 0; k < kCount; ++k) {
    const std::int16_t allowed = patch.mask[k];
    patch.value.pixel[k] = static_cast<std::int16_t>(allowed & lines[k + kSide]);
    patch.slope_x.pixel[k] = static_cast<std::int16_t>(allowed & (right[k] - left[k]));
    patch.slope_y.pixel[k] = static_cast<std::int16_t>(allowed & (lines[k + 2 * kSide] - lines[k]));
  }
  patch.count = -sum(patch.mask);
  if (!(patch.count > 0)) return false;
  patch.sum = -product(patch.mask, patch.value);  // a sum by the quicker loop
  patch.sum_x = -product(patch.mask, patch.slope_x);
  patch.sum_y = -product(patch.mask, patch.slope_y);
  patch.along_x = product(patch.slope_x, patch.value);
  patch.along_y = product(patch.slope_y, patch.value);
  const float per_pixel = 1.0f / static_cast<float>(patch.count);
  patch.energy = per_pixel * patch.centred(product(patch.value, patch.value), patch.sum, patch.sum);
  const float quarter = 0.25f * per_pixel;  // of two slopes each twice a gradient
  patch.hxx = quarter * patch.centred(product(patch.slope_x, patch.slope_x), patch.sum_x, patch.sum_x);
  patch.hxy = quarter * patch.centred(product(patch.slope_x, patch.slope_y), patch.sum_x, patch.sum_y);
  patch.hyy = quarter * patch.centred(product(patch.slope_y, patch.slope_y), patch.sum_y, patch.sum_y);
  return true;
}

}  // namespace stillpoint
