// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Rotation and translation between two sets of points or directions, in closed form.
// Sources: Kabsch, "A Solution for the Best Rotation to Relate Two Sets of Vectors", 1976; Umeyama, PAMI 1991, for the
// reflection.

#include <Eigen/SVD>

#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// The rotation R that maximises trace(R Cᵀ) for C = Σ w target sourceᵀ: best in the sense of least squares.
/// @return nothing if the second singular value is below `rank_tolerance` of the first: all vectors lie on one line,
/// and
///         the rotation about it is not determined. Not finite: nothing.
inline std::optional<Matrix3d> rotation_from_correlation(const Matrix3d& correlation, double rank_tolerance = 1e-9) {
  const double size = correlation.cwiseAbs().maxCoeff();
  if (!correlation.allFinite() || !(size > 0.0)) return std::nullopt;
  const Eigen::JacobiSVD<Matrix3d> svd(correlation / size, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()(1) > rank_tolerance * svd.singularValues()(0))) return std::nullopt;
  const double handedness = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector3d(1.0, 1.0, handedness).asDiagonal() * svd.matrixV().transpose();
}

/// The rigid motion that minimises Σ w ‖target − (R source + t)‖². Metres.
/// @param source, target  as many as each other, at least three
/// @param weights         not negative, one a pair; empty: all equal
/// @return                target_from_source; nothing when the points are fewer than three, not finite, coincide or lie
///                        on one line. O(n).
inline std::optional<Pose> kabsch(span<const Vector3d> source, span<const Vector3d> target,
                                  span<const double> weights = {}) {
  const std::size_t count = source.size();
  if (count < 3 || target.size() != count || (!weights.empty() && weights.size() != count)) return std::nullopt;
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  double total = 0.0;
  Vector3d source_sum = Vector3d::Zero(), target_sum = Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    total += weight(i);
    source_sum += weight(i) * source[i];
    target_sum += weight(i) * target[i];
  }
  if (!(total > 0.0)) return std::nullopt;
  const Vector3d source_centroid = source_sum / total, target_centroid = target_sum / total;
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
    correlation += weight(i) * (target[i] - target_centroid) * (source[i] - source_centroid).transpose();
  // Rounding leaves about 1e-16 of the squared distance to the origin: points nearer together than that coincide.
  const double rounding = 1e-14 * total * (source_centroid.squaredNorm() + target_centroid.squaredNorm());
  if (!(correlation.cwiseAbs().maxCoeff() > rounding)) return std::nullopt;
  const std::optional<Matrix3d> rotation = rotation_from_correlation(correlation);
  if (!rotation) return std::nullopt;
  Pose target_from_source = Pose::Identity();
  target_from_source.linear() = *rotation;
  target_from_source.translation() = target_centroid - *rotation * source_centroid;
  return target_from_source;
}

}  // namespace stillpoint
