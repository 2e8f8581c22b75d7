// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A camera_info message of ROS 1 or ROS 2, without ROS, and the camera that it describes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint_ros {

/// The part of sensor_msgs/CameraInfo that the filter needs: that of the image as it comes, raw or rectified.
struct CameraInfo {
  double stamp_s = 0.0;
  int width = 0, height = 0;
  std::array<double, 9> k{};     ///< row by row: fx 0 cx, 0 fy cy, 0 0 1; pixels
  std::string distortion_model;  ///< a name of sensor_msgs/distortion_models.h; empty: none
  std::vector<double> d;         ///< its coefficients
};

/// The same intrinsics and the same lens, whatever the time.
inline bool is_same_camera(const CameraInfo& a, const CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.k == b.k && a.distortion_model == b.distortion_model &&
         a.d == b.d;
}

/// The lens: plumb_bob is Brown and Conrady's model, equidistant that of Kannala and Brandt. Of rational_polynomial the
/// first five coefficients, where the others are 0.
/// @throws stillpoint::Error for a lens that the library has no model of
inline stillpoint::AnyDistortion distortion_of(const CameraInfo& info) {
  const std::vector<double>& d = info.d;
  const auto coefficient = [&d](std::size_t i) { return i < d.size() ? d[i] : 0.0; };
  const std::string& model = info.distortion_model;
  if (std::all_of(d.begin(), d.end(), [](double value) { return value == 0.0; })) return {stillpoint::NoDistortion{}};
  if (model == "equidistant" || model == "fisheye")
    return {stillpoint::EquidistantFisheye{coefficient(0), coefficient(1), coefficient(2), coefficient(3)}};
  if (model != "plumb_bob" && model != "rational_polynomial")
    throw stillpoint::Error("camera_info: distortion_model is '" + model +
                            "', expected plumb_bob, equidistant, or rectified images with coefficients of 0");
  for (std::size_t i = 5; i < d.size(); ++i)
    if (d[i] != 0.0)
      throw stillpoint::Error("camera_info: distortion_model is " + model + " with coefficient " + std::to_string(i) +
                              " not 0, expected at most five (image_proc rectifies the images of such a lens)");
  return {stillpoint::BrownConrady{coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4)}};
}

/// @throws stillpoint::Error where the camera was never calibrated (K is 0), or its lens has no model here
inline stillpoint::Camera camera_of(const CameraInfo& info) {
  if (info.k[0] == 0.0)
    throw stillpoint::Error("camera_info: fx is 0, expected the camera matrix K of a calibrated camera");
  return {info.k[0], info.k[4], info.k[2], info.k[5], info.width, info.height, distortion_of(info)};
}

}  // namespace stillpoint_ros
