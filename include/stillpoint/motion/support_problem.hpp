// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How well does a motion explain the support corners and surfaces, and which motion near by explains them best?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/reprojection_refinement.hpp"

namespace stillpoint {

/// Everything that is known of one motion: points and planes in one or more older frames, whose poses to each other
/// are known, so that the pose to the first of them gives all. Views of a workspace.
template <class Camera>
class SupportProblem {
 public:
  /// @param poses          one reference_from_current for each older frame: says how they lie to each other, and is
  ///                       scratch memory from here on. At least one.
  /// @param inlier_sigmas  beyond it a constraint supports no more
  SupportProblem(span<PointConstraint> points, span<PlaneConstraint> planes, span<Pose> poses, span<Pose> links,
                 const Camera& camera, double inlier_sigmas)
      : points_(points),
        planes_(planes),
        poses_(poses),
        links_(links),
        camera_(camera),
        limit_(inlier_sigmas * inlier_sigmas) {
    const Pose current_from_first = poses[0].inverse();
    for (std::size_t f = 0; f < poses.size(); ++f) links_[f] = poses[f] * current_from_first;
  }

  span<const PointConstraint> points() const noexcept { return points_; }

  /// To the weights as if nothing were suspect; a second call goes back.
  void swap_trust() noexcept {
    for (PointConstraint& point : points_) std::swap(point.weight, point.trusted_weight);
    for (PlaneConstraint& plane : planes_) std::swap(plane.weight, plane.trusted_weight);
  }

  /// Measures the pixel noise of the trusted points, from the median of their residuals, and sets it for all.
  /// @return it, pixels, held within both limits; the upper one where nothing is trusted
  double calibrate(const Pose& pose, double least_px, double most_px, Workspace& workspace) {
    constexpr double kMedian = 1.386;  // of χ² with two degrees of freedom: 2 ln 2
    constexpr double kTrusted = 0.5;   // weight
    const Workspace::Scope scope(workspace);
    const span<double> squared_px = workspace.take<double>(points_.size());
    std::size_t count = 0;
    spread(pose);
    for (const PointConstraint& point : points_) {
      if (!(point.weight > kTrusted)) continue;
      const detail::WhitenedPoint whitened(point, poses_[point.frame], camera_);
      if (std::isfinite(whitened.squared))
        squared_px[count++] = whitened.error.squaredNorm() * point.pixel_sigma * point.pixel_sigma;
    }
    double sigma_px = most_px;
    if (count > 0)
      sigma_px = std::min(most_px, std::max(least_px, std::sqrt(median_in_place(squared_px.first(count)) / kMedian)));
    for (PointConstraint& point : points_) point.pixel_sigma = sigma_px;
    return sigma_px;
  }

  double squared(const PointConstraint& point, const Pose& pose) const {
    return squared_residual(point, point.frame == 0 ? pose : Pose(links_[point.frame] * pose), camera_);
  }

  /// Σ weight · (1 − squared residual / limit) over the inliers among the points.
  /// @param to_beat  counting ends where this cannot be reached any more
  double point_support(const Pose& pose, double to_beat = 0.0) const {
    spread(pose);
    double left = 0, sum = 0;
    for (const PointConstraint& point : points_) left += point.weight;
    for (const PointConstraint& point : points_) {
      sum += point.weight * share(squared_residual(point, poses_[point.frame], camera_));
      left -= point.weight;
      if (sum + left < to_beat) return 0.0;
    }
    return sum;
  }

  /// The same over points and planes.
  double support(const Pose& pose) const {
    double sum = point_support(pose);
    for (const PlaneConstraint& plane : planes_) {
      const double error = plane.normal.dot(poses_[plane.frame] * plane.point - plane.target) / plane.sigma_m;
      sum += plane.weight * share(error * error);
    }
    return sum;
  }

  /// Squared residuals that a loss of support stands for.
  double squared_residuals_of(double support_loss) const noexcept { return support_loss * limit_; }

  /// Moves a pose to the best explanation near by.
  /// @return the information matrix, zero when there was no step to be had
  Matrix6d refine(Pose& pose, span<const double> cutoffs) const {
    spread(pose);
    const Matrix6d information = refine_reprojection(points_, planes_, poses_, cutoffs, camera_);
    pose = poses_[0];
    return information;
  }

  int inliers(const Pose& pose) const {
    return static_cast<int>(std::count_if(points_.begin(), points_.end(),
                                          [&](const PointConstraint& point) { return squared(point, pose) < limit_; }));
  }

  /// How far apart two poses put the points, on average; one that is wild counts ten pixels.
  double distance_px(const Pose& a, const Pose& b) const {
    constexpr double kFar_px = 10.0;
    double sum = 0;
    for (const PointConstraint& point : points_) {
      const Vector3d pa = a * point.point, pb = b * point.point;
      const bool both = pa.z() > detail::kNearestDepth_m && pb.z() > detail::kNearestDepth_m;
      sum += both ? std::min((camera_.project(pa) - camera_.project(pb)).norm(), kFar_px) : kFar_px;
    }
    return sum / static_cast<double>(points_.size());
  }

 private:
  double share(double squared_residual) const noexcept { return std::max(0.0, 1.0 - squared_residual / limit_); }

  /// From the pose to the first older frame to those of all.
  void spread(const Pose& pose) const {
    poses_[0] = pose;
    for (std::size_t f = 1; f < poses_.size(); ++f) poses_[f] = orthonormalized(links_[f] * pose);
  }

  span<PointConstraint> points_;
  span<PlaneConstraint> planes_;
  span<Pose> poses_, links_;
  const Camera& camera_;
  double limit_;
};

}  // namespace stillpoint
