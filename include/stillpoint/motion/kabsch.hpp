// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Rotation and translation between two sets of points or directions, in closed form.
// Sources: Kabsch, "A Solution for the Best Rotation to Relate Two Sets of Vectors", 1976, solved by quaternions as
// Horn, "Closed-Form Solution of Absolute Orientation Using Unit Quaternions", JOSA A 1987.

#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// The rotation R that maximises trace(R Cᵀ) for C = Σ w target sourceᵀ: best in the sense of least squares.
/// @return nothing if the second singular value is below `rank_tolerance` of the first: all vectors lie on one line,
///         and the rotation about it is not determined. Not finite: nothing.
inline std::optional<Matrix3d> rotation_from_correlation(const Matrix3d& correlation, double rank_tolerance = 1e-9) {
  const double size = largest_magnitude(correlation);
  if (!is_finite(correlation) || !(size > 0.0)) return std::nullopt;
  Matrix3d s = transposed(correlation);  // Horn's Sxy is s(0, 1)
  s /= size;
  // trace(R Cᵀ) = qᵀ N q with the unit quaternion q = (w, x, y, z): the best is the eigenvector of the largest value.
  Eigen::Matrix4d n;
  n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),   //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),   //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const SymmetricEigen<4> eigen(n);
  // The values are a + b + c, a − b − c, b − a − c, c − a − b of singular values a ≥ b ≥ |c|; c has the determinant's
  // sign.
  const double first = eigen.value(3) + eigen.value(2), second = eigen.value(3) + eigen.value(1);
  if (!(second > rank_tolerance * first)) return std::nullopt;
  const Eigen::Vector4d q = eigen.vector(3);
  return rotation_from_quaternion(q(0), q(1), q(2), q(3));
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
    correlation += outer_product(weight(i) * (target[i] - target_centroid), source[i] - source_centroid);
  // Rounding leaves about 1e-16 of the squared distance to the origin: points nearer together than that coincide.
  const double rounding = 1e-14 * total * (source_centroid.squaredNorm() + target_centroid.squaredNorm());
  if (!(largest_magnitude(correlation) > rounding)) return std::nullopt;
  const std::optional<Matrix3d> rotation = rotation_from_correlation(correlation);
  if (!rotation) return std::nullopt;
  return make_pose(*rotation, target_centroid - *rotation * source_centroid);
}

}  // namespace stillpoint
