// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A patch is found again in another image.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/match/patch_pixels.hpp"

namespace stillpoint {

/// Where a patch was found.
struct PatchFit {
  Vector2f offset = Vector2f::Zero();  ///< from where the search began, pixels
  float dissimilarity = 2.0f;  ///< 1 − zero-mean normalised cross-correlation: 0 alike, 1 unrelated, 2 inverted
  float contrast = 0;          ///< standard deviation of the gray values there
  bool inside = false;         ///< false: the patch left the image
};

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

/// Compares a patch with samples of another image, brightness free. A step of a search waits for each division and root
/// in turn: what is the same for all samples is divided once.
class PatchComparison {
 public:
  explicit PatchComparison(const Patch& patch) noexcept
      : patch_(patch),
        determinant_(patch.hxx * patch.hyy - patch.hxy * patch.hxy),
        per_pixel_(1.0f / static_cast<float>(patch.count)),
        to_energy_(per_pixel_ / (kOne * kOne)),
        to_likeness_(per_pixel_ / kOne),
        to_squared_gain_(1.0f / (patch.energy + 1e-3f)),
        to_step_(-per_pixel_ / (2 * kOne * determinant_)) {}

  struct Likeness {
    float dissimilarity, energy;  ///< as in PatchFit; Σ value², values without their mean
    int sum;                      ///< Σ value
  };

  Likeness operator()(const PatchPixels& sample) const noexcept {
    const int sum = -product(patch_.mask, sample);  // by the quickest of these loops
    const float energy = to_energy_ * patch_.centred(product(sample, sample), sum, sum);
    const float likeness = to_likeness_ * patch_.centred(product(patch_.value, sample), patch_.sum, sum);
    return {1.0f - likeness / std::sqrt(patch_.energy * energy + 1e-3f), energy, sum};
  }

  /// Whether the patch has slopes in two directions.
  bool can_step() const noexcept { return determinant_ > 0; }

  /// The step of Gauss and Newton, in pixels of the patch: Σ gradient · (sample / gain − value), all without their
  /// means, so that neither gain nor offset of the exposure counts.
  Vector2f step(const PatchPixels& sample, const Likeness& there) const noexcept {
    constexpr int kLevel = BilinearWeights::kOne;
    const int excess = there.sum - kLevel * patch_.sum;
    const int along_x = product(patch_.slope_x, sample), along_y = product(patch_.slope_y, sample);
    float bx = patch_.centred(along_x - kLevel * patch_.along_x, patch_.sum_x, excess);
    float by = patch_.centred(along_y - kLevel * patch_.along_y, patch_.sum_y, excess);
    const float squared_gain = there.energy * to_squared_gain_;
    if (there.dissimilarity < kAlike && is_gain(squared_gain)) {
      const float without_gain = 1.0f / std::sqrt(squared_gain) - 1.0f;
      bx += without_gain * patch_.centred(along_x, patch_.sum_x, there.sum);
      by += without_gain * patch_.centred(along_y, patch_.sum_y, there.sum);
    }
    return {to_step_ * (patch_.hyy * bx - patch_.hxy * by), to_step_ * (patch_.hxx * by - patch_.hxy * bx)};
  }

  /// Standard deviation of a sample's gray values.
  float contrast(float energy) const noexcept { return std::sqrt(std::max(energy * per_pixel_, 0.0f)); }

 private:
  // Elsewhere another content has another contrast, and between pixels there is less: neither is the exposure's.
  static constexpr float kAlike = 0.1f, kLeastChange = 0.15f, kLeastGain = 0.2f;
  static constexpr float kOne = BilinearWeights::kOne;

  static bool is_gain(float squared_gain) noexcept {
    const auto squared = [](float x) { return x * x; };
    const bool is_brighter = squared_gain > squared(1 + kLeastChange);
    const bool is_darker = squared_gain < squared(1 - kLeastChange) && squared_gain > squared(kLeastGain);
    return is_brighter || is_darker;
  }

  const Patch& patch_;
  float determinant_, per_pixel_, to_energy_, to_likeness_, to_squared_gain_, to_step_;
};

}  // namespace detail

/// Finds a patch near `start` by Gauss and Newton's steps on the gray-value difference, with the patch's own gradients
/// (inverse compositional), brightness free. The best of all visited places is returned.
/// Source: Baker and Matthews, "Lucas-Kanade 20 Years On", IJCV 2004, section 3.2.
inline PatchFit find_patch(const Patch& patch, const ImageView& gray, const Vector2f& start,
                           const PatchSearch& search) noexcept {
  PatchFit best;
  const float warp_px = Patch::kHalf * largest_magnitude(search.warp - Eigen::Matrix2f(Eigen::Matrix2f::Identity()));
  const bool shifted_only = warp_px < 0.5f;
  const detail::PatchComparison compare(patch);
  Vector2f offset = Vector2f::Zero();
  PatchPixels sample;
  float energy_there = 0;
  for (int iteration = 0; iteration < search.iterations; ++iteration) {
    if (!detail::sample_patch(gray, start + offset, search.warp, shifted_only, sample)) break;
    best.inside = true;
    if (patch.is_partial()) apply_mask(patch.mask, sample);
    const detail::PatchComparison::Likeness there = compare(sample);
    if (there.dissimilarity < best.dissimilarity) {
      best.dissimilarity = there.dissimilarity;
      best.offset = offset;
      energy_there = there.energy;
    }
    if (!compare.can_step()) break;
    const Vector2f step = search.warp * compare.step(sample, there);
    const Vector2f before = offset;
    offset += Vector2f(std::clamp(step.x(), -1.0f, 1.0f), std::clamp(step.y(), -1.0f, 1.0f));
    const float squared_length = offset.squaredNorm();
    if (squared_length > search.reach_px * search.reach_px) offset *= search.reach_px / std::sqrt(squared_length);
    if ((offset - before).squaredNorm() < search.precision_px * search.precision_px) {
      if (best.offset == before) best.offset = offset;  // too small a step for another look
      break;
    }
  }
  if (best.inside) best.contrast = compare.contrast(energy_there);
  return best;
}

}  // namespace stillpoint
