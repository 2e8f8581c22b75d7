// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The fundamental matrix with the least geometric error, from one that is near.

#include <Eigen/SVD>

#include <cmath>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"

namespace stillpoint {

/// A singular 3 × 3 matrix of norm 1 in its seven degrees of freedom: F = U diag(cos φ, sin φ, 0) Vᵀ, with U and V
/// rotations. Source: Bartoli and Sturm, "Nonlinear Estimation of the Fundamental Matrix with Minimal Parameters", PAMI
/// 2004. One Gauss-Newton step: `add` every match, then `step`.
class FundamentalRefinement {
 public:
  /// @param f             any matrix; it is made singular
  /// @param squared_noise_ratio (σ_reference / σ_current)², where the two images are scaled differently
  explicit FundamentalRefinement(const Matrix3d& f, double squared_noise_ratio = 1.0)
      : squared_noise_ratio_(squared_noise_ratio) {
    const Eigen::JacobiSVD<Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    u_ = svd.matrixU();  // a reflection is as good: only small rotations of it are used
    v_ = svd.matrixV();
    phi_ = std::atan2(svd.singularValues()(1), svd.singularValues()(0));
    begin();
  }

  Matrix3d fundamental() const { return u_ * singular_values().asDiagonal() * v_.transpose(); }

  /// Adds a match with Sampson's error: the algebraic one over its first-order standard deviation, which is held
  /// constant. Source: Hartley and Zisserman, section 11.4.3.
  void add(const Vector2d& reference, const Vector2d& current) {
    const Vector3d p = reference.homogeneous(), c = current.homogeneous();
    const double variance =
        (f_ * p).head<2>().squaredNorm() + squared_noise_ratio_ * (f_.transpose() * c).head<2>().squaredNorm();
    const Vector3d in_u = u_.transpose() * c, in_v = v_.transpose() * p;
    const Vector3d scaled_u = sigma_.cwiseProduct(in_u), scaled_v = sigma_.cwiseProduct(in_v);
    const Vector3d by_u = scaled_v.cross(in_u), by_v = scaled_u.cross(in_v);
    const double by_phi = sigma_.x() * in_u.y() * in_v.y() - sigma_.y() * in_u.x() * in_v.x();
    const double row[8] = {by_u.x(), by_u.y(), by_u.z(), by_v.x(), by_v.y(), by_v.z(), by_phi, in_u.dot(scaled_v)};
    const double weight = 1.0 / variance;
    // The normal equations, and their right hand side as an eighth row.
    for (int i = 0; i < 7; ++i) {
      const double weighted = weight * row[i];
      for (int k = 0; k < 8; ++k) sums_(k, i) += weighted * row[k];
    }
  }

  /// Moves to the least squares solution of the linearised problem. @return false, unmoved, if there is none
  bool step() {
    const Vector7d update = -Cholesky<7>(sums_.topRows<7>()).solve(sums_.row(7).transpose());
    if (!(update.norm() < 1.0)) return false;  // NaN where the matches do not determine it
    u_ *= rotation_from_vector(update.head<3>());
    v_ *= rotation_from_vector(update.segment<3>(3));
    phi_ += update(6);
    begin();
    return true;
  }

 private:
  using Vector7d = Eigen::Matrix<double, 7, 1>;

  Vector3d singular_values() const { return {std::cos(phi_), std::sin(phi_), 0.0}; }

  void begin() {
    sigma_ = singular_values();
    f_ = fundamental();
    sums_.setZero();
  }

  double squared_noise_ratio_;
  Matrix3d u_, v_, f_;
  double phi_ = 0.0;
  Vector3d sigma_;
  Eigen::Matrix<double, 8, 7> sums_;
};

}  // namespace stillpoint
