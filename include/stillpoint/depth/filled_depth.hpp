// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A depth image whose holes are filled from the last one: how old is the depth of each pixel?

#include <algorithm>
#include <cstdint>
#include <utility>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// A copy of a depth image, and for each pixel the frames since its depth was measured; 0: now.
class FilledDepth {
 public:
  /// All memory at once, not in the first frame with holes.
  void reserve_like(const ImageView& depth) {
    image_.resize(depth.width, depth.height, depth.format);
    for (ImageBuffer* const age : {&age_, &age_before_}) age->resize(depth.width, depth.height, PixelFormat::gray8);
  }

  /// The last frame was measured as it is.
  void forget_ages() { clear(age_); }

  /// The next frame.
  void assign(const ImageView& depth) {
    std::swap(age_, age_before_);
    clear(age_);
    image_.assign(depth);
  }

  ImageView view() const noexcept { return image_.view(); }

  /// Of a pixel of the last frame.
  int age_before(int u, int v) const noexcept { return age_before_.view().row<std::uint8_t>(v)[u]; }

  /// A hole takes over a depth.
  /// @param factor  steps of the image per metre
  /// @param age     frames since it was measured, at most 255
  void set(int u, int v, float depth_m, double factor, int age) noexcept {
    if (image_.view().format == PixelFormat::depth32f)
      image_.row<float>(v)[u] = depth_m;
    else
      image_.row<std::uint16_t>(v)[u] =
          static_cast<std::uint16_t>(std::clamp(static_cast<double>(depth_m) * factor + 0.5, 1.0, 65535.0));
    age_.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(age);
  }

 private:
  static void clear(ImageBuffer& age) {
    const ImageView view = age.view();
    std::fill_n(age.row<std::uint8_t>(0), view.width * view.height, std::uint8_t{0});
  }

  ImageBuffer image_;
  ImageBuffer age_, age_before_;
};

}  // namespace stillpoint
