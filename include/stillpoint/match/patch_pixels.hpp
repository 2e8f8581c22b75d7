// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pixels of a small square patch in fixed point: bilinear sampling, and sums over the patch.
//
// Whole numbers of 16 bits, eight to a register: sums are exact, so that they are the same in whatever order and on
// whatever machine they are added up.

#if __has_include(<opencv2/core/hal/intrin.hpp>)  // a host without OpenCV has loops instead, with the same result
#include <opencv2/core/hal/intrin.hpp>
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// 8 × 8 numbers, rows one after the other.
struct PatchPixels {
  static constexpr int kSide = 8;
  static constexpr std::size_t kCount = 64;

  alignas(16) std::array<std::int16_t, kCount> pixel;

  std::int16_t* row(int j) noexcept { return pixel.data() + j * kSide; }
  std::int16_t operator[](std::size_t k) const noexcept { return pixel[k]; }
};

/// Makes 0 of what the mask does not allow.
inline void apply_mask(const PatchPixels& mask, PatchPixels& a) noexcept {
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k)
    a.pixel[k] = static_cast<std::int16_t>(a.pixel[k] & mask.pixel[k]);
}

/// Σ a
inline std::int32_t sum(const PatchPixels& a) noexcept {
  std::int32_t total = 0;
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k) total += a.pixel[k];
  return total;
}

/// Σ a b. Compilers know this loop: one instruction multiplies eight pairs and adds them up by two.
inline std::int32_t product(const PatchPixels& a, const PatchPixels& b) noexcept {
  std::int32_t total = 0;
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k) total += std::int32_t{a.pixel[k]} * std::int32_t{b.pixel[k]};
  return total;
}

/// The shares of four neighbouring pixels in a place between them, in whole numbers that add up to 2¹⁴.
struct BilinearWeights {
  static constexpr int kBits = 14;
  static constexpr int kFractionBits = 4;                   ///< of a sampled gray value …
  static constexpr int kOne = 1 << kFractionBits;           ///< … so that this is one gray level
  static constexpr int kShift = kBits - kFractionBits;      ///< from a weighted sum to a sampled gray value
  static constexpr std::int32_t kHalf = 1 << (kShift - 1);  ///< for rounding

  std::int16_t here, right, below, diagonal;

  /// @param a, b  from the pixel to the place, right and down, 0 to 1
  BilinearWeights(float a, float b) noexcept {
    constexpr float kAll = 1 << kBits;
    // Rounded up from ½: none is negative.
    here = static_cast<std::int16_t>((1 - a) * (1 - b) * kAll + 0.5f);
    right = static_cast<std::int16_t>(a * (1 - b) * kAll + 0.5f);
    below = static_cast<std::int16_t>((1 - a) * b * kAll + 0.5f);
    diagonal = static_cast<std::int16_t>((1 << kBits) - here - right - below);
  }
};

/// The gray value between the pixels upper[0], upper[1], lower[0] and lower[1], in sixteenths of a level.
inline std::int16_t sample_pixel(const std::uint8_t* upper, const std::uint8_t* lower,
                                 const BilinearWeights& weights) noexcept {
  const std::int32_t mean =
      weights.here * upper[0] + weights.right * upper[1] + weights.below * lower[0] + weights.diagonal * lower[1];
  return static_cast<std::int16_t>((mean + BilinearWeights::kHalf) >> BilinearWeights::kShift);
}

/// `sample_pixel` of eight in a row; reads nine pixels of each line.
inline void sample_row(const std::uint8_t* upper, const std::uint8_t* lower, const BilinearWeights& weights,
                       std::int16_t* out) noexcept {
#if defined(CV_SIMD128) && CV_SIMD128
  const auto pixels = [](const std::uint8_t* p) { return cv::v_reinterpret_as_s16(cv::v_load_expand(p)); };
  // Pairs of neighbours, and the weights of both: a product and the sum of each pair is one instruction.
  const auto pair = [](std::int16_t left, std::int16_t right) {
    return cv::v_int16x8(left, right, left, right, left, right, left, right);
  };
  const cv::v_int16x8 upper_weights = pair(weights.here, weights.right);
  const cv::v_int16x8 lower_weights = pair(weights.below, weights.diagonal);
  cv::v_int16x8 upper_first, upper_last, lower_first, lower_last;
  cv::v_zip(pixels(upper), pixels(upper + 1), upper_first, upper_last);
  cv::v_zip(pixels(lower), pixels(lower + 1), lower_first, lower_last);
  const cv::v_int32x4 first = cv::v_dotprod(lower_first, lower_weights, cv::v_dotprod(upper_first, upper_weights));
  const cv::v_int32x4 last = cv::v_dotprod(lower_last, lower_weights, cv::v_dotprod(upper_last, upper_weights));
  cv::v_store(out, cv::v_rshr_pack<BilinearWeights::kShift>(first, last));
#else
  for (int i = 0; i < PatchPixels::kSide; ++i) out[i] = sample_pixel(upper + i, lower + i, weights);
#endif
}

}  // namespace stillpoint
