// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What an older frame shows of a point or a surface of the current one, and how far that is from where a motion puts
// it.

#include <cstddef>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/lanes.hpp"
#include "stillpoint/core/reprojection_information.hpp"
#include "stillpoint/motion/rigid/motion_equations.hpp"

namespace stillpoint {

/// One point of the current frame, seen again in an older one.
struct PointConstraint {
  Vector3d point = Vector3d::Zero();  ///< in the current camera, metres
  double inverse_depth_sigma = 0;     ///< of 1 / point.z, per metre: how far along its epipolar line the pixel may lie
  Vector2d pixel = Vector2d::Zero();  ///< where the older frame shows it, undistorted
  double pixel_sigma = 1;             ///< pixels
  double depth_m = 0;                 ///< what the older frame measured there, metres
  double depth_slope = 0;             ///< 1 / σ of the difference of both depths, per metre; 0: no depth was measured
  double weight = 1;                  ///< 0 to 1
  double weight_without_prior = 1;    ///< the same without the static prior
  std::size_t frame = 0;              ///< which older frame
  std::size_t feature = 0;            ///< which feature of the current one

  bool has_depth() const noexcept { return depth_slope > 0; }
};

/// One point of the current frame, and the surface that an older frame shows in its place.
struct PlaneConstraint {
  Vector3d point = Vector3d::Zero();   ///< in the current camera, metres
  Vector3d target = Vector3d::Zero();  ///< on the older frame's surface, in that camera
  Vector3d slope = Vector3d::Zero();   ///< of the surface, in that camera: its normal over the distance's σ, per metre
  double weight = 1;
  double weight_without_prior = 1;
  std::size_t frame = 0;
};

/// Where a motion puts a point of the current camera in an older one.
/// @tparam Real  double, or `Lanes` for two points at once
template <class Real>
struct MovedPoint {
  Real x, y, z;

  /// @param points  as many as `Real` has lanes
  template <class... Points>
  explicit MovedPoint(const Pose& reference_from_current, const Points&... points) {
    const Eigen::Matrix4d& m = reference_from_current.matrix();
    const Real px = lanes(points.x()...), py = lanes(points.y()...), pz = lanes(points.z()...);
    x = m(0, 0) * px + m(0, 1) * py + m(0, 2) * pz + m(0, 3);
    y = m(1, 0) * px + m(1, 1) * py + m(1, 2) * pz + m(1, 3);
    z = m(2, 0) * px + m(2, 1) * py + m(2, 2) * pz + m(2, 3);
  }
};

/// How far from its place an older frame shows a point. The pixel's covariance is σ² I + a aᵀ: noise all round, and a,
/// what one standard deviation of the inverse depth moves it along its epipolar line. A point without a depth is one
/// whose inverse depth is nearly unknown: what is left of its error is Sampson's.
template <class Real>
struct PointResidual {
  MovedPoint<Real> there;         ///< in the older camera
  Real x, y, inverse_z;           ///< where that is seen, on the plane z = 1
  Real off_x, off_y;              ///< pixels, expected minus seen
  Real xx, xy, yy;                ///< the pixel's information, (σ² I + a aᵀ)⁻¹
  Real squared_px;                ///< offᵀ information off
  Real depth_error, depth_slope;  ///< whitened; by depth, 0 where it is too wrong to count
  Real squared;                   ///< of both, the depth's held within a limit: it must not veto a right pixel

  /// Nearer, or behind the lens, nothing is seen: squares are infinite.
  static constexpr double kNearest_m = 0.05;
  static constexpr double kDepthErrorLimit = 9.0;  ///< squared

  /// @param constraints  as many as `Real` has lanes
  template <class Camera, class... Constraints>
  PointResidual(const Pose& reference_from_current, const Camera& camera, const Constraints&... constraints)
      : there(reference_from_current, constraints.point...) {
    inverse_z = 1.0 / there.z;
    x = there.x * inverse_z;
    y = there.y * inverse_z;
    off_x = camera.fx() * x + camera.cx() - lanes(constraints.pixel.x()...);
    off_y = camera.fy() * y + camera.cy() - lanes(constraints.pixel.y()...);
    const Real spread = lanes((constraints.point.z() * constraints.inverse_depth_sigma)...) * inverse_z;
    const EpipolarShift<Real> shift(camera, translation_of(reference_from_current), there.x, there.y, there.z, x, y,
                                    spread);
    const Real variance = lanes((constraints.pixel_sigma * constraints.pixel_sigma)...);
    const ReprojectionInformation<Real> information(variance, shift);
    xx = information.xx;
    xy = information.xy;
    yy = information.yy;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    squared_px =
        where<Real>(there.z > kNearest_m, information.squared_distance(off_x, off_y), lanes_of<Real>(kInfinity));
    depth_slope = lanes(constraints.depth_slope...);
    depth_error = (there.z - lanes(constraints.depth_m...)) * depth_slope;
    const Real depth_squared = depth_error * depth_error;
    squared =
        squared_px + where<Real>(depth_squared < kDepthErrorLimit, depth_squared, lanes_of<Real>(kDepthErrorLimit));
    depth_slope = where<Real>(depth_squared < kDepthErrorLimit, depth_slope, lanes_of<Real>(0.0));
  }

  /// By `there`: ∂pixel / ∂there has the rows fx (1, 0, −x) / z and fy (0, 1, −y) / z.
  template <class Camera>
  PointEquations<Real> equations(const Real& weight, const Camera& camera) const {
    const Real fx = camera.fx() * inverse_z, fy = camera.fy() * inverse_z;
    PointEquations<Real> equations;
    equations.xx = weight * fx * fx * xx;
    equations.xy = weight * fx * fy * xy;
    equations.yy = weight * fy * fy * yy;
    equations.xz = -(equations.xx * x + equations.xy * y);
    equations.yz = -(equations.xy * x + equations.yy * y);
    equations.zz = weight * depth_slope * depth_slope - (equations.xz * x + equations.yz * y);
    equations.x = weight * fx * (xx * off_x + xy * off_y);
    equations.y = weight * fy * (xy * off_x + yy * off_y);
    equations.z = weight * depth_slope * depth_error - (equations.x * x + equations.y * y);
    return equations;
  }
};

/// How far from a surface a point is put.
template <class Real>
struct PlaneResidual {
  MovedPoint<Real> there;
  Real slope_x, slope_y, slope_z;
  Real error;  ///< whitened

  template <class... Constraints>
  explicit PlaneResidual(const Pose& reference_from_current, const Constraints&... constraints)
      : there(reference_from_current, constraints.point...),
        slope_x(lanes(constraints.slope.x()...)),
        slope_y(lanes(constraints.slope.y()...)),
        slope_z(lanes(constraints.slope.z()...)) {
    error = slope_x * (there.x - lanes(constraints.target.x()...)) +
            slope_y * (there.y - lanes(constraints.target.y()...)) +
            slope_z * (there.z - lanes(constraints.target.z()...));
  }

  PointEquations<Real> equations(const Real& weight) const {
    const Real x = weight * slope_x, y = weight * slope_y, z = weight * slope_z;
    return {x * slope_x, x * slope_y, x * slope_z, y * slope_y, y * slope_z,
            z * slope_z, x * error,   y * error,   z * error};
  }
};

/// The squared whitened residual: 2 degrees of freedom, 3 with a depth.
template <class Camera>
double squared_residual(const PointConstraint& constraint, const Pose& reference_from_current, const Camera& camera) {
  return PointResidual<double>(reference_from_current, camera, constraint).squared;
}

}  // namespace stillpoint
