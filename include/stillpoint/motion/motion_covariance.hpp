// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How well do matches in pixels determine a motion?   First order, in the coordinates of `Motion::covariance`.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"

namespace stillpoint {

/// Sums what matches say of a small rotation ω and translation v after the pose, p_current = Exp(ω) (R p + t) + v, and
/// the noise that they show.
template <class Camera>
class PixelInformation {
 public:
  PixelInformation(const Pose& current_from_reference, const Camera& camera)
      : pose_(current_from_reference), fx_(camera.fx()), fy_(camera.fy()) {}

  /// The epipolar constraint of two rays (z = 1), as Sampson's error in pixels. It says nothing of t's length.
  void add_epipolar(const Vector3d& reference_ray, const Vector3d& current_ray) {
    const Vector3d turned = pose_.linear() * reference_ray;
    const Vector3d line = pose_.translation().cross(turned);
    const Vector3d reference_line = pose_.linear().transpose() * current_ray.cross(pose_.translation());
    const double sigma = std::hypot(std::hypot(line.x() / fx_, line.y() / fy_),
                                    std::hypot(reference_line.x() / fx_, reference_line.y() / fy_));
    // c · (t' × R' p) with t' = t + ω × t + v and R' = Exp(ω) R; by Jacobi's identity the ω-terms are c · (ω × (t × R
    // p)).
    Vector6d jacobian;
    jacobian << line.cross(current_ray), turned.cross(current_ray);
    add(jacobian / sigma, current_ray.dot(line) / sigma);
  }

  /// Where a point is seen again, in pixels, when the camera hardly moved.
  /// @param reference_depth_m 0: unknown, so that the point says nothing of the translation
  void add_point(const Vector3d& reference_ray, const Vector3d& current_ray, double reference_depth_m) {
    const Vector3d turned = pose_.linear() * reference_ray;
    const Vector3d seen = turned / turned.z();
    const double per_metre = reference_depth_m > 0.0 ? 1.0 / (turned.z() * reference_depth_m) : 0.0;
    const Vector3d rows[2] = {{fx_, 0.0, -fx_ * seen.x()}, {0.0, fy_, -fy_ * seen.y()}};
    for (const Vector3d& row : rows) {
      Vector6d jacobian;
      jacobian << seen.cross(row), per_metre * row;
      add(jacobian, row.dot(current_ray - seen));
    }
  }

  /// The covariance, rad and m: a lower bound (Cramér and Rao), which a linear estimate does not reach. Pixel noise is
  /// the residuals' own, at least `kLeastNoise`.
  /// @param length_sigma_m  of t's length, where the constraints say nothing of it; infinite: unknown as well;
  ///                        0: it is not constrained, as of a motion without a translation
  Matrix6d covariance(double length_sigma_m) const {
    const double redundancy = std::max(static_cast<double>(count_) - 6.0, 1.0);
    const double variance = std::max(squared_error_ / redundancy, kLeastNoise * kLeastNoise);
    // What nothing is known of gets a radian or a metre: a camera does not go farther from one frame to the next.
    Matrix6d information = normal_ / variance + Matrix6d::Identity();
    const double length = pose_.translation().norm();
    if (length > 0.0 && length_sigma_m > 0.0) {
      Vector6d along = Vector6d::Zero();
      along.tail<3>() = pose_.translation() / (length * length_sigma_m);
      information += along * along.transpose();
    }
    return Cholesky<6>(information).inverse();
  }

 private:
  static constexpr double kLeastNoise = 0.05;  // px; no matcher is better

  void add(const Vector6d& jacobian, double error) {
    if (!std::isfinite(error) || !jacobian.allFinite()) return;
    normal_ += jacobian * jacobian.transpose();
    squared_error_ += error * error;
    ++count_;
  }

  Pose pose_;
  double fx_, fy_;
  Matrix6d normal_ = Matrix6d::Zero();
  double squared_error_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace stillpoint
