// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Small square patches: cut out of one image, found again in another.

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

  /// Smaller eigenvalue of the structure tensor: how well the patch can be located in its worst direction.
  float corner_strength() const noexcept {
    const float trace_half = 0.5f * (hxx + hyy), difference_half = 0.5f * (hxx - hyy);
    return trace_half - std::sqrt(difference_half * difference_half + hxy * hxy);
  }

  /// Whether enough of it takes part to be compared.
  bool is_comparable() const noexcept { return count >= kFewestPixels; }

  /// Whether the mask leaves pixels out.
  bool is_partial() const noexcept { return count < static_cast<int>(PatchPixels::kCount); }

  /// `count` Σ a b of two quantities without their means, from the sums of what they are: exact until it is rounded.
  float centred(std::int64_t product, std::int64_t sum_a, std::int64_t sum_b) const noexcept {
    return static_cast<float>(count * product - sum_a * sum_b);
  }
};

/// Where a patch was found.
struct PatchFit {
  Vector2f offset = Vector2f::Zero();  ///< from where the search began, pixels
  float dissimilarity = 2.0f;  ///< 1 − zero-mean normalised cross-correlation: 0 alike, 1 unrelated, 2 inverted
  float contrast = 0;          ///< standard deviation of the gray values there
  bool inside = false;         ///< false: the patch left the image
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

/// How `find_patch` searches.
struct PatchSearch {
  int iterations = 5;          ///< steps of at most a pixel
  float precision_px = 0.03f;  ///< a smaller step is the last
  float reach_px = 3.0f;       ///< the offset is held within this radius
  /// What a step of one pixel in the patch is in the other image: scale, rotation and shear between the views.
  Eigen::Matrix2f warp = Eigen::Matrix2f::Identity();
};

namespace detail {

/// Samples a patch bilinearly round `centre`; false when it leaves the image.
inline bool sample_patch(const ImageView& gray, const Vector2f& centre, const Eigen::Matrix2f& warp, bool shifted_only,
                         PatchPixels& out) noexcept {
  constexpr int kSide = Patch::kSide, kHalf = Patch::kHalf;
  if (shifted_only) {
    const float x = centre.x() - kHalf, y = centre.y() - kHalf;
    if (!(x >= 0 && y >= 0 && x + kSide + 1 < static_cast<float>(gray.width) &&
          y + kSide + 1 < static_cast<float>(gray.height)))
      return false;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    const BilinearWeights weights(x - static_cast<float>(u), y - static_cast<float>(v));
    sample_square(gray.row<std::uint8_t>(v) + u, gray.stride_bytes, weights, out);
    return true;
  }
  const float reach_x = kHalf * (std::abs(warp(0, 0)) + std::abs(warp(0, 1)));
  const float reach_y = kHalf * (std::abs(warp(1, 0)) + std::abs(warp(1, 1)));
  if (!(centre.x() - reach_x >= 0 && centre.y() - reach_y >= 0 &&
        centre.x() + reach_x + 1 < static_cast<float>(gray.width) &&
        centre.y() + reach_y + 1 < static_cast<float>(gray.height)))
    return false;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const float di = static_cast<float>(i - kHalf), dj = static_cast<float>(j - kHalf);
      const float x = centre.x() + warp(0, 0) * di + warp(0, 1) * dj;
      const float y = centre.y() + warp(1, 0) * di + warp(1, 1) * dj;
      const int u = static_cast<int>(x), v = static_cast<int>(y);
      const BilinearWeights weights(x - static_cast<float>(u), y - static_cast<float>(v));
      out.row(j)[i] = sample_pixel(gray.row<std::uint8_t>(v) + u, gray.row<std::uint8_t>(v + 1) + u, weights);
    }
  }
  return true;
}

}  // namespace detail

/// Finds a patch near `start` by Gauss and Newton's steps on the gray-value difference, with the patch's own gradients
/// (inverse compositional), brightness free. The best of all visited places is returned.
/// Source: Baker and Matthews, "Lucas-Kanade 20 Years On", IJCV 2004, section 3.2.
inline PatchFit find_patch(const Patch& patch, const ImageView& gray, const Vector2f& start,
                           const PatchSearch& search) noexcept {
  PatchFit best;
  const float determinant = patch.hxx * patch.hyy - patch.hxy * patch.hxy;
  const float warp_px =
      Patch::kHalf * (search.warp - Eigen::Matrix2f(Eigen::Matrix2f::Identity())).lpNorm<Eigen::Infinity>();
  const bool shifted_only = warp_px < 0.5f;
  constexpr float kOne = BilinearWeights::kOne;
  // Elsewhere another content has another contrast, and between pixels there is less: neither is the exposure's.
  constexpr float kAlike = 0.1f, kLeastChange = 0.15f, kLeastGain = 0.2f;
  const auto squared = [](float x) { return x * x; };
  // A step waits for each division and root in turn: what is the same for all steps is divided here.
  const float per_pixel = 1.0f / static_cast<float>(patch.count);
  const float to_energy = per_pixel / squared(kOne);
  const float to_likeness = per_pixel / kOne;
  const float to_squared_gain = 1.0f / (patch.energy + 1e-3f);
  const float to_step = -per_pixel / (2 * kOne * determinant);
  Vector2f offset = Vector2f::Zero();
  PatchPixels sample;
  float energy_there = 0;
  for (int iteration = 0; iteration < search.iterations; ++iteration) {
    if (!detail::sample_patch(gray, start + offset, search.warp, shifted_only, sample)) break;
    best.inside = true;
    if (patch.is_partial()) apply_mask(patch.mask, sample);
    const int total = -product(patch.mask, sample);  // the sum, by the quickest of these loops
    const float energy = to_energy * patch.centred(product(sample, sample), total, total);
    const float likeness = to_likeness * patch.centred(product(patch.value, sample), patch.sum, total);
    const float dissimilarity = 1.0f - likeness / std::sqrt(patch.energy * energy + 1e-3f);
    if (dissimilarity < best.dissimilarity) {
      best.dissimilarity = dissimilarity;
      best.offset = offset;
      energy_there = energy;
    }
    if (!(determinant > 0)) break;
    // Σ gradient · (sample / gain − value), all without their means: neither gain nor offset of the exposure counts.
    constexpr int kLevel = BilinearWeights::kOne;
    const int excess = total - kLevel * patch.sum;
    const int along_x = product(patch.slope_x, sample), along_y = product(patch.slope_y, sample);
    float bx = patch.centred(along_x - kLevel * patch.along_x, patch.sum_x, excess);
    float by = patch.centred(along_y - kLevel * patch.along_y, patch.sum_y, excess);
    const float squared_gain = energy * to_squared_gain;
    const bool is_brighter = squared_gain > squared(1 + kLeastChange);
    const bool is_darker = squared_gain < squared(1 - kLeastChange) && squared_gain > squared(kLeastGain);
    if (dissimilarity < kAlike && (is_brighter || is_darker)) {
      const float without_gain = 1.0f / std::sqrt(squared_gain) - 1.0f;
      bx += without_gain * patch.centred(along_x, patch.sum_x, total);
      by += without_gain * patch.centred(along_y, patch.sum_y, total);
    }
    Vector2f step = search.warp *
                    Vector2f(to_step * (patch.hyy * bx - patch.hxy * by), to_step * (patch.hxx * by - patch.hxy * bx));
    step = {std::clamp(step.x(), -1.0f, 1.0f), std::clamp(step.y(), -1.0f, 1.0f)};
    const Vector2f before = offset;
    offset += step;
    const float squared_length = offset.squaredNorm();
    if (squared_length > squared(search.reach_px)) offset *= search.reach_px / std::sqrt(squared_length);
    if ((offset - before).squaredNorm() < squared(search.precision_px)) {
      if (best.offset == before) best.offset = offset;  // too small a step for another look
      break;
    }
  }
  if (best.inside) best.contrast = std::sqrt(std::max(energy_there * per_pixel, 0.0f));
  return best;
}

}  // namespace stillpoint
