// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Normal equations of a small motion of the current camera, from what it does to single points.

#include <algorithm>
#include <iterator>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/lanes.hpp"

namespace stillpoint {

/// What the residuals of one point say of its place: Σ w g gᵀ and Σ w e g over residuals e with ∂e/∂point = gᵀ.
/// @tparam Real  double, or `Lanes` for two points at once
template <class Real>
struct PointEquations {
  Real xx, xy, xz, yy, yz, zz;
  Real x, y, z;
};

/// Σ w J Jᵀ and Σ w e J by the six numbers (ω, v) that move the older camera's points: p' = p − ω × p − v, so that a
/// residual has J = (g × p, −g). Plain sums, because Eigen's products of this size go through memory.
template <class Real>
class MotionEquations {
 public:
  MotionEquations() {
    std::fill(std::begin(rotation_), std::end(rotation_), lanes_of<Real>(0.0));
    std::fill(std::begin(mixed_), std::end(mixed_), lanes_of<Real>(0.0));
    std::fill(std::begin(translation_), std::end(translation_), lanes_of<Real>(0.0));
    std::fill(std::begin(gradient_), std::end(gradient_), lanes_of<Real>(0.0));
  }

  /// @param p  in the older camera: x, y, z
  template <class Point>
  void add(const Point& p, const PointEquations<Real>& s) {
    const Real &px = p.x, &py = p.y, &pz = p.z;
    // The columns of Σ w (g × p) gᵀ.
    const Real xx = s.xy * pz - s.xz * py, yx = s.xz * px - s.xx * pz, zx = s.xx * py - s.xy * px;
    const Real xy = s.yy * pz - s.yz * py, yy = s.yz * px - s.xy * pz, zy = s.xy * py - s.yy * px;
    const Real xz = s.yz * pz - s.zz * py, yz = s.zz * px - s.xz * pz, zz = s.xz * py - s.yz * px;
    mixed_[0] += xx, mixed_[1] += xy, mixed_[2] += xz;
    mixed_[3] += yx, mixed_[4] += yy, mixed_[5] += yz;
    mixed_[6] += zx, mixed_[7] += zy, mixed_[8] += zz;
    // Its rows once more times p: the lower triangle of Σ w (g × p) (g × p)ᵀ.
    rotation_[0] += xy * pz - xz * py;
    rotation_[1] += yy * pz - yz * py;
    rotation_[2] += yz * px - yx * pz;
    rotation_[3] += zy * pz - zz * py;
    rotation_[4] += zz * px - zx * pz;
    rotation_[5] += zx * py - zy * px;
    translation_[0] += s.xx, translation_[1] += s.xy, translation_[2] += s.yy;
    translation_[3] += s.xz, translation_[4] += s.yz, translation_[5] += s.zz;
    gradient_[0] += s.y * pz - s.z * py;
    gradient_[1] += s.z * px - s.x * pz;
    gradient_[2] += s.x * py - s.y * px;
    gradient_[3] -= s.x, gradient_[4] -= s.y, gradient_[5] -= s.z;
  }

  Matrix6d matrix() const {
    Matrix6d matrix;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int lower = i < j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j;
        matrix(i, j) = sum_of(rotation_[lower]);
        matrix(i, 3 + j) = matrix(3 + j, i) = -sum_of(mixed_[3 * i + j]);
        matrix(3 + i, 3 + j) = sum_of(translation_[lower]);
      }
    return matrix;
  }

  Vector6d gradient() const {
    Vector6d gradient;
    for (int i = 0; i < 6; ++i) gradient[i] = sum_of(gradient_[i]);
    return gradient;
  }

 private:
  Real rotation_[6], mixed_[9], translation_[6], gradient_[6];  // triangles, and a square, row by row
};

/// From x = (ω, v) of the current camera, p' = Exp(ω) p + v, to what it does to the points of an older one:
/// there − R(ω × p) − R v with R p = there − t.
inline Matrix6d motion_of_older_points(const Pose& reference_from_current) {
  const Matrix3d rotation = rotation_of(reference_from_current);
  const Matrix3d lever = skew(translation_of(reference_from_current)) * rotation;
  Matrix6d adjoint = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      adjoint(i, j) = adjoint(3 + i, 3 + j) = rotation(i, j);
      adjoint(3 + i, j) = lever(i, j);
    }
  return adjoint;
}

}  // namespace stillpoint
