// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Messages of ROS 2 to those of stillpoint_ros/ and back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <string>

#include "stillpoint/core/image.hpp"
#include "stillpoint_ros/camera_info.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_ros2 {

inline double seconds(const builtin_interfaces::msg::Time& stamp) {
  return static_cast<double>(stamp.sec) + 1e-9 * static_cast<double>(stamp.nanosec);
}

/// The message stays alive as long as what is made of it.
inline stillpoint_ros::RawImage raw(const sensor_msgs::msg::Image::ConstSharedPtr& message) {
  stillpoint_ros::RawImage image;
  image.stamp_s = seconds(message->header.stamp);
  image.width = static_cast<int>(message->width);
  image.height = static_cast<int>(message->height);
  image.step_bytes = message->step;
  image.encoding = message->encoding;
  image.is_bigendian = message->is_bigendian != 0;
  image.data = message->data.data();
  image.size_bytes = message->data.size();
  image.message = message;
  return image;
}

inline stillpoint_ros::CameraInfo raw(const sensor_msgs::msg::CameraInfo& message) {
  stillpoint_ros::CameraInfo info;
  info.stamp_s = seconds(message.header.stamp);
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  std::copy(message.k.begin(), message.k.end(), info.k.begin());
  info.distortion_model = message.distortion_model;
  info.d = message.d;
  return info;
}

/// A copy of the image, with the header of the message that it answers.
inline std::unique_ptr<sensor_msgs::msg::Image> message(const stillpoint::ImageView& image,
                                                        const std_msgs::msg::Header& header,
                                                        const std::string& encoding) {
  auto message = std::make_unique<sensor_msgs::msg::Image>();
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * stillpoint::bytes_per_pixel(image.format);
  message->header = header;
  message->width = static_cast<std::uint32_t>(image.width);
  message->height = static_cast<std::uint32_t>(image.height);
  message->encoding = encoding;
  message->step = static_cast<std::uint32_t>(row_bytes);
  message->data.resize(static_cast<std::size_t>(image.height) * row_bytes);
  for (int v = 0; v < image.height; ++v)
    std::memcpy(message->data.data() + static_cast<std::size_t>(v) * row_bytes, image.row<std::uint8_t>(v), row_bytes);
  return message;
}

}  // namespace stillpoint_ros2
