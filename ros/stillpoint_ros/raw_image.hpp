// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// An image message of ROS 1 or ROS 2, without ROS, and what the filter reads of it.

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "stillpoint/core/error.hpp"

namespace stillpoint_ros {

/// sensor_msgs/Image of either version. The pixels belong to `message`.
struct RawImage {
  double stamp_s = 0.0;
  int width = 0, height = 0;
  std::size_t step_bytes = 0;  ///< from one row to the next
  std::string encoding;        ///< a name of sensor_msgs/image_encodings.h
  bool is_bigendian = false;   ///< of values of more than a byte
  const std::uint8_t* data = nullptr;
  std::size_t size_bytes = 0;
  std::shared_ptr<const void> message;  ///< the node's message, which it gets back with the answer
};

namespace detail {

/// The message's own pixels as an image of OpenCV.
/// @throws stillpoint::Error where the message is shorter than its size says
inline cv::Mat pixels_of(const RawImage& image, int type) {
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * CV_ELEM_SIZE(type);
  if (image.width <= 0 || image.height <= 0)
    throw stillpoint::Error("size is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                            ", expected at least one pixel");
  if (image.step_bytes < row_bytes)
    throw stillpoint::Error("step is " + std::to_string(image.step_bytes) + " bytes, expected at least " +
                            std::to_string(row_bytes) + " for " + std::to_string(image.width) + " pixels of " +
                            image.encoding);
  if (image.step_bytes % CV_ELEM_SIZE1(type) != 0)
    throw stillpoint::Error("step is " + std::to_string(image.step_bytes) + " bytes, expected a multiple of " +
                            std::to_string(CV_ELEM_SIZE1(type)) + " for " + image.encoding);
  const std::size_t least_bytes = (static_cast<std::size_t>(image.height) - 1) * image.step_bytes + row_bytes;
  if (image.data == nullptr || image.size_bytes < least_bytes)
    throw stillpoint::Error("data has " + std::to_string(image.size_bytes) + " bytes, expected at least " +
                            std::to_string(least_bytes));
  return {image.height, image.width, type, const_cast<std::uint8_t*>(image.data), image.step_bytes};
}

}  // namespace detail

/// Whether this is the encoding of a depth image.
inline bool is_depth_encoding(const std::string& encoding) {
  return encoding == "16UC1" || encoding == "mono16" || encoding == "32FC1";
}

/// The image as CV_8UC1 or as CV_8UC3 in the order BGR. The pixels are those of the message where it has this order,
/// and hold as long as it does.
/// @throws stillpoint::Error naming what is wrong with the message: encoding, size, step or data
inline cv::Mat image_of(const RawImage& image) {
  const std::string& encoding = image.encoding;
  if (encoding == "mono8" || encoding == "8UC1") return detail::pixels_of(image, CV_8UC1);
  if (encoding == "bgr8" || encoding == "8UC3") return detail::pixels_of(image, CV_8UC3);
  cv::Mat bgr;
  if (encoding == "rgb8") {
    cv::cvtColor(detail::pixels_of(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  } else if (encoding == "rgba8") {
    cv::cvtColor(detail::pixels_of(image, CV_8UC4), bgr, cv::COLOR_RGBA2BGR);
  } else if (encoding == "bgra8") {
    cv::cvtColor(detail::pixels_of(image, CV_8UC4), bgr, cv::COLOR_BGRA2BGR);
  } else {
    throw stillpoint::Error("encoding is '" + encoding +
                            "', expected mono8, rgb8, bgr8, rgba8 or bgra8 (image_proc makes them of a Bayer image)");
  }
  return bgr;
}

/// The depth as CV_16UC1 or CV_32FC1, the message's own pixels.
/// @throws stillpoint::Error naming what is wrong with the message: encoding, byte order, size, step or data
inline cv::Mat depth_of(const RawImage& depth) {
  if (!is_depth_encoding(depth.encoding))
    throw stillpoint::Error("encoding is '" + depth.encoding + "', expected 16UC1 (millimetres) or 32FC1 (metres)");
  if (depth.is_bigendian) throw stillpoint::Error("is_bigendian is set, expected little-endian depth");
  return detail::pixels_of(depth, depth.encoding == "32FC1" ? CV_32FC1 : CV_16UC1);
}

}  // namespace stillpoint_ros
