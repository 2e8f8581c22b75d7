// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Messages of ROS 1 to those of stillpoint_ros/ and back.

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <memory>
#include <string>

#include "stillpoint_ros/messages.hpp"

namespace stillpoint_ros1 {

/// The message stays alive as long as what is made of it: ROS 1 counts by boost's pointer, which the deleter holds.
inline stillpoint_ros::RawImage raw(const sensor_msgs::Image::ConstPtr& message) {
  return stillpoint_ros::raw_image(*message, message->header.stamp.toSec(),
                                   std::shared_ptr<const void>(message.get(), [message](const void*) {}));
}

inline stillpoint_ros::CameraInfo raw(const sensor_msgs::CameraInfo& message) {
  return stillpoint_ros::camera_info(message, message.header.stamp.toSec(), message.K, message.D, message.P);
}

inline sensor_msgs::Image::Ptr message(const stillpoint::ImageView& image, const std_msgs::Header& header,
                                       const std::string& encoding) {
  const auto message = boost::make_shared<sensor_msgs::Image>();
  stillpoint_ros::fill(image, header, encoding, *message);
  return message;
}

}  // namespace stillpoint_ros1
