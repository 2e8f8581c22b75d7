// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From pixels of the image to those of a depth image of another resolution.

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// Maps pixels of the image to pixels of a depth image of another resolution and the same field of view.
struct DepthScale {
  float x = 1.0f, y = 1.0f;

  DepthScale(const ImageView& image, const ImageView& depth) noexcept
      : x(ratio(depth.width, image.width)), y(ratio(depth.height, image.height)) {}

  /// Pixel centres are integers in both images: (u + ½) scales, not u.
  Vector2f operator()(const Vector2f& pixel) const noexcept {
    return {(pixel.x() + 0.5f) * x - 0.5f, (pixel.y() + 0.5f) * y - 0.5f};
  }

  /// From a pixel of the depth image to one of the image.
  Vector2f inverse(const Vector2f& depth_pixel) const noexcept {
    return {(depth_pixel.x() + 0.5f) / x - 0.5f, (depth_pixel.y() + 0.5f) / y - 0.5f};
  }

 private:
  /// Mostly both images have one size: nothing to divide.
  static float ratio(int depth_px, int image_px) noexcept {
    return depth_px == image_px || image_px <= 0 ? 1.0f : static_cast<float>(depth_px) / static_cast<float>(image_px);
  }
};

}  // namespace stillpoint
