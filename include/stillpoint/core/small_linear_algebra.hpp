// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Normal equations of a few unknowns, in plain loops. Eigen's solvers of these sizes unroll into so many templates that
// they cost every file that includes the library seconds of compile time.

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// xᵀ A x.
template <int N>
double quadratic_form(const Eigen::Matrix<double, N, N>& a, const Eigen::Matrix<double, N, 1>& x) {
  double sum = 0;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) sum += x(i) * a(i, j) * x(j);
  return sum;
}

/// A = L Lᵀ of a symmetric positive definite matrix; the lower triangle is read. O(N³), no allocation.
/// Source: Golub and Van Loan, "Matrix Computations", 4th ed., algorithm 4.2.1.
template <int N>
class Cholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit Cholesky(const Matrix& a) {
    constexpr double kRounding = 1e-15;  // what subtraction leaves of a diagonal entry that should be 0
    for (int j = 0; j < N; ++j) {
      double pivot = a(j, j);
      for (int k = 0; k < j; ++k) pivot -= l_[j][k] * l_[j][k];
      if (!(pivot > kRounding * a(j, j)) || !std::isfinite(pivot)) return;
      l_[j][j] = std::sqrt(pivot);
      for (int i = j + 1; i < N; ++i) {
        double sum = a(i, j);
        for (int k = 0; k < j; ++k) sum -= l_[i][k] * l_[j][k];
        l_[i][j] = sum / l_[j][j];
      }
    }
    positive_definite_ = true;
  }

  /// False: not positive definite, or not finite; then there is no solution.
  bool positive_definite() const noexcept { return positive_definite_; }

  /// A⁻¹ b; NaN without a solution.
  Vector solve(const Vector& b) const {
    Vector x = b;
    if (!positive_definite_) return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < i; ++k) x(i) -= l_[i][k] * x(k);
      x(i) /= l_[i][i];
    }
    for (int i = N; i-- > 0;) {
      for (int k = i + 1; k < N; ++k) x(i) -= l_[k][i] * x(k);
      x(i) /= l_[i][i];
    }
    return x;
  }

  /// A⁻¹, exactly symmetric; NaN without one.
  Matrix inverse() const {
    Matrix result;
    for (int j = 0; j < N; ++j) {
      Vector unit = Vector::Zero();
      unit(j) = 1.0;
      const Vector column = solve(unit);
      for (int i = 0; i < N; ++i) result(i, j) = column(i);
    }
    for (int j = 0; j < N; ++j)
      for (int i = j + 1; i < N; ++i) result(i, j) = result(j, i) = 0.5 * (result(i, j) + result(j, i));
    return result;
  }

 private:
  static constexpr std::size_t kSize = N;
  double l_[kSize][kSize];
  bool positive_definite_ = false;
};

/// The matrix with a little more on its diagonal: holds what nothing is known of.
template <int N>
Eigen::Matrix<double, N, N> damped(Eigen::Matrix<double, N, N> matrix, double damping) {
  for (int i = 0; i < N; ++i) matrix(i, i) += damping;
  return matrix;
}

/// Eigenvalues and vectors of a symmetric matrix, which must be finite, by cyclic rotations. No allocation.
/// Source: Golub and Van Loan, algorithm 8.5.3 (Jacobi).
template <int N>
class SymmetricEigen {
 public:
  explicit SymmetricEigen(const Eigen::Matrix<double, N, N>& a) {
    double size = 0.0;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        a_[i][j] = 0.5 * (a(i, j) + a(j, i));
        v_[i][j] = i == j ? 1.0 : 0.0;
        size += a_[i][j] * a_[i][j];
      }
    // Converges quadratically: six to nine sweeps for 9 x 9.
    for (int sweep = 0; sweep < kMaxSweeps && off_diagonal() > kRounding * kRounding * size; ++sweep)
      for (int p = 0; p < N; ++p)
        for (int q = p + 1; q < N; ++q) rotate(p, q);
    for (int i = 0; i < N; ++i) order_[i] = i;
    for (int i = 1; i < N; ++i)
      for (int j = i; j > 0 && a_[order_[j]][order_[j]] < a_[order_[j - 1]][order_[j - 1]]; --j) {
        const int swapped = order_[j];
        order_[j] = order_[j - 1];
        order_[j - 1] = swapped;
      }
  }

  /// The k-th smallest.
  double value(int k) const noexcept { return a_[order_[k]][order_[k]]; }

  /// Its vector, length 1; the sign is arbitrary.
  Eigen::Matrix<double, N, 1> vector(int k) const {
    Eigen::Matrix<double, N, 1> result;
    for (int i = 0; i < N; ++i) result(i) = v_[i][order_[k]];
    return result;
  }

 private:
  static constexpr int kMaxSweeps = 30;
  static constexpr double kRounding = std::numeric_limits<double>::epsilon();

  double off_diagonal() const noexcept {
    double sum = 0.0;
    for (int i = 0; i < N; ++i)
      for (int j = i + 1; j < N; ++j) sum += a_[i][j] * a_[i][j];
    return sum;
  }

  /// Makes a_[p][q] zero.
  void rotate(int p, int q) noexcept {
    if (!(std::abs(a_[p][q]) > 0.0)) return;
    const double tau = (a_[q][q] - a_[p][p]) / (2.0 * a_[p][q]);
    const double tangent = std::copysign(1.0, tau) / (std::abs(tau) + std::hypot(1.0, tau));
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
    const auto turn = [cosine, sine](double& x, double& y) {
      const double old = x;
      x = cosine * old - sine * y;
      y = sine * old + cosine * y;
    };
    for (int k = 0; k < N; ++k) turn(a_[k][p], a_[k][q]);
    for (int k = 0; k < N; ++k) turn(a_[p][k], a_[q][k]);
    for (int k = 0; k < N; ++k) turn(v_[k][p], v_[k][q]);
  }

  static constexpr std::size_t kSize = N;
  double a_[kSize][kSize], v_[kSize][kSize];
  int order_[kSize];
};

}  // namespace stillpoint
