// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How well does a motion explain the support corners and surfaces, and which motion near by explains them best?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/rigid/reprojection_refinement.hpp"

namespace stillpoint {

/// How exact the points and planes are.
struct SupportNoise {
  double pixel_sigma = 1;  ///< pixels
  double depth_scale = 1;  ///< times what was assumed
};

/// A motion, and what speaks for it.
struct MotionHypothesis {
  Pose reference_from_current = Pose::Identity();
  /// The inverse of its covariance in the coordinates of `Motion::covariance` (rad, m), as if constraints were wrong
  /// independently of each other; zero: not refined.
  Matrix6d information = Matrix6d::Zero();
  double support = 0;  ///< summed weight of what it explains, each by how well (`SupportProblem::support`)
};

/// The weight of the points that only one of two poses explains.
struct ExclusiveSupport {
  double one = 0, other = 0;
};

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
    const Pose current_from_first = inverted(poses[0]);
    for (std::size_t f = 0; f < poses.size(); ++f) links_[f] = composed(poses[f], current_from_first);
  }

  span<const PointConstraint> points() const noexcept { return points_; }

  /// Exchanges the weights with those without the static prior; a second call goes back.
  void swap_weights() noexcept {
    for (PointConstraint& point : points_) std::swap(point.weight, point.weight_without_prior);
    for (PlaneConstraint& plane : planes_) std::swap(plane.weight, plane.weight_without_prior);
  }

  /// Measures the noise at a pose, and sets it for all.
  SupportNoise calibrate(const Pose& pose, const SupportNoise& least, const SupportNoise& most, Workspace& workspace) {
    const SupportNoise noise = noise_at(pose, least, most, workspace);
    set_pixel_sigma(noise.pixel_sigma);
    for (PointConstraint& point : points_) {
      point.inverse_depth_sigma *= noise.depth_scale;
      point.depth_slope /= noise.depth_scale;
    }
    for (PlaneConstraint& plane : planes_) plane.slope /= noise.depth_scale;
    return noise;
  }

  void set_pixel_sigma(double sigma) noexcept {
    for (PointConstraint& point : points_) point.pixel_sigma = sigma;
  }

  /// The noise of the likely static points, from the medians of their residuals. Of those that have a depth: without
  /// one the residual has other degrees of freedom.
  /// @param least, most  what is measured is held within these
  /// @return             most pixel noise and least depth noise where no point is likely static
  SupportNoise noise_at(const Pose& pose, const SupportNoise& least, const SupportNoise& most,
                        Workspace& workspace) const {
    constexpr double kLikelyStatic = 0.5;  // weight
    const Workspace::Scope scope(workspace);
    const span<double> squared_px = workspace.take<double>(points_.size());
    const span<double> squared_depth = workspace.take<double>(points_.size());
    std::size_t count = 0;
    set_poses(pose);
    for (const PointConstraint& point : points_) {
      if (!(point.weight > kLikelyStatic) || !point.has_depth()) continue;
      const PointResidual<double> residual(poses_[point.frame], camera_, point);
      if (!std::isfinite(residual.squared)) continue;
      squared_px[count] = residual.squared_px * point.pixel_sigma * point.pixel_sigma;
      squared_depth[count++] = residual.depth_error * residual.depth_error;
    }
    constexpr double kMedianOfTwo = 1.386, kMedianOfOne = 0.455;  // of χ² with so many degrees of freedom
    SupportNoise noise = {most.pixel_sigma, least.depth_scale};
    if (count > 0) {
      noise.pixel_sigma = std::sqrt(median_in_place(squared_px.first(count)) / kMedianOfTwo);
      noise.depth_scale = std::sqrt(median_in_place(squared_depth.first(count)) / kMedianOfOne);
    }
    noise.pixel_sigma = std::min(most.pixel_sigma, std::max(least.pixel_sigma, noise.pixel_sigma));
    noise.depth_scale = std::min(most.depth_scale, std::max(least.depth_scale, noise.depth_scale));
    return noise;
  }

  /// The support of a pose that all points fit exactly.
  double total_weight() const {
    double sum = 0;
    for (const PointConstraint& point : points_) sum += point.weight;
    return sum;
  }

  /// Σ weight · (1 − squared residual / limit) over the inliers among the points.
  /// @param to_beat  counting ends where this cannot be reached any more
  double point_support(const Pose& pose, double to_beat = 0.0) const {
    set_poses(pose);
    return support_of_points(to_beat);
  }

  /// The same over points and planes.
  double support(const Pose& pose) const {
    set_poses(pose);
    double sum = support_of_points(0.0);
    for (const PlaneConstraint& plane : planes_) {
      const double error = plane.slope.dot(poses_[plane.frame] * plane.point - plane.target);
      sum += plane.weight * share(error * error);
    }
    return sum;
  }

  /// Each with the weight of the points that it explains and the other does not.
  ExclusiveSupport exclusive_support(const Pose& one, const Pose& other, Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<std::uint8_t> by_one = workspace.take<std::uint8_t>(points_.size());
    set_poses(one);
    for (std::size_t k = 0; k < points_.size(); ++k) by_one[k] = is_inlier(points_[k]) ? 1 : 0;
    set_poses(other);
    ExclusiveSupport exclusive;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const bool is_of_one = by_one[k] != 0;
      if (is_of_one != is_inlier(points_[k])) (is_of_one ? exclusive.one : exclusive.other) += points_[k].weight;
    }
    return exclusive;
  }

  /// Squared residuals that a loss of support stands for.
  double squared_residuals_of(double support_loss) const noexcept { return support_loss * limit_; }

  /// Moves a pose to the best explanation near by.
  /// @return the information matrix, zero when there is no step
  Matrix6d refine(Pose& pose, span<const double> cutoffs) const {
    set_poses(pose);
    const Matrix6d information = refine_reprojection(points_, planes_, poses_, cutoffs, camera_);
    pose = poses_[0];
    return information;
  }

  /// The best explanation near a pose.
  MotionHypothesis refined(const Pose& pose, span<const double> cutoffs) const {
    MotionHypothesis hypothesis;
    hypothesis.reference_from_current = pose;
    hypothesis.information = refine(hypothesis.reference_from_current, cutoffs);
    hypothesis.support = support(hypothesis.reference_from_current);
    return hypothesis;
  }

  int inliers(const Pose& pose) const {
    set_poses(pose);
    return static_cast<int>(std::count_if(points_.begin(), points_.end(),
                                          [this](const PointConstraint& point) { return is_inlier(point); }));
  }

  /// How far apart two poses put the points, on average; one that is wild counts ten pixels.
  double distance_px(const Pose& a, const Pose& b) const {
    constexpr double kFar_px = 10.0;
    double sum = 0;
    for (const PointConstraint& point : points_) {
      const Vector3d pa = a * point.point, pb = b * point.point;
      const bool both = pa.z() > PointResidual<double>::kNearest_m && pb.z() > PointResidual<double>::kNearest_m;
      sum += both ? std::min((camera_.project(pa) - camera_.project(pb)).norm(), kFar_px) : kFar_px;
    }
    return sum / static_cast<double>(points_.size());
  }

 private:
  /// At the poses that are set, as `is_inlier`.
  double support_of_points(double to_beat) const {
    double left = total_weight(), sum = 0;
    for (std::size_t k = 0; k < points_.size() && !(sum + left < to_beat);) {
      const PointConstraint& point = points_[k];
      if (k + 1 < points_.size() && points_[k + 1].frame == point.frame) {
        const PointConstraint& next = points_[k + 1];
        const PointResidual<Lanes> both(poses_[point.frame], camera_, point, next);
        sum += point.weight * share(both.squared[0]) + next.weight * share(both.squared[1]);
        left -= point.weight + next.weight;
        k += 2;
      } else {
        sum += point.weight * share(squared_residual(point, poses_[point.frame], camera_));
        left -= point.weight;
        ++k;
      }
    }
    return sum + left < to_beat ? 0.0 : sum;
  }

  bool is_inlier(const PointConstraint& point) const {
    return squared_residual(point, poses_[point.frame], camera_) < limit_;
  }

  double share(double squared_residual) const noexcept { return std::max(0.0, 1.0 - squared_residual / limit_); }

  /// Sets the poses to all older frames, from that to the first. They are scratch memory: whoever reads them sets them.
  void set_poses(const Pose& pose) const {
    poses_[0] = pose;
    for (std::size_t f = 1; f < poses_.size(); ++f) poses_[f] = orthonormalized(composed(links_[f], pose));
  }

  span<PointConstraint> points_;
  span<PlaneConstraint> planes_;
  span<Pose> poses_, links_;
  const Camera& camera_;
  double limit_;
};

}  // namespace stillpoint
