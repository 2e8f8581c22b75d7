// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The component, for a program of its own.

#include <memory>
#include <rclcpp/node.hpp>

namespace stillpoint_ros2 {

/// @throws stillpoint::Error naming a parameter that is wrong or unknown; what rclcpp throws where one has another type
std::shared_ptr<rclcpp::Node> make_stillpoint(const rclcpp::NodeOptions& options);

}  // namespace stillpoint_ros2
