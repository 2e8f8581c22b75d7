// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How the library reads OpenCV's types: images as views, keypoints as pixels. No pixel is copied.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "stillpoint/core/image.hpp"
#include "stillpoint/core/keypoint.hpp"

namespace stillpoint {

/// CV_8UC1 is gray, CV_8UC3 is BGR, CV_16UC1 and CV_32FC1 are depth; another type is `PixelFormat::unsupported`.
template <>
struct image_traits<cv::Mat> {
  static ImageView view(const cv::Mat& image) {
    if (image.empty() || image.dims != 2) return {};
    return {image.data, image.cols, image.rows, image.step[0], format(image.type())};
  }

  static PixelFormat format(int type) noexcept {
    switch (type) {
      case CV_8UC1: return PixelFormat::gray8;
      case CV_8UC3: return PixelFormat::bgr8;
      case CV_16UC1: return PixelFormat::depth16;
      case CV_32FC1: return PixelFormat::depth32f;
      default: return PixelFormat::unsupported;
    }
  }
};

/// cv::Mat1b, cv::Mat1w and the like.
template <class Pixel>
struct image_traits<cv::Mat_<Pixel>> : image_traits<cv::Mat> {};

template <>
struct keypoint_traits<cv::KeyPoint> {
  static Vector2f pixel(const cv::KeyPoint& keypoint) { return {keypoint.pt.x, keypoint.pt.y}; }
};

template <class Scalar>
struct keypoint_traits<cv::Point_<Scalar>> {
  static Vector2f pixel(const cv::Point_<Scalar>& point) {
    return {static_cast<float>(point.x), static_cast<float>(point.y)};
  }
};

/// The same pixels as a cv::Mat header. OpenCV has no const Mat: do not write to it.
inline cv::Mat as_mat(const ImageView& image) {
  if (image.empty()) return {};
  const int type = image.format == PixelFormat::bgr8       ? CV_8UC3
                   : image.format == PixelFormat::depth16  ? CV_16UC1
                   : image.format == PixelFormat::depth32f ? CV_32FC1
                                                           : CV_8UC1;
  return cv::Mat(image.height, image.width, type, const_cast<std::uint8_t*>(image.data), image.stride_bytes);
}

}  // namespace stillpoint
