// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pixels of a small square patch in fixed point: bilinear sampling, and sums over the patch.
//
// Whole numbers of 16 bits: sums are exact, so that they are the same in any order and on any machine. The loops run
// over all 64 numbers in one go, which g++ and clang++ turn into vector instructions (eight numbers each) at -O2
// already.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

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

/// Where a place lies between four pixels, in fixed point. Interpolates along lines first, then between two lines, so
/// that both steps fit 16 bits.
struct BilinearWeights {
  static constexpr int kLineBits = 7;      ///< of a gray value between two pixels of a line: 255 · 2⁷ < 2¹⁵
  static constexpr int kFractionBits = 4;  ///< of a sampled gray value …
  static constexpr int kOne = 1 << kFractionBits;           ///< … so that this is one gray level
  static constexpr int kShift = kLineBits - kFractionBits;  ///< from the one to the other
  /// For rounding: ½, and 1 for the half that `between_lines` drops on average, twice.
  static constexpr std::int16_t kHalf = (1 << (kShift - 1)) + 1;

  std::int16_t right;  ///< 0 to 2⁷
  std::int16_t below;  ///< 0 to 2¹⁵ − 1

  /// @param a, b  from the pixel to the place, right and down, 0 to 1
  BilinearWeights(float a, float b) noexcept
      : right(static_cast<std::int16_t>(a * (1 << kLineBits) + 0.5f)),  // rounded: none is negative
        below(static_cast<std::int16_t>(b * std::numeric_limits<std::int16_t>::max() + 0.5f)) {}

  std::int16_t along_line(std::int16_t left_pixel, std::int16_t right_pixel) const noexcept {
    return static_cast<std::int16_t>((left_pixel << kLineBits) + right * (right_pixel - left_pixel));
  }

  /// In sixteenths of a level. The upper 16 bits of a product are one vector instruction; half of the step between the
  /// lines is what they hold.
  std::int16_t between_lines(std::int16_t upper, std::int16_t lower) const noexcept {
    const auto step = static_cast<std::int16_t>(lower - upper);
    const auto half = static_cast<std::int16_t>((std::int32_t{step} * std::int32_t{below}) >> 16);
    return static_cast<std::int16_t>(static_cast<std::int16_t>(upper + 2 * half + kHalf) >> kShift);
  }
};

/// The gray value between the pixels upper[0], upper[1], lower[0] and lower[1], in sixteenths of a level.
inline std::int16_t sample_pixel(const std::uint8_t* upper, const std::uint8_t* lower,
                                 const BilinearWeights& weights) noexcept {
  return weights.between_lines(weights.along_line(upper[0], upper[1]), weights.along_line(lower[0], lower[1]));
}

/// `sample_pixel` of a whole patch; reads nine pixels of nine lines.
/// @param first         the pixel up and left of the patch's first place
/// @param stride_bytes  from a line to the next
inline void sample_square(const std::uint8_t* first, std::size_t stride_bytes, const BilinearWeights& weights,
                          PatchPixels& out) noexcept {
  constexpr std::size_t kSide = PatchPixels::kSide, kLines = kSide + 1, kPadded = (kLines + 1) * kSide;
  std::array<std::uint8_t, kPadded> left, right;
  for (std::size_t j = 0; j <= kLines; ++j) {
    // The last line twice: an even number of lines fills whole registers.
    const std::uint8_t* const line = first + (j < kLines ? j : kLines - 1) * stride_bytes;
    std::memcpy(&left[kSide * j], line, kSide);
    std::memcpy(&right[kSide * j], line + 1, kSide);
  }
  alignas(16) std::array<std::int16_t, kPadded> between;
  for (std::size_t k = 0; k < kPadded; ++k) between[k] = weights.along_line(left[k], right[k]);
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k)
    out.pixel[k] = weights.between_lines(between[k], between[k + kSide]);
}

}  // namespace stillpoint
