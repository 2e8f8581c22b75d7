// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Normal equations of a small motion of the current camera, from what it does to single points.

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// What the residuals of one point say of its place: Σ w g gᵀ and Σ w e g over residuals e with ∂e/∂point = gᵀ.
struct PointEquations {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double x = 0, y = 0, z = 0;

  /// Of one residual.
  static PointEquations of(const Vector3d& slope, double error, double weight) noexcept {
    const double x = slope.x(), y = slope.y(), z = slope.z();
    const double wx = weight * x, wy = weight * y, wz = weight * z;
    return {wx * x, wx * y, wx * z, wy * y, wy * z, wz * z, wx * error, wy * error, wz * error};
  }
};

/// Σ w J Jᵀ and Σ w e J by the six numbers (ω, v) that move the older camera's points: p' = p − ω × p − v, so that a
/// residual has J = (g × p, −g). Plain sums, because Eigen's products of this size go through memory.
class MotionEquations {
 public:
  /// @param p  in the older camera
  void add(const Vector3d& p, const PointEquations& s) noexcept {
    const double px = p.x(), py = p.y(), pz = p.z();
    // The columns of Σ w (g × p) gᵀ.
    const double xx = s.xy * pz - s.xz * py, yx = s.xz * px - s.xx * pz, zx = s.xx * py - s.xy * px;
    const double xy = s.yy * pz - s.yz * py, yy = s.yz * px - s.xy * pz, zy = s.xy * py - s.yy * px;
    const double xz = s.yz * pz - s.zz * py, yz = s.zz * px - s.xz * pz, zz = s.xz * py - s.yz * px;
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
        matrix(i, j) = rotation_[lower];
        matrix(i, 3 + j) = matrix(3 + j, i) = -mixed_[3 * i + j];
        matrix(3 + i, 3 + j) = translation_[lower];
      }
    return matrix;
  }

  Vector6d gradient() const { return Eigen::Map<const Vector6d>(gradient_); }

 private:
  double rotation_[6] = {}, mixed_[9] = {}, translation_[6] = {};  // triangles, and a square, row by row
  double gradient_[6] = {};
};

/// From x = (ω, v) of the current camera, p' = Exp(ω) p + v, to what it does to the points of an older one:
/// there − R(ω × p) − R v with R p = there − t.
inline Matrix6d motion_of_older_points(const Pose& reference_from_current) {
  const Matrix3d rotation = reference_from_current.linear();
  Matrix6d adjoint;
  adjoint << rotation, Matrix3d::Zero(), skew(reference_from_current.translation()) * rotation, rotation;
  return adjoint;
}

}  // namespace stillpoint
