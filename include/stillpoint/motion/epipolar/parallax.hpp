// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The two simpler motions that the fundamental matrix can't tell from others: a pure rotation, and any motion before a
// plane. Both are estimators for `ransac`, so that the ego-motion can ask whether they explain the matches.

#include <Eigen/LU>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/kabsch.hpp"

namespace stillpoint {

/// A camera that only turns: current ray ~ R reference ray. The residual is in pixels of the current image; what is
/// left of a match is its parallax.
template <class Camera>
class RotationEstimator {
 public:
  using Model = Matrix3d;
  static constexpr std::size_t kSampleSize = 2;
  static constexpr std::size_t kMaxModels = 1;

  /// @param reference_rays, current_rays  z = 1, aligned, in random order; views that must outlive the estimator
  RotationEstimator(span<const Vector3d> reference_rays, span<const Vector3d> current_rays, const Camera& camera)
      : reference_(reference_rays), current_(current_rays), fx_(camera.fx()), fy_(camera.fy()) {}

  std::size_t size() const noexcept { return reference_.size(); }

  std::size_t solve(span<const std::size_t> sample, span<Model> models) const { return fit(sample, models[0]) ? 1 : 0; }

  float squared_residual(const Model& rotation, std::size_t i) const noexcept {
    const Vector3d turned = rotation * reference_[i];
    const double x = fx_ * (turned.x() / turned.z() - current_[i].x());
    const double y = fy_ * (turned.y() / turned.z() - current_[i].y());
    const double behind = std::numeric_limits<double>::infinity();
    return static_cast<float>(turned.z() > 0.0 ? x * x + y * y : behind);
  }

  bool refine(span<const std::uint32_t> inliers, Model& rotation) const { return fit(inliers, rotation); }

 private:
  /// Two rays nearer than 1e-3 rad determine the rotation about them too badly: the second singular value is about a
  /// quarter of the squared angle.
  static constexpr double kRankTolerance = 2.5e-7;

  template <class Index>
  bool fit(span<Index> subset, Model& rotation) const {
    Matrix3d correlation = Matrix3d::Zero();
    for (const auto i : subset) correlation += current_[i].normalized() * reference_[i].normalized().transpose();
    const std::optional<Matrix3d> found = rotation_from_correlation(correlation, kRankTolerance);
    if (found) rotation = *found;
    return found.has_value();
  }

  span<const Vector3d> reference_, current_;
  double fx_, fy_;
};

/// A plane, seen by two cameras whose F is known: H = [e']× F − e' vᵀ has three degrees of freedom, and three matches
/// give them. Source: Hartley and Zisserman, "Multiple View Geometry", 2nd ed., result 13.6. The residual is in pixels
/// of the current image.
class PlaneEstimator {
 public:
  using Model = Matrix3d;  ///< the homography current_from_reference, of the normalised points
  static constexpr std::size_t kSampleSize = 3;
  static constexpr std::size_t kMaxModels = 1;

  /// @param reference, current  aligned, in random order, near 1 in size; views that must outlive the estimator
  /// @param fundamental         of these points
  /// @param px_per_unit         pixels of the current image that one unit of `current` is
  PlaneEstimator(span<const Vector2d> reference, span<const Vector2d> current, const Matrix3d& fundamental,
                 double px_per_unit)
      : reference_(reference), current_(current), px_per_unit_(px_per_unit) {
    // The epipole is orthogonal to all columns of F: the largest of their cross products is the best conditioned.
    for (const int column : {0, 1, 2}) {
      const Vector3d product = fundamental.col(column).cross(fundamental.col((column + 1) % 3));
      if (product.norm() > epipole_.norm()) epipole_ = product;
    }
    epipole_.normalize();
    fixed_part_ = skew(epipole_) * fundamental;
  }

  std::size_t size() const noexcept { return reference_.size(); }

  std::size_t solve(span<const std::size_t> sample, span<Model> models) const { return fit(sample, models[0]) ? 1 : 0; }

  float squared_residual(const Model& homography, std::size_t i) const noexcept {
    const Vector3d moved = homography * reference_[i].homogeneous();
    const Vector2d offset = moved.head<2>() / moved.z() - current_[i];
    return static_cast<float>(offset.squaredNorm() * px_per_unit_ * px_per_unit_);
  }

  bool refine(span<const std::uint32_t> inliers, Model& homography) const { return fit(inliers, homography); }

 private:
  template <class Index>
  bool fit(span<Index> subset, Model& homography) const {
    Matrix3d normal = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (const auto i : subset) {
      const Vector3d p = reference_[i].homogeneous(), c = current_[i].homogeneous();
      const Vector3d constraint = c.cross(epipole_);  // c × (fixed p) = (c × e') (vᵀ p)
      normal += constraint.squaredNorm() * p * p.transpose();
      right += constraint.dot(c.cross(fixed_part_ * p)) * p;
    }
    const double determinant = normal.determinant(), size = normal.trace();
    if (!(determinant > 1e-12 * size * size * size)) return false;  // three on a line leave the plane turning about it
    homography = fixed_part_ - epipole_ * (normal.inverse() * right).transpose();
    return homography.allFinite();
  }

  span<const Vector2d> reference_, current_;
  double px_per_unit_;
  Vector3d epipole_ = Vector3d::Zero();
  Matrix3d fixed_part_;
};

}  // namespace stillpoint
