// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The fundamental matrix of eight or more matches: normalised, linear, then made singular.
// Source: Hartley, "In Defense of the Eight-Point Algorithm", PAMI 1997.

#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Moves points to their centroid and scales them to a mean distance of √2 (Hartley 1997, section 4).
struct Normalization {
  Vector2d centroid = Vector2d::Zero();
  double scale = 1.0;

  Normalization() = default;
  /// Not finite points, or points that all coincide, leave a scale that is not finite or 1.
  explicit Normalization(span<const Vector2d> points) {
    if (points.empty()) return;
    const double count = static_cast<double>(points.size());
    for (const Vector2d& point : points) centroid += point / count;
    double distance = 0.0;
    for (const Vector2d& point : points) distance += (point - centroid).norm() / count;
    scale = distance > 0.0 ? std::sqrt(2.0) / distance : 1.0;
  }

  Vector2d operator()(const Vector2d& point) const { return scale * (point - centroid); }

  Matrix3d matrix() const {
    Matrix3d m;
    m << scale, 0, -scale * centroid.x(), 0, scale, -scale * centroid.y(), 0, 0, 1;
    return m;
  }
};

/// The nearest singular matrix (Frobenius norm): the smallest singular value becomes 0. Hartley 1997, section 2.2.
inline Matrix3d nearest_singular(const Matrix3d& f) {
  const Eigen::JacobiSVD<Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d sigma = svd.singularValues();
  sigma.z() = 0.0;
  return svd.matrixU() * sigma.asDiagonal() * svd.matrixV().transpose();
}

/// Weighted least squares on currentᵀ F reference = 0, for points that are normalised already.
///
/// A constraint's row is the Kronecker product of the two points, and so is its outer product: 6 × 6 sums of monomials
/// hold all 9 × 9 of the normal equations.
class FundamentalNormalEquations {
 public:
  void add(const Vector2d& reference, const Vector2d& current, double weight = 1.0) {
    sums_.noalias() += weight * monomials(current) * monomials(reference).transpose();
  }

  /// @return false unless one solution stands out: the points are too few, coincide, or lie on a line or a plane
  bool solve(Matrix3d& f) const {
    // monomials() holds xx xy x yy y 1; kPair[i][j] is the place of the product of coordinates i and j of (x, y, 1).
    constexpr int kPair[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    Matrix9d normal;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) normal(3 * i + j, 3 * k + l) = sums_(kPair[i][k], kPair[j][l]);
    if (!normal.allFinite()) return false;
    const SymmetricEigen<9> eigen(normal);
    // The eigenvalues are squared singular values: rounding leaves about 1e-15 of the largest.
    constexpr double kRankTolerance = 1e-13;
    if (!(eigen.value(1) > kRankTolerance * eigen.value(8))) return false;
    const Vector9d solution = eigen.vector(0);
    f = nearest_singular(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(solution.data()));
    const double norm = f.norm();
    f /= norm;
    return std::isfinite(norm) && norm > 0;
  }

 private:
  using Matrix9d = Eigen::Matrix<double, 9, 9>;
  using Vector9d = Eigen::Matrix<double, 9, 1>;

  static Vector6d monomials(const Vector2d& p) {
    Vector6d m;
    m << p.x() * p.x(), p.x() * p.y(), p.x(), p.y() * p.y(), p.y(), 1.0;
    return m;
  }

  Matrix6d sums_ = Matrix6d::Zero();
};

/// The eight-point algorithm as a minimal solver. Coordinates should be near 1 in size; F is scaled to norm 1.
struct FundamentalEightPoint {
  static constexpr std::size_t kSampleSize = 8;
  static constexpr std::size_t kMaxModels = 1;

  /// @param reference, current  eight points each; currentᵀ F reference = 0
  /// @return 1, or 0 when the points do not determine F
  static std::size_t solve(const std::array<Vector2d, 8>& reference, const std::array<Vector2d, 8>& current,
                           span<Matrix3d> models) {
    FundamentalNormalEquations equations;
    for (std::size_t i = 0; i < 8; ++i) equations.add(reference[i], current[i]);
    return equations.solve(models[0]) ? 1 : 0;
  }
};

/// F of eight or more matches in pixels, all weighted alike: currentᵀ F reference = 0, norm 1.
/// @return false when the matches do not determine F, or are fewer than eight
inline bool fundamental_eight_point(span<const Vector2d> reference, span<const Vector2d> current, Matrix3d& f) {
  if (reference.size() < 8 || current.size() != reference.size()) return false;
  const Normalization normalize_reference(reference), normalize_current(current);
  FundamentalNormalEquations equations;
  for (std::size_t i = 0; i < reference.size(); ++i)
    equations.add(normalize_reference(reference[i]), normalize_current(current[i]));
  if (!equations.solve(f)) return false;
  f = normalize_current.matrix().transpose() * f * normalize_reference.matrix();
  f /= f.norm();
  return f.allFinite();
}

}  // namespace stillpoint
