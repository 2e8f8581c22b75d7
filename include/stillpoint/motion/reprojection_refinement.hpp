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
#include "stillpoint/motion/motion_equations.hpp"
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
  Vector3d slope =
      Vector3d::Zero();  ///< of the surface, in that camera: its normal over the distance's sigma in metres
  double weight = 1;
  double trusted_weight = 1;
  std::size_t frame = 0;
};

namespace detail {

inline constexpr double kNearestDepth_m = 0.05;  // nearer, or behind the lens: no constraint
inline constexpr double kNegligibleStep = 1e-4;  // squared, in standard deviations of the motion
inline constexpr double kDepthErrorLimit = 9.0;  // squared sigmas; a wrong depth must not veto a right pixel

/// How far from its place an older frame shows a point. The pixel's covariance is σ² I + a aᵀ: noise all round, and a,
/// what one standard deviation of the inverse depth moves it along its epipolar line. A point without a depth is one
/// whose inverse depth is nearly unknown: what is left of its error is Sampson's.
struct PointResidual {
  Vector3d there;                                               ///< the point in the older camera
  double x = 0, y = 0, inverse_z = 0;                           ///< where it is seen, on the plane z = 1
  Vector2d off_px = Vector2d::Zero();                           ///< expected minus seen
  double xx = 0, xy = 0, yy = 0;                                ///< the pixel's information, (σ² I + a aᵀ)⁻¹
  double squared_px = std::numeric_limits<double>::infinity();  ///< off_pxᵀ information off_px
  double squared = std::numeric_limits<double>::infinity();     ///< and the depth's
  double depth_error = 0, depth_slope = 0;                      ///< whitened; by depth, per metre
  bool depth_counts = false;

  template <class Camera>
  PointResidual(const PointConstraint& constraint, const Pose& reference_from_current, const Camera& camera)
      : there(reference_from_current * constraint.point) {
    if (!(there.z() > kNearestDepth_m)) return;
    inverse_z = 1.0 / there.z();
    x = there.x() * inverse_z;
    y = there.y() * inverse_z;
    off_px = {camera.fx() * x + camera.cx() - constraint.pixel.x(),
              camera.fy() * y + camera.cy() - constraint.pixel.y()};
    // there = R p + t with p = ray / ρ, so that ∂there / ∂ρ = −R p / ρ = (t − there) z.
    const Vector3d from_there = reference_from_current.translation() - there;
    const double spread = constraint.point.z() * constraint.inverse_depth_sigma * inverse_z;
    const double along_x = camera.fx() * spread * (from_there.x() - x * from_there.z());
    const double along_y = camera.fy() * spread * (from_there.y() - y * from_there.z());
    // Sherman and Morrison: (v I + a aᵀ)⁻¹ = (I − a aᵀ / (v + aᵀa)) / v.
    const double variance = constraint.pixel_sigma * constraint.pixel_sigma;
    const double scale = 1.0 / (variance * (variance + along_x * along_x + along_y * along_y));
    xx = scale * (variance + along_y * along_y);
    xy = -scale * along_x * along_y;
    yy = scale * (variance + along_x * along_x);
    squared_px = xx * off_px.x() * off_px.x() + 2 * xy * off_px.x() * off_px.y() + yy * off_px.y() * off_px.y();
    squared = squared_px;
    if (!(constraint.depth_m > 0)) return;
    depth_slope = 1.0 / constraint.depth_sigma_m;
    depth_error = (there.z() - constraint.depth_m) * depth_slope;
    depth_counts = depth_error * depth_error < kDepthErrorLimit;
    squared += std::min(depth_error * depth_error, kDepthErrorLimit);
  }

  /// By `there`: ∂pixel / ∂there has the rows fx (1, 0, −x) / z and fy (0, 1, −y) / z.
  template <class Camera>
  PointEquations equations(double weight, const Camera& camera) const {
    const double fx = camera.fx() * inverse_z, fy = camera.fy() * inverse_z;
    PointEquations equations;
    equations.xx = weight * fx * fx * xx;
    equations.xy = weight * fx * fy * xy;
    equations.yy = weight * fy * fy * yy;
    equations.xz = -(equations.xx * x + equations.xy * y);
    equations.yz = -(equations.xy * x + equations.yy * y);
    equations.zz = -(equations.xz * x + equations.yz * y);
    equations.x = weight * fx * (xx * off_px.x() + xy * off_px.y());
    equations.y = weight * fy * (xy * off_px.x() + yy * off_px.y());
    equations.z = -(equations.x * x + equations.y * y);
    if (!depth_counts) return equations;
    equations.zz += weight * depth_slope * depth_slope;
    equations.z += weight * depth_slope * depth_error;
    return equations;
  }
};

/// Tukey's biweight of a squared residual (Beaton and Tukey, 1974); 0 at the cutoff and beyond.
class Tukey {
 public:
  explicit Tukey(double cutoff) noexcept : inverse_limit_(1.0 / (cutoff * cutoff)) {}

  double operator()(double squared) const noexcept {
    const double rest = 1.0 - squared * inverse_limit_;
    return rest > 0 ? rest * rest : 0.0;
  }

 private:
  double inverse_limit_;
};

/// Those of one older frame, among constraints in the order of their frames.
template <class Constraint>
span<const Constraint> in_frame(span<const Constraint> constraints, std::size_t frame) {
  const auto begin = std::partition_point(constraints.begin(), constraints.end(),
                                          [frame](const Constraint& constraint) { return constraint.frame < frame; });
  const auto end = std::partition_point(begin, constraints.end(),
                                        [frame](const Constraint& constraint) { return constraint.frame == frame; });
  return constraints.subspan(static_cast<std::size_t>(begin - constraints.begin()),
                             static_cast<std::size_t>(end - begin));
}

/// What one older frame says, weighted by Tukey.
template <class Camera>
MotionEquations equations_of(span<const PointConstraint> points, span<const PlaneConstraint> planes,
                             const Pose& reference_from_current, const Tukey& tukey, const Camera& camera) {
  MotionEquations equations;
  for (const PointConstraint& constraint : points) {
    const PointResidual point(constraint, reference_from_current, camera);
    const double weight = constraint.weight * tukey(point.squared);
    if (!(weight > 0)) continue;
    equations.add(point.there, point.equations(weight, camera));
  }
  for (const PlaneConstraint& plane : planes) {
    const Vector3d there = reference_from_current * plane.point;
    const double error = plane.slope.dot(there - plane.target);
    const double weight = plane.weight * tukey(error * error);
    if (weight > 0) equations.add(there, PointEquations::of(plane.slope, error, weight));
  }
  return equations;
}

}  // namespace detail

/// The squared whitened residual: 2 degrees of freedom, 3 with a depth.
template <class Camera>
double squared_residual(const PointConstraint& constraint, const Pose& reference_from_current, const Camera& camera) {
  return detail::PointResidual(constraint, reference_from_current, camera).squared;
}

/// Looks for the small motion x = (ω, v) of the current camera that all older frames share, p' = Exp(ω) p + v, and
/// moves every `reference_from_current` by its inverse.
/// @param points, planes  what was seen, in the order of `frame`, which indexes `poses`
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
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
      const MotionEquations equations =
          detail::equations_of(detail::in_frame(points, frame), detail::in_frame(planes, frame), poses[frame],
                               detail::Tukey(cutoff), camera);
      const Matrix6d adjoint = motion_of_older_points(poses[frame]);
      normal += adjoint.transpose() * equations.matrix() * adjoint;
      gradient += adjoint.transpose() * equations.gradient();
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
