// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// An image as a network wants it: resized, in a letterbox perhaps, one plane of floats a channel.   image → 1x3xHxW

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/detectors/letterbox.hpp"
#include "stillpoint/detectors/preprocess.hpp"
#include "stillpoint/detectors/raw_detection.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {

/// Fills the input of a network, and keeps the memory for the next image.
class NetworkInput {
 public:
  NetworkInput() = default;
  NetworkInput(const InputSize& size, const Preprocess& preprocess) : size_(size), preprocess_(preprocess) {}

  /// @param image  BGR or gray, 8 bit
  /// @return how the image lies in the input
  /// @throws Error if it is empty or of another format.
  Letterbox fill(const ImageView& image) {
    if (image.empty()) throw Error("detector: found no image, or one of another format, expected BGR or gray of 8 bit");
    if (image.format != PixelFormat::bgr8 && image.format != PixelFormat::gray8)
      throw Error("detector: found an image of another format, expected BGR or gray of 8 bit");
    const Letterbox letterbox({image.width, image.height}, size_, preprocess_.fit);
    const cv::Mat pixels = as_mat(image);
    cv::resize(pixels, resized_, cv::Size(letterbox.width, letterbox.height));  // linear, as in most trainings

    const std::size_t plane = static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
    values_.resize(3 * plane);
    const int channels = resized_.channels();
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<float, 256> value_of;
      for (std::size_t i = 0; i < value_of.size(); ++i)
        value_of[i] = (static_cast<float>(i) - preprocess_.mean[c]) * preprocess_.scale[c];
      std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(c * plane), plane,
                  (preprocess_.padding - preprocess_.mean[c]) * preprocess_.scale[c]);
      const std::size_t channel = channels == 1 ? 0 : preprocess_.rgb ? 2 - c : c;
      for (int v = 0; v < letterbox.height; ++v) {
        const std::uint8_t* in = resized_.ptr<std::uint8_t>(v) + channel;
        float* out =
            values_.data() + c * plane + static_cast<std::ptrdiff_t>(letterbox.top + v) * size_.width + letterbox.left;
        for (int u = 0; u < letterbox.width; ++u, in += channels) *out++ = value_of[*in];
      }
    }
    return letterbox;
  }

  /// 3xHxW floats, valid until the next call.
  const std::vector<float>& values() const noexcept { return values_; }
  const InputSize& size() const noexcept { return size_; }

 private:
  InputSize size_;
  Preprocess preprocess_;
  cv::Mat resized_;
  std::vector<float> values_;
};

}  // namespace stillpoint
