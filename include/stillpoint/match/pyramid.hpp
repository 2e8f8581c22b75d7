// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A pyramid of half-sized images: each pixel is the mean of four.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// Level 0 is a copy of the image.
class Pyramid {
 public:
  void build(const ImageView& gray, std::size_t levels) {
    levels_.resize(levels);
    levels_[0].assign(gray);
    for (std::size_t l = 1; l < levels; ++l) halve(levels_[l - 1].view(), levels_[l]);
  }

  std::size_t size() const noexcept { return levels_.size(); }
  ImageView operator[](std::size_t level) const noexcept { return levels_[level].view(); }

  /// A pixel of the image in the coordinates of a level. Integer coordinates are pixel centres on every level.
  static Vector2f to_level(const Vector2f& pixel, std::size_t level) noexcept {
    const float scale = 1.0f / static_cast<float>(std::size_t{1} << level);
    return {(pixel.x() + 0.5f) * scale - 0.5f, (pixel.y() + 0.5f) * scale - 0.5f};
  }

  static Vector2f from_level(const Vector2f& pixel, std::size_t level) noexcept {
    const float scale = static_cast<float>(std::size_t{1} << level);
    return {(pixel.x() + 0.5f) * scale - 0.5f, (pixel.y() + 0.5f) * scale - 0.5f};
  }

 private:
  static void halve(const ImageView& image, ImageBuffer& half) {
    const int width = image.width / 2, height = image.height / 2;
    half.resize(width, height, PixelFormat::gray8);
    for (int v = 0; v < height; ++v) {
      const std::uint8_t* const p = image.row<std::uint8_t>(2 * v);
      const std::uint8_t* const q = image.row<std::uint8_t>(2 * v + 1);
      std::uint8_t* const out = half.row<std::uint8_t>(v);
      for (int u = 0; u < width; ++u)
        out[u] = static_cast<std::uint8_t>((p[2 * u] + p[2 * u + 1] + q[2 * u] + q[2 * u + 1] + 2) >> 2);
    }
  }

  std::vector<ImageBuffer> levels_;
};

}  // namespace stillpoint
