// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The camera: pixels to rays and back, with or without lens distortion.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/options.hpp"

namespace stillpoint {

/// A camera with focal lengths and principal point in pixels. Axes: x right, y down, z forward. Stages compute with
/// undistorted pixels; images hold distorted ones.
template <class Distortion>
class PinholeCamera {
 public:
  /// @throws Error unless both focal lengths and the size are positive and everything is finite, the lens too.
  PinholeCamera(double fx, double fy, double cx, double cy, int width, int height, Distortion distortion = {})
      : fx_(fx), fy_(fy), cx_(cx), cy_(cy), width_(width), height_(height), distortion_(std::move(distortion)) {
    require(std::isfinite(fx) && fx > 0, "fx", fx, "a positive focal length in pixels");
    require(std::isfinite(fy) && fy > 0, "fy", fy, "a positive focal length in pixels");
    require(std::isfinite(cx), "cx", cx, "a finite principal point in pixels");
    require(std::isfinite(cy), "cy", cy, "a finite principal point in pixels");
    require(width > 0, "width", width, "a positive number of pixels");
    require(height > 0, "height", height, "a positive number of pixels");
    // A point that every coefficient moves: one that is not finite shows, whatever the model.
    require(is_finite(distortion_.distort(Vector2d(0.1, 0.2))), "distortion", "not finite", "finite coefficients");
    if (!has_no_lens(distortion_)) fold_radius_ = fold_radius(distortion_);
  }

  double fx() const noexcept { return fx_; }
  double fy() const noexcept { return fy_; }
  double cx() const noexcept { return cx_; }
  double cy() const noexcept { return cy_; }
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  const Distortion& distortion() const noexcept { return distortion_; }

  /// K, the intrinsic matrix.
  Matrix3d matrix() const noexcept {
    Matrix3d k;
    k << fx_, 0, cx_, 0, fy_, cy_, 0, 0, 1;
    return k;
  }

  /// Undistorted pixel of a point in the camera's frame. The point must have z > 0.
  Vector2d project(const Vector3d& point) const noexcept {
    return {fx_ * point.x() / point.z() + cx_, fy_ * point.y() / point.z() + cy_};
  }

  /// Point in the camera's frame at a depth (z, metres) along an undistorted pixel's ray (π⁻¹, Eq. 4 and 5).
  Vector3d back_project(const Vector2d& pixel, double depth_m) const noexcept {
    return {(pixel.x() - cx_) / fx_ * depth_m, (pixel.y() - cy_) / fy_ * depth_m, depth_m};
  }

  /// Undistorted pixel to the pixel in the image. Without a lens it is the same: no division by the focal lengths.
  /// Beyond the radius at which the lens's model folds back, the distorted radius grows in proportion to the ideal one.
  Vector2d distort(const Vector2d& pixel) const {
    if (has_no_lens(distortion_)) return pixel;
    const Vector2d ideal = to_plane(pixel);
    if (!(ideal.squaredNorm() > fold_radius_ * fold_radius_)) return to_pixel(distortion_.distort(ideal));
    const double beyond = ideal.norm() / fold_radius_;
    return to_pixel(beyond * distortion_.distort(ideal / beyond));
  }

  /// Pixel in the image to the undistorted pixel.
  Vector2d undistort(const Vector2d& pixel) const {
    return has_no_lens(distortion_) ? pixel : to_pixel(distortion_.undistort(to_plane(pixel)));
  }

 private:
  static void require(bool holds, const char* name, const std::string& found, const char* expected) {
    if (!holds) throw Error(std::string("camera: ") + name + " is " + found + ", expected " + expected);
  }
  template <class Value, class = std::enable_if_t<std::is_arithmetic_v<Value>>>
  static void require(bool holds, const char* name, Value found, const char* expected) {
    require(holds, name, option_text(found), expected);
  }

  Vector2d to_plane(const Vector2d& pixel) const noexcept { return {(pixel.x() - cx_) / fx_, (pixel.y() - cy_) / fy_}; }
  Vector2d to_pixel(const Vector2d& plane) const noexcept { return {plane.x() * fx_ + cx_, plane.y() * fy_ + cy_}; }

  double fx_, fy_, cx_, cy_;
  int width_, height_;
  Distortion distortion_;
  double fold_radius_ = std::numeric_limits<double>::infinity();
};

template <class Camera>
struct is_pinhole_camera : std::false_type {};
template <class Distortion>
struct is_pinhole_camera<PinholeCamera<Distortion>> : std::true_type {};

/// How many undistorted pixels one pixel of the image is at an undistorted pixel, in the direction in which it is most:
/// 1 to 1000. Noise of the image grows by it on the plane: 75 degrees aside, an equidistant fisheye's by 15.
template <class AnyCamera>
double lens_stretch(const AnyCamera& camera, const Vector2d& pixel) {
  if constexpr (is_pinhole_camera<AnyCamera>::value)
    if (has_no_lens(camera.distortion())) return 1.0;
  const Vector2d at = camera.distort(pixel);
  const Vector2d along_x = camera.distort(pixel + Vector2d(1, 0)) - at,
                 along_y = camera.distort(pixel + Vector2d(0, 1)) - at;
  // 1 over the lesser singular value of the 2 x 2 matrix of both.
  const double sum = along_x.squaredNorm() + along_y.squaredNorm();
  const double determinant = along_x.x() * along_y.y() - along_x.y() * along_y.x();
  const double least_sq = 0.5 * (sum - std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant)));
  constexpr double kMost = 1000.0;
  return least_sq < 1.0 ? 1.0 / std::sqrt(std::max(least_sq, 1.0 / (kMost * kMost))) : 1.0;
}

/// The image's pixel where a point is seen. The point is in the camera's frame, with z > 0.
template <class AnyCamera>
Vector2f image_pixel(const AnyCamera& camera, const Vector3d& point) {
  return to_float(camera.distort(camera.project(point)));
}

/// The point in the camera's frame that a pixel of the image shows at a depth (z, metres).
template <class AnyCamera>
Vector3d point_at_depth(const AnyCamera& camera, const Vector2f& pixel, double depth_m) {
  return camera.back_project(camera.undistort(to_double(pixel)), depth_m);
}

/// The camera of the policy sets we ship: its lens model is chosen at run time.
using Camera = PinholeCamera<AnyDistortion>;

}  // namespace stillpoint
