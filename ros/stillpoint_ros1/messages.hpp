// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Messages of ROS 1 to those of stillpoint_ros/ and back.

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include "stillpoint/core/image.hpp"
#include "stillpoint_ros/camera_info.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_ros1 {

/// The message stays alive as long as what is made of it.
inline stillpoint_ros::RawImage raw(const sensor_msgs::Image::ConstPtr& message) {
  stillpoint_ros::RawImage image;
  image.stamp_s = message->header.stamp.toSec();
  image.width = static_cast<int>(message->width);
  image.height = static_cast<int>(message->height);
  image.step_bytes = message->step;
  image.encoding = message->encoding;
  image.is_bigendian = message->is_bigendian != 0;
  image.data = message->data.data();
  image.size_bytes = message->data.size();
  // ROS 1 counts by boost's pointer: the deleter holds one.
  image.message = std::shared_ptr<const void>(message.get(), [message](const void*) {});
  return image;
}

inline stillpoint_ros::CameraInfo raw(const sensor_msgs::CameraInfo& message) {
  stillpoint_ros::CameraInfo info;
  info.stamp_s = message.header.stamp.toSec();
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  std::copy(message.K.begin(), message.K.end(), info.k.begin());
  info.distortion_model = message.distortion_model;
  info.d = message.D;
  return info;
}

/// A copy of the image, with the header of the message that it answers.
inline sensor_msgs::Image::Ptr message(const stillpoint::ImageView& image, const std_msgs::Header& header,
                                       const std::string& encoding) {
  const auto message = boost::make_shared<sensor_msgs::Image>();
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

}  // namespace stillpoint_ros1
