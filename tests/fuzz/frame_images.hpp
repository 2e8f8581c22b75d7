// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Images in which the filter finds something to judge.

#include <cstdint>
#include <opencv2/core.hpp>

#include "bytes.hpp"

namespace fuzz {

/// Cells of 3 pixels in any shade, which may have moved.
inline cv::Mat make_gray(Bytes& bytes, int width, int height) {
  cv::Mat gray(height, width, CV_8UC1);
  const int shift = bytes.integer(-3, 3), seed = bytes.byte();
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const auto cell = static_cast<unsigned>((u + shift) / 3 * 73 + v / 3 * 151 + seed % 4);
      gray.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(cell * 2654435761u >> 13);
    }
  return gray;
}

/// Mostly one depth everywhere, with other values in places; of 16 bit or metres, empty or of another size.
inline cv::Mat make_depth(Bytes& bytes, int width, int height) {
  const int kind = bytes.integer(0, 9);
  if (kind == 0) return {};
  if (kind == 1) width = bytes.integer(1, 60), height = bytes.integer(1, 60);
  if (kind <= 5) {
    cv::Mat depth(height, width, CV_16UC1, cv::Scalar(bytes.integer(0, 65535)));
    for (int i = bytes.integer(0, 40); i > 0; --i)
      depth.at<std::uint16_t>(bytes.byte() % height, bytes.byte() % width) =
          static_cast<std::uint16_t>(bytes.integer(0, 65535));
    return depth;
  }
  cv::Mat depth(height, width, CV_32FC1, cv::Scalar(static_cast<double>(bytes.single(0, 8))));
  for (int i = bytes.integer(0, 40); i > 0; --i)
    depth.at<float>(bytes.byte() % height, bytes.byte() % width) = bytes.single(0, 8);
  return depth;
}

}  // namespace fuzz
