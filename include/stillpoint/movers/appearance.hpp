// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What does an object look like?   So that it is known again.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// What an object looks like: a histogram of its gray levels.
class Appearance {
 public:
  static constexpr std::size_t kBins = 16;

  void add(const ImageView& gray, const Vector2f& pixel) {
    constexpr int kStep_px = 3;
    const int u = rounded(pixel.x()), v = rounded(pixel.y());
    for (int dv = -kStep_px; dv <= kStep_px; dv += kStep_px)
      for (int du = -kStep_px; du <= kStep_px; du += kStep_px)
        if (gray.contains(u + du, v + dv))
          bins_[gray.row<std::uint8_t>(v + dv)[u + du] * kBins / 256] += 1.0f, sum_ += 1.0f;
  }

  /// Hellinger's distance, 0 (alike) to 1; ½ where nothing is known.
  float distance(const Appearance& other) const noexcept {
    if (!(sum_ > 0) || !(other.sum_ > 0)) return 0.5f;
    float overlap = 0;
    for (std::size_t b = 0; b < kBins; ++b) overlap += std::sqrt(bins_[b] / sum_ * (other.bins_[b] / other.sum_));
    return std::sqrt(std::max(0.0f, 1.0f - overlap));
  }

  /// Learns what it looks like now.
  void blend(const Appearance& now, float share) noexcept {
    if (!(now.sum_ > 0)) return;
    if (!(sum_ > 0)) share = 1.0f;
    for (std::size_t b = 0; b < kBins; ++b) {
      const float old = sum_ > 0 ? bins_[b] / sum_ : 0.0f;
      bins_[b] = old + share * (now.bins_[b] / now.sum_ - old);
    }
    sum_ = 1.0f;
  }

 private:
  std::array<float, kBins> bins_{};
  float sum_ = 0;
};

}  // namespace stillpoint
