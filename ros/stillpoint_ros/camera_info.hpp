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
#include "stillpoint/core/options.hpp"

namespace stillpoint_ros {

/// The part of sensor_msgs/CameraInfo that the filter needs. One message is of two images: `k` and `d` are of the raw
/// one, `p` is of the rectified one.
struct CameraInfo {
  double stamp_s = 0.0;
  int width = 0, height = 0;
  std::array<double, 9> k{};     ///< row by row: fx 0 cx, 0 fy cy, 0 0 1; pixels
  std::string distortion_model;  ///< a name of sensor_msgs/distortion_models.h; empty: none
  std::vector<double> d;         ///< its coefficients
  std::array<double, 12> p{};    ///< row by row: fx 0 cx Tx, 0 fy cy Ty, 0 0 1 0; pixels
};

/// The same intrinsics and the same lens, whatever the time.
inline bool is_same_camera(const CameraInfo& a, const CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.k == b.k && a.distortion_model == b.distortion_model &&
         a.d == b.d && a.p == b.p;
}

/// Whether two cameras show a ray at the same pixel, within the noise of a corner, half-way to the border. Calibrations
/// change in their last digits with the focus or the temperature: what was seen with one fits the other.
inline bool show_alike(const stillpoint::Camera& a, const stillpoint::Camera& b) {
  constexpr double kSame_px = 0.25;
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (const double x : {-0.25, 0.25})
    for (const double y : {-0.25, 0.25}) {
      const stillpoint::Vector3d ray(x * a.width() / a.fx(), y * a.height() / a.fy(), 1.0);
      if (!((a.distort(a.project(ray)) - b.distort(b.project(ray))).norm() <= kSame_px)) return false;
    }
  return true;
}

namespace detail {
inline constexpr const char* kRectify =
    "rectify images of another lens with image_proc and set the parameter rectified (stillpoint_run: --rectified)";
}  // namespace detail

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
    throw stillpoint::Error("camera_info: distortion_model is '" + model + "', expected plumb_bob or equidistant; " +
                            detail::kRectify);
  for (std::size_t i = 5; i < d.size(); ++i)
    if (d[i] != 0.0)
      throw stillpoint::Error("camera_info: distortion_model is " + model + " with coefficient " + std::to_string(i) +
                              " not 0, expected at most five; " + detail::kRectify);
  return {stillpoint::BrownConrady{coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4)}};
}

/// The camera of the raw image, from K and D, or of the rectified image, from P.
/// @throws stillpoint::Error where the camera was never calibrated (K or P is 0), or its lens has no model here
inline stillpoint::Camera camera_of(const CameraInfo& info, bool is_rectified = false) {
  if (is_rectified) {
    if (!(info.p[0] > 0.0))
      throw stillpoint::Error(
          "camera_info: fx of P is " + stillpoint::option_text(info.p[0]) +
          ", expected the projection matrix P of a calibrated camera, which the parameter rectified uses");
    return {info.p[0], info.p[5], info.p[2], info.p[6], info.width, info.height};
  }
  if (info.k[0] == 0.0)
    throw stillpoint::Error("camera_info: fx is 0, expected the camera matrix K of a calibrated camera");
  return {info.k[0], info.k[4], info.k[2], info.k[5], info.width, info.height, distortion_of(info)};
}

}  // namespace stillpoint_ros
