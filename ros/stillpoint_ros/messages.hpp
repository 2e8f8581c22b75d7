// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Messages that ROS 1 and ROS 2 spell alike, to those of this folder and back: the types are template parameters.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "stillpoint/core/image.hpp"
#include "stillpoint_ros/node_core.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_ros {

/// A sensor_msgs Image.
/// @param keeps  holds the message, whose pixels are not copied
template <class Image>
RawImage raw_image(const Image& message, double stamp_s, std::shared_ptr<const void> keeps) {
  RawImage image;
  image.stamp_s = stamp_s;
  image.width = static_cast<int>(message.width);
  image.height = static_cast<int>(message.height);
  image.step_bytes = message.step;
  image.encoding = message.encoding;
  image.is_bigendian = message.is_bigendian != 0;
  image.data = message.data.data();
  image.size_bytes = message.data.size();
  image.message = std::move(keeps);
  return image;
}

/// A sensor_msgs CameraInfo; ROS 1 and ROS 2 write its matrices in capitals and in small letters.
template <class Info, class Matrix, class Coefficients, class Projection>
CameraInfo camera_info(const Info& message, double stamp_s, const Matrix& k, const Coefficients& d,
                       const Projection& p) {
  CameraInfo info;
  info.stamp_s = stamp_s;
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  std::copy(k.begin(), k.end(), info.k.begin());
  info.distortion_model = message.distortion_model;
  info.d.assign(d.begin(), d.end());
  std::copy(p.begin(), p.end(), info.p.begin());
  return info;
}

/// A sensor_msgs Image with a copy of the pixels, and the header of the message that it answers.
template <class Image, class Header>
void fill(const stillpoint::ImageView& image, const Header& header, const std::string& encoding, Image& message) {
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * stillpoint::bytes_per_pixel(image.format);
  message.header = header;
  message.width = static_cast<std::uint32_t>(image.width);
  message.height = static_cast<std::uint32_t>(image.height);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(row_bytes);
  message.data.resize(static_cast<std::size_t>(image.height) * row_bytes);
  for (int v = 0; v < image.height; ++v)
    std::memcpy(message.data.data() + static_cast<std::size_t>(v) * row_bytes, image.row<std::uint8_t>(v), row_bytes);
}

/// A diagnostic_msgs DiagnosticArray with one status.
template <class Array, class Time>
Array diagnostics(const Report& report, const std::string& node, const Time& now) {
  Array array;
  array.header.stamp = now;
  array.status.resize(1);
  auto& status = array.status.front();
  status.level = static_cast<decltype(status.level)>(report.level);
  status.name = node + ": filter";
  status.message = report.message;
  for (const auto& [key, value] : report.values) {
    status.values.emplace_back();
    status.values.back().key = key;
    status.values.back().value = value;
  }
  return array;
}

}  // namespace stillpoint_ros
