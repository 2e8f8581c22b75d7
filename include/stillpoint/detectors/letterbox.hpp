// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How an image lies in the network's input, and the way back.   box in the input → box in the image

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/box_mask.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// How an image is made to fill the input.
enum class ImageFit : std::uint8_t {
  stretch,             ///< to the whole input, whatever becomes of its proportions
  letterbox_centred,   ///< proportions kept, bars of equal width on both sides
  letterbox_top_left,  ///< proportions kept, bars at the right or below
};

/// Where the image lies in the input: whole pixels, as an image is resized to.
class Letterbox {
 public:
  int left = 0, top = 0;  ///< first pixel of the input that shows the image
  int width, height;      ///< pixels of the input that show the image

  Letterbox(InputSize image, InputSize input, ImageFit fit) noexcept
      : width(input.width), height(input.height), image_{std::max(image.width, 1), std::max(image.height, 1)} {
    if (fit == ImageFit::stretch) return;
    const double scale =
        std::min(static_cast<double>(input.width) / image_.width, static_cast<double>(input.height) / image_.height);
    width = std::clamp(static_cast<int>(std::lround(image_.width * scale)), 1, input.width);
    height = std::clamp(static_cast<int>(std::lround(image_.height * scale)), 1, input.height);
    if (fit == ImageFit::letterbox_top_left) return;
    left = (input.width - width) / 2;
    top = (input.height - height) / 2;
  }

  /// Cuts off what lies in the bars or outside the input, of the mask too. False if nothing is left, or less than a
  /// thousandth of a pixel of the input: scaled to a small image its extent may be 0.
  bool clip(RawDetection& detection) const {
    const RawDetection whole = detection;
    detection.left = std::max(whole.left, static_cast<float>(left));
    detection.top = std::max(whole.top, static_cast<float>(top));
    detection.right = std::min(whole.right, static_cast<float>(left + width));
    detection.bottom = std::min(whole.bottom, static_cast<float>(top + height));
    constexpr float kLeast_px = 1e-3f;
    if (!(detection.right - detection.left > kLeast_px && detection.bottom - detection.top > kLeast_px)) return false;
    if (whole.mask) detection.mask = crop_mask(whole, detection);
    return true;
  }

  /// The same box in the image. Networks count from a pixel's edge, the library from its centre: hence the half.
  Box to_image(const RawDetection& detection) const noexcept {
    const float image_per_input_x = static_cast<float>(image_.width) / static_cast<float>(width);
    const float image_per_input_y = static_cast<float>(image_.height) / static_cast<float>(height);
    return {(detection.left - static_cast<float>(left)) * image_per_input_x - 0.5f,
            (detection.top - static_cast<float>(top)) * image_per_input_y - 0.5f,
            (detection.right - detection.left) * image_per_input_x,
            (detection.bottom - detection.top) * image_per_input_y};
  }

 private:
  InputSize image_;
};

}  // namespace stillpoint
