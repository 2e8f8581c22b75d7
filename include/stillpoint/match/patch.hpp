// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Small square patches: cut out of one image, found again in another.
//
// Sampling is written as loops of constant length over rows of kSide floats, so that compilers vectorise them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// One float for each pixel of a patch, rows one after the other.
using PatchArray = Eigen::Array<float, 64, 1>;

/// What a patch looks like: gray values without their mean, and their gradients, where the mask allows.
struct Patch {
  static constexpr int kSide = 8;  ///< pixels; covers −4 … +3 round its centre
  static constexpr int kHalf = kSide / 2;
  static constexpr int kMargin = kHalf + 1;  ///< a centre nearer to the border cannot be cut out

  PatchArray value, gradient_x, gradient_y;
  PatchArray mask;                  ///< 1 takes part, 0 does not
  float count = 0;                  ///< how many take part
  float energy = 0;                 ///< Σ value²
  float hxx = 0, hxy = 0, hyy = 0;  ///< Σ gradient gradientᵀ: the structure tensor

  /// Smaller eigenvalue of the structure tensor: how well the patch can be located in its worst direction.
  float corner_strength() const noexcept {
    const float trace_half = 0.5f * (hxx + hyy), difference_half = 0.5f * (hxx - hyy);
    return trace_half - std::sqrt(difference_half * difference_half + hxy * hxy);
  }
};

/// Where a patch was found.
struct PatchFit {
  Vector2f offset = Vector2f::Zero();  ///< from where the search began, pixels
  float dissimilarity = 2.0f;  ///< 1 − zero-mean normalised cross-correlation: 0 alike, 1 unrelated, 2 inverted
  bool inside = false;         ///< false: the patch left the image
};

/// How much depth may differ on one surface: a constant and a part that grows as depth noise does.
struct DepthTolerance {
  double constant_m = 0.05;
  double per_square_m = 0.0076;  ///< metres per square metre of depth: four Kinect sigmas

  double at(double depth_m) const noexcept { return constant_m + per_square_m * depth_m * depth_m; }
};

/// Which pixels of a patch lie on the surface of its centre. Pixels without a depth are taken to.
class PatchMask {
 public:
  PatchMask() = default;  ///< all of them
  PatchMask(const DepthView& depth, double depth_m, const DepthTolerance& tolerance)
      : depth_(depth_m > 0 ? &depth : nullptr), depth_m_(depth_m), tolerance_m_(tolerance.at(depth_m)) {}
  PatchMask(const DepthView& depth, const Vector2f& pixel, const DepthTolerance& tolerance)
      : PatchMask(depth, depth_at(depth, pixel), tolerance) {}

  /// Masks need pixel for pixel the same image.
  bool applies_to(const ImageView& image) const noexcept {
    return depth_ != nullptr && depth_->image.width == image.width && depth_->image.height == image.height;
  }
  /// Takes out of a row of a patch's mask what lies elsewhere, from pixel (u, v) on.
  void apply(int u, int v, float* row) const noexcept {
    if (depth_->image.format == PixelFormat::depth16)
      apply(depth_->image.row<std::uint16_t>(v) + u, depth_->factor, row);
    else
      apply(depth_->image.row<float>(v) + u, 1.0, row);
  }

 private:
  /// Compared in the units of the image: no division a pixel. What is not finite and above 0 is no depth.
  template <class Depth>
  void apply(const Depth* depth, double factor, float* row) const noexcept {
    const auto nearest = static_cast<float>((depth_m_ - tolerance_m_) * factor);
    const auto farthest = static_cast<float>((depth_m_ + tolerance_m_) * factor);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (int i = 0; i < Patch::kSide; ++i) {
      const auto there = static_cast<float>(depth[i]);
      const bool elsewhere = (there > 0.0f && there < nearest) || (there > farthest && there < kInfinity);
      row[i] = elsewhere ? 0.0f : row[i];
    }
  }

  static double depth_at(const DepthView& depth, const Vector2f& pixel) noexcept {
    const auto u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
    return depth.image.contains(u, v) ? static_cast<double>(depth.metres(u, v)) : 0.0;
  }

  const DepthView* depth_ = nullptr;
  double depth_m_ = 0, tolerance_m_ = 0;
};

/// Cuts a patch out.
/// @param centre  a pixel, rounded already
/// @return false when the centre is too near to the border or nothing is left of the patch.
inline bool cut_patch(const ImageView& gray, const Vector2f& centre, const PatchMask& mask, Patch& patch) noexcept {
  if (!(gray.border_distance_px(centre.x(), centre.y()) >= static_cast<float>(Patch::kMargin))) return false;
  const auto u = static_cast<int>(centre.x()), v = static_cast<int>(centre.y());
  const bool masked = mask.applies_to(gray);
  patch.mask.setOnes();
  for (int j = 0; j < Patch::kSide; ++j) {
    const int row = v - Patch::kHalf + j, first = u - Patch::kHalf, k = j * Patch::kSide;
    const std::uint8_t* const above = gray.row<std::uint8_t>(row - 1) + first;
    const std::uint8_t* const here = gray.row<std::uint8_t>(row) + first;
    const std::uint8_t* const below = gray.row<std::uint8_t>(row + 1) + first;
    for (int i = 0; i < Patch::kSide; ++i) {
      patch.value[k + i] = here[i];
      patch.gradient_x[k + i] = 0.5f * static_cast<float>(here[i + 1] - here[i - 1]);
      patch.gradient_y[k + i] = 0.5f * static_cast<float>(below[i] - above[i]);
    }
    if (masked) mask.apply(first, row, patch.mask.data() + k);
  }
  patch.count = patch.mask.sum();
  if (!(patch.count > 0)) return false;
  const auto subtract_mean = [&patch](PatchArray& values) {
    values = patch.mask * (values - (patch.mask * values).sum() / patch.count);
  };
  subtract_mean(patch.value);
  subtract_mean(patch.gradient_x);
  subtract_mean(patch.gradient_y);
  patch.energy = patch.value.square().sum();
  patch.hxx = patch.gradient_x.square().sum();
  patch.hxy = (patch.gradient_x * patch.gradient_y).sum();
  patch.hyy = patch.gradient_y.square().sum();
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
                         PatchArray& out) noexcept {
  constexpr int kSide = Patch::kSide, kHalf = Patch::kHalf;
  if (shifted_only) {
    const float x = centre.x() - kHalf, y = centre.y() - kHalf;
    if (!(x >= 0 && y >= 0 && x + kSide + 1 < static_cast<float>(gray.width) &&
          y + kSide + 1 < static_cast<float>(gray.height)))
      return false;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    const float a = x - static_cast<float>(u), b = y - static_cast<float>(v);
    const float w00 = (1 - a) * (1 - b), w01 = a * (1 - b), w10 = (1 - a) * b, w11 = a * b;
    for (int j = 0; j < kSide; ++j) {
      const std::uint8_t* const p = gray.row<std::uint8_t>(v + j) + u;
      const std::uint8_t* const q = gray.row<std::uint8_t>(v + j + 1) + u;
      for (int i = 0; i < kSide; ++i) out[j * kSide + i] = w00 * p[i] + w01 * p[i + 1] + w10 * q[i] + w11 * q[i + 1];
    }
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
      const float a = x - static_cast<float>(u), b = y - static_cast<float>(v);
      const std::uint8_t* const p = gray.row<std::uint8_t>(v) + u;
      const std::uint8_t* const q = gray.row<std::uint8_t>(v + 1) + u;
      out[j * kSide + i] = (1 - b) * ((1 - a) * p[0] + a * p[1]) + b * ((1 - a) * q[0] + a * q[1]);
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
  const float warp_px = Patch::kHalf * (search.warp - Eigen::Matrix2f::Identity()).cwiseAbs().maxCoeff();
  const bool shifted_only = warp_px < 0.5f;
  Vector2f offset = Vector2f::Zero();
  PatchArray sample;
  for (int iteration = 0; iteration < search.iterations; ++iteration) {
    if (!detail::sample_patch(gray, start + offset, search.warp, shifted_only, sample)) break;
    best.inside = true;
    sample = patch.mask * (sample - (patch.mask * sample).sum() / patch.count);
    const float energy = sample.square().sum(), product = (sample * patch.value).sum();
    const float dissimilarity = 1.0f - product / std::sqrt(patch.energy * energy + 1e-3f);
    if (dissimilarity < best.dissimilarity) {
      best.dissimilarity = dissimilarity;
      best.offset = offset;
    }
    if (!(determinant > 0)) break;
    sample -= patch.value;
    const float bx = (patch.gradient_x * sample).sum(), by = (patch.gradient_y * sample).sum();
    Vector2f step(-(patch.hyy * bx - patch.hxy * by) / determinant, -(patch.hxx * by - patch.hxy * bx) / determinant);
    step = (search.warp * step).cwiseMax(-1.0f).cwiseMin(1.0f);
    const Vector2f before = offset;
    offset += step;
    const float length = offset.norm();
    if (length > search.reach_px) offset *= search.reach_px / length;
    if ((offset - before).norm() < search.precision_px) {
      if (best.offset == before) best.offset = offset;  // too small a step for another look
      break;
    }
  }
  return best;
}

}  // namespace stillpoint
