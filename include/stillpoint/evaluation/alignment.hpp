// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The rigid motion or similarity that lays one set of points on another with the least squared distance.

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cstddef>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/trajectory.hpp"

namespace stillpoint {

/// What may be changed to lay an estimate on its reference.
enum class Alignment {
  none,  ///< nothing: both are in the same frame already
  se3,   ///< rotation and translation
  sim3,  ///< and scale: for an estimate from one camera without depth
};

enum class AlignmentStatus {
  ok,
  too_few_points,  ///< fewer than three
  collinear,       ///< the points of a set coincide or lie on a line: the rotation about it is free
  not_finite,      ///< a coordinate is NaN or infinite
};

/// x ↦ scale · rotation · x + translation, from the source's frame to the target's.
struct Similarity {
  double scale = 1.0;
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d translation = Vector3d::Zero();

  Vector3d operator*(const Vector3d& p_source) const { return scale * (rotation * p_source) + translation; }
};

struct AlignmentResult {
  AlignmentStatus status = AlignmentStatus::ok;
  Similarity target_from_source;  ///< the identity unless `status` is ok
};

/// Finds the similarity, or with a scale of 1 the rigid motion, that minimises Σ ‖target_i − T source_i‖².
/// Source: Umeyama, "Least-Squares Estimation of Transformation Parameters Between Two Point Patterns", PAMI 1991,
/// Eq. (34) to (43).
/// @param source, target  N points each, metres; `source[i]` belongs to `target[i]`.
/// @param with_scale      whether the scale is estimated.
/// @return        never a reflection; a status other than ok where the data do not determine the rotation.
/// @throws Error if the two sizes differ.   Cost O(N).
inline AlignmentResult align_points(span<const Vector3d> source, span<const Vector3d> target, bool with_scale) {
  if (source.size() != target.size())
    throw Error("align_points: " + std::to_string(source.size()) + " source and " + std::to_string(target.size()) +
                " target points, expected as many of each");
  AlignmentResult result;
  const auto fail = [&result](AlignmentStatus status) {
    result.status = status;
    return result;
  };
  for (std::size_t i = 0; i < source.size(); ++i)
    if (!source[i].allFinite() || !target[i].allFinite()) return fail(AlignmentStatus::not_finite);
  if (source.size() < 3) return fail(AlignmentStatus::too_few_points);

  const double count = static_cast<double>(source.size());
  Vector3d source_mean = Vector3d::Zero(), target_mean = Vector3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    source_mean += source[i] / count;
    target_mean += target[i] / count;
  }
  Matrix3d covariance = Matrix3d::Zero();
  double source_variance = 0.0, target_variance = 0.0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Vector3d from_mean = source[i] - source_mean;
    covariance += (target[i] - target_mean) * from_mean.transpose() / count;
    source_variance += from_mean.squaredNorm() / count;
    target_variance += (target[i] - target_mean).squaredNorm() / count;
  }
  // Points that coincide differ from their mean by its rounding, some 1e-16 of their distance from the origin.
  constexpr double kCoincide = 1e-10;
  const auto coincide = [](double variance, const Vector3d& mean) {
    return !(variance > kCoincide * kCoincide * mean.squaredNorm());
  };
  if (coincide(source_variance, source_mean) || coincide(target_variance, target_mean))
    return fail(AlignmentStatus::collinear);

  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d& singular = svd.singularValues();
  // The second value is the product of both sets' extents across their longest direction: 1e-12 of the first is a
  // millionth of the length in each. The rounding of points on a line stays far below (about 1e-16).
  constexpr double kSmallestSpreadRatio = 1e-12;
  if (!(singular[1] > kSmallestSpreadRatio * singular[0])) return fail(AlignmentStatus::collinear);

  Vector3d signs = Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;  // else it would be a mirror
  Similarity& similarity = result.target_from_source;
  similarity.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  if (with_scale) similarity.scale = singular.dot(signs) / source_variance;
  similarity.translation = target_mean - similarity.scale * (similarity.rotation * source_mean);
  return result;
}

/// Moves the world of a trajectory: positions by the whole similarity, orientations by its rotation.
inline Trajectory transformed(const Similarity& target_from_world, Trajectory trajectory) {
  for (StampedPose& pose : trajectory) {
    pose.world_from_camera.translation() = target_from_world * Vector3d(pose.world_from_camera.translation());
    pose.world_from_camera.linear() = target_from_world.rotation * pose.world_from_camera.linear();
  }
  return trajectory;
}

/// The alignment that lays the camera positions of `pairs.estimate` on those of `pairs.reference`.
/// @return        the identity with status ok for `Alignment::none`; else as `align_points`.
inline AlignmentResult align(const AssociatedTrajectories& pairs, Alignment alignment) {
  if (alignment == Alignment::none) return {};
  std::vector<Vector3d> source, target;
  for (const StampedPose& pose : pairs.estimate) source.push_back(pose.world_from_camera.translation());
  for (const StampedPose& pose : pairs.reference) target.push_back(pose.world_from_camera.translation());
  return align_points(source, target, alignment == Alignment::sim3);
}

}  // namespace stillpoint
