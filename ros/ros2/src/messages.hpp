// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Messages of ROS 2 to those of stillpoint_ros/ and back.

#include <memory>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <string>

#include "stillpoint_ros/messages.hpp"

namespace stillpoint_ros2 {

inline double seconds(const builtin_interfaces::msg::Time& stamp) {
  return static_cast<double>(stamp.sec) + 1e-9 * static_cast<double>(stamp.nanosec);
}

/// The message stays alive as long as what is made of it.
inline stillpoint_ros::RawImage raw(const sensor_msgs::msg::Image::ConstSharedPtr& message) {
  return stillpoint_ros::raw_image(*message, seconds(message->header.stamp), message);
}

inline stillpoint_ros::CameraInfo raw(const sensor_msgs::msg::CameraInfo& message) {
  return stillpoint_ros::camera_info(message, seconds(message.header.stamp), message.k, message.d, message.p);
}

inline std::unique_ptr<sensor_msgs::msg::Image> message(const stillpoint::ImageView& image,
                                                        const std_msgs::msg::Header& header,
                                                        const std::string& encoding) {
  auto message = std::make_unique<sensor_msgs::msg::Image>();
  stillpoint_ros::fill(image, header, encoding, *message);
  return message;
}

}  // namespace stillpoint_ros2
