// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The ROS 2 component as a program. A wrong parameter ends it with a sentence and status 2.

#include <cstdlib>
#include <exception>
#include <rclcpp/rclcpp.hpp>

#include "stillpoint_component.hpp"

int main(int argument_count, char** arguments) {
  constexpr int kFailed = 2;
  try {
    rclcpp::init(argument_count, arguments);
    rclcpp::spin(stillpoint_ros2::make_stillpoint(rclcpp::NodeOptions()));
    rclcpp::shutdown();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    RCLCPP_FATAL(rclcpp::get_logger("stillpoint"), "%s", error.what());
    return kFailed;
  }
}
