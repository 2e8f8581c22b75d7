// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Can a camera have moved so?

#include "stillpoint/core/fixed_size_operators.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// Whether a pose is one: finite, and a rotation with a translation but for what rounding and drift leave.
inline bool is_rigid(const Pose& pose) {
  constexpr double kDrift = 0.01;  // of products of many rotations in single precision, far more than rounding
  const Matrix3d rotation = rotation_of(pose);
  return is_finite(pose.matrix()) && largest_magnitude(rotation) < 2.0 &&
         (transposed(rotation) * rotation - Matrix3d(Matrix3d::Identity())).norm() < kDrift &&
         rotation.determinant() > 0.0;  // no mirror
}

/// Whether a camera may have moved so from one frame to the next: rigid, and no farther than 100 m (what a train of
/// 360 km/h makes in a second). More is another unit, or a jump to another place.
inline bool is_plausible_motion(const Pose& current_from_reference) {
  constexpr double kFarthest_m = 100.0;
  return is_rigid(current_from_reference) && translation_of(current_from_reference).norm() <= kFarthest_m;
}

}  // namespace stillpoint
