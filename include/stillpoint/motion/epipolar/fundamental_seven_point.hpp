// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The fundamental matrix through seven matches: one or three solutions.
// Source: Hartley and Zisserman, "Multiple View Geometry", 2nd ed., section 11.1.2.

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Real roots of c3 x³ + c2 x² + c1 x + c0, ascending order not guaranteed, double roots once or twice. A leading
/// coefficient that is negligible beside the others counts as zero. Source: the trigonometric solution (Viète), then
/// Newton's method against cancellation.
/// @return how many of `roots` were written, 0 to 3
inline std::size_t real_roots(double c3, double c2, double c1, double c0, std::array<double, 3>& roots) {
  constexpr double kNegligible = 1e-12;
  const double size = std::max({std::abs(c2), std::abs(c1), std::abs(c0)});
  if (!(std::abs(c3) > kNegligible * size)) {
    if (!(std::abs(c2) > kNegligible * size)) {
      if (!(std::abs(c1) > 0.0)) return 0;
      roots[0] = -c0 / c1;
      return 1;
    }
    const double discriminant = c1 * c1 - 4 * c2 * c0;
    if (!(discriminant >= 0)) return 0;
    const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
    roots[0] = q / c2;
    if (!(std::abs(q) > 0)) return 1;
    roots[1] = c0 / q;
    return 2;
  }
  const double a = c2 / c3, b = c1 / c3, c = c0 / c3, shift = a / 3;
  const double q = (a * a - 3 * b) / 9, r = (a * (2 * a * a - 9 * b) + 27 * c) / 54;
  std::size_t count = 0;
  if (r * r < q * q * q) {
    constexpr double kThirdOfTurn = 2.0943951023931953;  // 2π / 3
    const double root_q = std::sqrt(q), angle = std::acos(std::clamp(r / (q * root_q), -1.0, 1.0)) / 3;
    for (const double turn : {0.0, kThirdOfTurn, -kThirdOfTurn})
      roots[count++] = -2 * root_q * std::cos(angle + turn) - shift;
  } else {
    const double s = -std::copysign(std::cbrt(std::abs(r) + std::sqrt(std::max(r * r - q * q * q, 0.0))), r);
    roots[count++] = (s != 0 ? s + q / s : 0.0) - shift;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double x = roots[i], slope = (3 * x + 2 * a) * x + b;
    if (std::abs(slope) > 0) {
      const double step = (((x + a) * x + b) * x + c) / slope;
      if (std::abs(step) < 1e-3 * (1 + std::abs(x))) roots[i] = x - step;  // not near a double root
    }
  }
  return count;
}

/// Minimal solver. Coordinates should be near 1 in size (see `Normalization`), F is scaled to norm 1.
struct FundamentalSevenPoint {
  static constexpr std::size_t kSampleSize = 7;
  static constexpr std::size_t kMaxModels = 3;

  /// @param reference, current  seven points each; currentᵀ F reference = 0
  /// @return how many of `models` were written; 0 when the points leave more than two degrees of freedom (repeated
  ///         points, four on a line, six on a plane's homography ...) or are not finite
  static std::size_t solve(const std::array<Vector2d, 7>& reference, const std::array<Vector2d, 7>& current,
                           span<Matrix3d> models) {
    Matrix3d first, second;
    if (!null_space(reference, current, first, second)) return 0;
    // det(x first + second) = 0, a cubic in x.
    const Matrix3d first_adjugate = adjugate(first), second_adjugate = adjugate(second);
    const double c3 = (first.row(0) * first_adjugate.col(0)).value();
    const double c0 = (second.row(0) * second_adjugate.col(0)).value();
    const double c2 = (first_adjugate * second).trace(), c1 = (second_adjugate * first).trace();
    std::array<double, 3> roots;
    const std::size_t count = real_roots(c3, c2, c1, c0, roots);
    std::size_t written = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Matrix3d f = roots[i] * first + second;
      const double norm = f.norm();
      if (std::isfinite(norm) && norm > 0) models[written++] = f / norm;
    }
    return written;
  }

 private:
  using RowMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  static Matrix3d adjugate(const Matrix3d& m) {
    Matrix3d a;
    a.row(0) = m.col(1).cross(m.col(2)).transpose();
    a.row(1) = m.col(2).cross(m.col(0)).transpose();
    a.row(2) = m.col(0).cross(m.col(1)).transpose();
    return a;
  }

  /// The two matrices that every constraint row annihilates. Gauss elimination with a column pivot for each row: two
  /// orders of magnitude faster than an SVD, and exact enough for points of normalised size.
  static bool null_space(const std::array<Vector2d, 7>& reference, const std::array<Vector2d, 7>& current,
                         Matrix3d& first, Matrix3d& second) {
    constexpr double kRankTolerance = 1e-9;  // rounding of rows whose entries are near 1
    double a[7][9];
    for (std::size_t i = 0; i < 7; ++i) {
      const double x = reference[i].x(), y = reference[i].y(), u = current[i].x(), v = current[i].y();
      const double row[9] = {u * x, u * y, u, v * x, v * y, v, x, y, 1.0};
      std::copy(row, row + 9, a[i]);
    }
    std::size_t column[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    for (std::size_t r = 0; r < 7; ++r) {
      std::size_t pivot = r;
      for (std::size_t c = r + 1; c < 9; ++c)
        if (std::abs(a[r][c]) > std::abs(a[r][pivot])) pivot = c;
      if (!(std::abs(a[r][pivot]) > kRankTolerance)) return false;
      if (pivot != r) {
        for (std::size_t i = 0; i < 7; ++i) std::swap(a[i][r], a[i][pivot]);
        std::swap(column[r], column[pivot]);
      }
      const double inverse = 1.0 / a[r][r];
      for (std::size_t i = r + 1; i < 7; ++i) {
        const double factor = a[i][r] * inverse;
        for (std::size_t c = r + 1; c < 9; ++c) a[i][c] -= factor * a[r][c];
      }
    }
    double solution[2][9];
    for (std::size_t k = 0; k < 2; ++k) {
      double x[9] = {};
      x[7 + k] = 1.0;
      for (std::size_t r = 7; r-- > 0;) {
        double sum = a[r][7 + k];
        for (std::size_t c = r + 1; c < 7; ++c) sum += a[r][c] * x[c];
        x[r] = -sum / a[r][r];
      }
      for (std::size_t c = 0; c < 9; ++c) solution[k][column[c]] = x[c];
    }
    first = Eigen::Map<const RowMatrix3d>(solution[0]);
    second = Eigen::Map<const RowMatrix3d>(solution[1]);
    return first.allFinite() && second.allFinite();
  }
};

}  // namespace stillpoint
