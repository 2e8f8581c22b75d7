// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A depth image that lies beside its image, moved back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// Moves all of a depth image by whole pixels; where nothing comes from is a hole. Keeps its buffer.
class ShiftedDepth {
 public:
  /// @param right_px, down_px  of the depth image
  /// @return  of the same size, format and unit; valid until the next call. O(pixels).
  DepthView operator()(const DepthView& depth, int right_px, int down_px) {
    const ImageView& image = depth.image;
    const std::size_t pixel_bytes = image.format == PixelFormat::depth16 ? sizeof(std::uint16_t) : sizeof(float);
    shifted_.resize(image.width, image.height, image.format);
    const int first = std::clamp(right_px, 0, image.width), last = std::clamp(image.width + right_px, 0, image.width);
    for (int v = 0; v < image.height; ++v) {
      std::uint8_t* const row = shifted_.row<std::uint8_t>(v);
      std::memset(row, 0, static_cast<std::size_t>(image.width) * pixel_bytes);
      const int from_v = v - down_px;
      if (from_v < 0 || from_v >= image.height || first >= last) continue;
      const std::uint8_t* const from = image.row<std::uint8_t>(from_v);
      std::memcpy(row + static_cast<std::size_t>(first) * pixel_bytes,
                  from + static_cast<std::size_t>(first - right_px) * pixel_bytes,
                  static_cast<std::size_t>(last - first) * pixel_bytes);
    }
    return DepthView(shifted_.view(), depth.factor);
  }

 private:
  ImageBuffer shifted_;
};

}  // namespace stillpoint
