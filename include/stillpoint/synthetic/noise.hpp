// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Normal deviates for whole images, several times faster than Box and Muller.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/random.hpp"

namespace stillpoint::synthetic {

/// The middles of 4096 slices of equal probability of the normal distribution, scaled to standard deviation 1. The
/// largest is about 3.7.
class NormalTable {
 public:
  NormalTable() {
    // Newton's method on Φ(x) = p, upwards from the median, each slice from the one before; the lower half mirrored.
    double x = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < kSlices / 2; ++i) {
      const double p = 0.5 + (static_cast<double>(i) + 0.5) / kSlices;
      for (int iteration = 0; iteration < 8; ++iteration) {
        const double density = 0.3989422804014327 * std::exp(-0.5 * x * x);
        x += (p - 0.5 * std::erfc(-x * 0.7071067811865476)) / density;
      }
      values_[kSlices / 2 + i] = static_cast<float>(x);
      squares += 2.0 * x * x;
    }
    const auto scale = static_cast<float>(std::sqrt(kSlices / squares));
    for (std::size_t i = kSlices / 2; i < kSlices; ++i) {
      values_[i] *= scale;
      values_[kSlices - 1 - i] = -values_[i];
    }
  }

  float operator[](std::size_t slice) const noexcept { return values_[slice]; }
  static constexpr std::size_t kSlices = 4096;  ///< 12 bits of a random number

 private:
  std::array<float, kSlices> values_{};
};

/// A stream of deviates: five from each 64-bit random number.
class NormalStream {
 public:
  NormalStream(const NormalTable& table, std::uint64_t seed) noexcept : table_(table), random_(seed) {}

  float next() noexcept {
    if (left_ == 0) {
      bits_ = random_.bits();
      left_ = 5;
    }
    const std::size_t slice = bits_ & (NormalTable::kSlices - 1);
    bits_ >>= 12;
    --left_;
    return table_[slice];
  }

 private:
  const NormalTable& table_;
  Random random_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace stillpoint::synthetic
