// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where do two rays meet?

#include <limits>

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// The depths along both rays of the points where they are nearest to each other, in units of the translation.
struct RayDepths {
  double reference = std::numeric_limits<double>::quiet_NaN();
  double current = std::numeric_limits<double>::quiet_NaN();

  /// Both finite and in front of their cameras.
  bool in_front() const noexcept { return reference > 0.0 && current > 0.0; }
};

/// Midpoint triangulation: least squares on current_depth · current_ray = R reference_depth · reference_ray + t.
/// @param reference_ray, current_ray  each in its own camera's frame, z = 1, so that depths are along the optical axis
/// @return                            NaN when the rays are parallel: then there is no depth
inline RayDepths triangulate(const Pose& current_from_reference, const Vector3d& reference_ray,
                             const Vector3d& current_ray) {
  const Vector3d turned = current_from_reference.linear() * reference_ray;
  const Vector3d& t = current_from_reference.translation();
  const double a = turned.squaredNorm(), b = turned.dot(current_ray), c = current_ray.squaredNorm();
  const double determinant = a * c - b * b;  // squared sine of the angle between the rays, times a c
  RayDepths depths;
  if (!(determinant > 1e-14 * a * c)) return depths;  // 1e-7 rad: far below a pixel, above rounding
  depths.reference = (b * current_ray.dot(t) - c * turned.dot(t)) / determinant;
  depths.current = (a * current_ray.dot(t) - b * turned.dot(t)) / determinant;
  return depths;
}

}  // namespace stillpoint
