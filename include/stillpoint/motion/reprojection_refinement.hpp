// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The motion that best explains where points and surfaces were seen in one or more older frames: iteratively reweighted
// Gauss-Newton on whitened residuals.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/small_linear_algebra.hpp"

namespace stillpoint {

/// One point of the current frame, seen again in an older one.
struct PointConstraint {
  Vector3d point = Vector3d::Zero();  ///< in the current camera, metres
  double inverse_depth_sigma = 0;     ///< of 1 / point.z, per metre: how far along its epipolar line the pixel may lie
  Vector2d pixel = Vector2d::Zero();  ///< where the older frame shows it, undistorted
  double pixel_sigma = 1;             ///< pixels
  double depth_m = 0;                 ///< what the older frame measured there, metres, 0 none
  double depth_sigma_m = 1;           ///< of the difference of both depths
  double weight = 1;                  ///< 0 to 1
  double trusted_weight = 1;          ///< what it would be if memory suspected nothing
  std::size_t frame = 0;              ///< which older frame
};

/// One point of the current frame, and the surface that an older frame shows in its place.
struct PlaneConstraint {
  Vector3d point = Vector3d::Zero();   ///< in the current camera, metres
  Vector3d target = Vector3d::Zero();  ///< on the older frame's surface, in that camera
  Vector3d normal = Vector3d::Zero();  ///< of the surface, unit length, in that camera
  double sigma_m = 0.01;               ///< of the distance along the normal
  double weight = 1;
  double trusted_weight = 1;
  std::size_t frame = 0;
};

namespace detail {

inline constexpr double kNearestDepth_m = 0.05;  // nearer, or behind the lens: no constraint
inline constexpr double kNegligible = 1e-3;      // of a variance: what adds less changes a residual by 0.05 %
inline constexpr double kNegligibleStep = 1e-4;  // squared, in standard deviations of the motion
inline constexpr double kDepthErrorLimit = 9.0;  // squared sigmas; a wrong depth must not veto a right pixel

/// The whitened error of a point: pixel noise all round, and the depth's along the epipolar direction. A point without
/// a depth is one whose inverse depth is nearly unknown: what is left of its error is Sampson's.
struct WhitenedPoint {
  Vector3d there;                        ///< the point in the older camera
  Eigen::Matrix<double, 2, 3> jacobian;  ///< ∂error / ∂there
  Vector2d error;
  double depth_error = 0;
  bool depth_counts = false;
  double squared = std::numeric_limits<double>::infinity();

  template <class Camera>
  WhitenedPoint(const PointConstraint& constraint, const Pose& reference_from_current, const Camera& camera)
      : there(reference_from_current * constraint.point) {
    if (!(there.z() > kNearestDepth_m)) return;
    const double inverse_z = 1.0 / there.z(), sigma = constraint.pixel_sigma;
    jacobian << camera.fx() * inverse_z, 0, -camera.fx() * there.x() * inverse_z * inverse_z,  //
        0, camera.fy() * inverse_z, -camera.fy() * there.y() * inverse_z * inverse_z;
    error = camera.project(there) - constraint.pixel;
    // there = R p + t with p = ray / ρ, so that ∂there / ∂ρ = −R p / ρ = (t − there) z.
    const Vector2d along = jacobian * ((reference_from_current.translation() - there) *
                                       (constraint.point.z() * constraint.inverse_depth_sigma));
    const double spread_sq = along.squaredNorm(), variance = sigma * sigma;
    Eigen::Matrix2d whiten = Eigen::Matrix2d::Identity() / sigma;
    if (spread_sq > kNegligible * variance)
      whiten += along * along.transpose() * ((1.0 / std::sqrt(variance + spread_sq) - 1.0 / sigma) / spread_sq);
    jacobian = whiten * jacobian;
    error = whiten * error;
    squared = error.squaredNorm();
    if (!(constraint.depth_m > 0)) return;
    depth_error = (there.z() - constraint.depth_m) / constraint.depth_sigma_m;
    depth_counts = depth_error * depth_error < kDepthErrorLimit;
    squared += std::min(depth_error * depth_error, kDepthErrorLimit);
  }
};

/// Tukey's biweight of a squared residual (Beaton and Tukey, 1974); 0 at the cutoff and beyond.
inline double tukey(double squared, double cutoff) noexcept {
  const double rest = 1.0 - squared / (cutoff * cutoff);
  return rest > 0 ? rest * rest : 0.0;
}

}  // namespace detail

/// The squared whitened residual: 2 degrees of freedom, 3 with a depth. `WhitenedPoint::squared` without its
/// derivatives.
template <class Camera>
double squared_residual(const PointConstraint& constraint, const Pose& reference_from_current, const Camera& camera) {
  const Vector3d there = reference_from_current * constraint.point;
  if (!(there.z() > detail::kNearestDepth_m)) return std::numeric_limits<double>::infinity();
  const double inverse_z = 1.0 / there.z(), x = there.x() * inverse_z, y = there.y() * inverse_z;
  const double error_x = camera.fx() * x + camera.cx() - constraint.pixel.x();
  const double error_y = camera.fy() * y + camera.cy() - constraint.pixel.y();
  // ∂pixel for one standard deviation of the inverse depth, as above.
  const double spread = constraint.point.z() * constraint.inverse_depth_sigma * inverse_z;
  const Vector3d from_there = reference_from_current.translation() - there;
  const double along_x = camera.fx() * spread * (from_there.x() - x * from_there.z());
  const double along_y = camera.fy() * spread * (from_there.y() - y * from_there.z());
  // Sherman and Morrison: (v I + a aᵀ)⁻¹ = (I − a aᵀ / (v + aᵀa)) / v.
  const double variance = constraint.pixel_sigma * constraint.pixel_sigma;
  const double projected = along_x * error_x + along_y * error_y;
  const double share = projected * projected / (variance + along_x * along_x + along_y * along_y);
  const double squared = (error_x * error_x + error_y * error_y - share) / variance;
  if (!(constraint.depth_m > 0)) return squared;
  const double depth_error = (there.z() - constraint.depth_m) / constraint.depth_sigma_m;
  return squared + std::min(depth_error * depth_error, detail::kDepthErrorLimit);
}

/// Looks for the small motion x = (ω, v) of the current camera that all older frames share, p' = Exp(ω) p + v, and
/// moves every `reference_from_current` by its inverse.
/// @param points, planes  what was seen; `frame` indexes `poses`
/// @param poses    one reference_from_current for each older frame, updated
/// @param cutoffs  one iteration each, sigmas; falling values anneal
/// @return         the information matrix of x, in the coordinates of `Motion::covariance`; zero when there was no
///                 step to be had, and the poses are as they were. O(constraints) an iteration.
template <class Camera>
Matrix6d refine_reprojection(span<const PointConstraint> points, span<const PlaneConstraint> planes, span<Pose> poses,
                             span<const double> cutoffs, const Camera& camera) {
  Matrix6d information = Matrix6d::Zero();
  double settled_at = 0;
  for (const double cutoff : cutoffs) {
    if (!(cutoff < settled_at || settled_at <= 0)) continue;  // once more would change nothing
    Matrix6d normal = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    for (const PointConstraint& constraint : points) {
      const Pose& pose = poses[constraint.frame];
      const detail::WhitenedPoint point(constraint, pose, camera);
      const double weight = constraint.weight * detail::tukey(point.squared, cutoff);
      if (!(weight > 0)) continue;
      // A camera that moves on by x sees the same point where x⁻¹ puts it: ∂there / ∂(ω, v) = R ([p]×, −I).
      Eigen::Matrix<double, 3, 6> motion;
      motion << pose.linear() * skew(constraint.point), -pose.linear();
      const Eigen::Matrix<double, 2, 6> rows = point.jacobian * motion;
      normal.noalias() += weight * rows.transpose() * rows;
      gradient.noalias() += weight * rows.transpose() * point.error;
      if (!point.depth_counts) continue;
      const Vector6d row = motion.row(2).transpose() / constraint.depth_sigma_m;
      normal.noalias() += weight * row * row.transpose();
      gradient += weight * point.depth_error * row;
    }
    for (const PlaneConstraint& plane : planes) {
      const Pose& pose = poses[plane.frame];
      const double error = plane.normal.dot(pose * plane.point - plane.target) / plane.sigma_m;
      const double weight = plane.weight * detail::tukey(error * error, cutoff);
      if (!(weight > 0)) continue;
      const Vector3d here = pose.linear().transpose() * plane.normal / plane.sigma_m;
      Vector6d row;
      row << here.cross(plane.point), -here;
      normal.noalias() += weight * row * row.transpose();
      gradient += weight * error * row;
    }
    // What nothing is known of stays: a thousandth of a constraint holds it.
    constexpr double kHold = 1e-6;
    const Vector6d x = -Cholesky<6>(normal + kHold * Matrix6d::Identity()).solve(gradient);
    constexpr double kLongestStep = 0.5;  // radians, metres; more is no refinement
    if (!(x.head<3>().norm() < kLongestStep) || !(x.tail<3>().norm() < kLongestStep)) return information;
    Pose step = Pose::Identity();
    step.linear() = rotation_from_vector(x.head<3>());
    step.translation() = x.tail<3>();
    const Pose back = step.inverse();
    for (Pose& pose : poses) pose = orthonormalized(pose * back);
    information = normal;
    settled_at = x.dot(normal * x) < detail::kNegligibleStep ? cutoff : 0;
  }
  return information;
}

}  // namespace stillpoint
