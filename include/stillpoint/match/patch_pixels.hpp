// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pixels of a small square patch in fixed point: bilinear sampling, and sums over the patch.
//
// Whole numbers of 16 bits: sums are exact, so that they are the same in any order and on any machine. The loops run
// over all 64 numbers in one go, which g++ and clang++ turn into vector instructions (eight numbers each) at -O2
// already.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

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

/// `sample_pixel` of a whole patch; reads nine pixels of nine lines.
/// @param first         the pixel up and left of the patch's first place
/// @param stride_bytes  from a line to the next
inline void sample_square(const std::uint8_t* first, std::size_t stride_bytes, const BilinearWeights& weights,
                          PatchPixels& out) noexcept {
  constexpr std::size_t kSide = PatchPixels::kSide, kLines = kSide + 1, kPadded = (kLines + 1) * kSide;
  std::array<std::uint8_t, kPadded> left_bytes, right_bytes;
  for (std::size_t j = 0; j < kLines; ++j) {
    std::memcpy(&left_bytes[kSide * j], first + j * stride_bytes, kSide);
    std::memcpy(&right_bytes[kSide * j], first + j * stride_bytes + 1, kSide);
  }
  // A line more than is needed: an even number of lines fills whole registers of bytes.
  std::memset(&left_bytes[kSide * kLines], 0, kSide);
  std::memset(&right_bytes[kSide * kLines], 0, kSide);
  alignas(16) std::array<std::int16_t, kPadded> left, right;
  for (std::size_t k = 0; k < kPadded; ++k) {
    left[k] = left_bytes[k];
    right[k] = right_bytes[k];
  }

  // Σ w p = 2¹⁴ p₀ + Σ w (p − p₀) over the other three pixels, in two parts that 16 bits hold: w = 64 coarse + fine
  // with −32 ≤ fine < 32, so that |Σ fine (p − p₀)| ≤ 3 · 32 · 255. Coarse products wrap around, but not what they add
  // up to: it is (Σ w p + ½) / 64, below 2¹⁶.
  constexpr int kFineBits = 6;
  const auto coarse = [](std::int16_t w) { return (w + (1 << (kFineBits - 1))) >> kFineBits; };
  const auto fine = [&coarse](std::int16_t w) { return static_cast<std::int16_t>(w - (coarse(w) << kFineBits)); };
  const auto right_coarse = static_cast<std::int16_t>(coarse(weights.right)), right_fine = fine(weights.right);
  const auto below_coarse = static_cast<std::int16_t>(coarse(weights.below)), below_fine = fine(weights.below);
  const auto diagonal_coarse = static_cast<std::int16_t>(coarse(weights.diagonal)),
             diagonal_fine = fine(weights.diagonal);
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k) {
    const auto to_right = static_cast<std::int16_t>(right[k] - left[k]);
    const auto to_below = static_cast<std::int16_t>(left[k + kSide] - left[k]);
    const auto to_diagonal = static_cast<std::int16_t>(right[k + kSide] - left[k]);
    const auto rest = static_cast<std::int16_t>(right_fine * to_right + below_fine * to_below +
                                                diagonal_fine * to_diagonal + BilinearWeights::kHalf);
    const auto mean =
        static_cast<std::uint16_t>((left[k] << (BilinearWeights::kBits - kFineBits)) + right_coarse * to_right +
                                   below_coarse * to_below + diagonal_coarse * to_diagonal + (rest >> kFineBits));
    out.pixel[k] = static_cast<std::int16_t>(mean >> (BilinearWeights::kShift - kFineBits));
  }
}

}  // namespace stillpoint
