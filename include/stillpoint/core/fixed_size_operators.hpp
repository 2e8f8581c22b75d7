// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Sums, differences and products of Eigen's matrices of fixed size, in plain loops that return a matrix. Eigen's own
// operators make a new type for every expression, which costs every file that includes the library seconds of compile
// time. In this namespace `a + b` means these: they match the types exactly, Eigen's only by a base class. Where one
// side is itself an expression of Eigen's, as in `a + b.cross(c)`, Eigen's operator is taken.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// Column-major, of a size that is known when the code is compiled; else there is no such type.
template <class Scalar, int Rows, int Columns>
using FixedMatrix = std::enable_if_t<(Rows > 0 && Columns > 0), Eigen::Matrix<Scalar, Rows, Columns>>;

template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Rows, Columns> operator+(const Eigen::Matrix<Scalar, Rows, Columns>& a,
                                             const Eigen::Matrix<Scalar, Rows, Columns>& b) {
  Eigen::Matrix<Scalar, Rows, Columns> sum;
  for (int i = 0; i < Rows * Columns; ++i) sum.data()[i] = a.data()[i] + b.data()[i];
  return sum;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Rows, Columns> operator-(const Eigen::Matrix<Scalar, Rows, Columns>& a,
                                             const Eigen::Matrix<Scalar, Rows, Columns>& b) {
  Eigen::Matrix<Scalar, Rows, Columns> difference;
  for (int i = 0; i < Rows * Columns; ++i) difference.data()[i] = a.data()[i] - b.data()[i];
  return difference;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Rows, Columns> operator-(const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Eigen::Matrix<Scalar, Rows, Columns> negative;
  for (int i = 0; i < Rows * Columns; ++i) negative.data()[i] = -a.data()[i];
  return negative;
}

template <class Factor, class Scalar, int Rows, int Columns,
          class = std::enable_if_t<std::is_same<Factor, Scalar>::value>>
FixedMatrix<Scalar, Rows, Columns> operator*(const Factor& factor, const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Eigen::Matrix<Scalar, Rows, Columns> product;
  for (int i = 0; i < Rows * Columns; ++i) product.data()[i] = factor * a.data()[i];
  return product;
}

template <class Factor, class Scalar, int Rows, int Columns,
          class = std::enable_if_t<std::is_same<Factor, Scalar>::value>>
FixedMatrix<Scalar, Rows, Columns> operator*(const Eigen::Matrix<Scalar, Rows, Columns>& a, const Factor& factor) {
  return factor * a;
}

template <class Divisor, class Scalar, int Rows, int Columns,
          class = std::enable_if_t<std::is_same<Divisor, Scalar>::value>>
FixedMatrix<Scalar, Rows, Columns> operator/(const Eigen::Matrix<Scalar, Rows, Columns>& a, const Divisor& divisor) {
  Eigen::Matrix<Scalar, Rows, Columns> quotient;
  for (int i = 0; i < Rows * Columns; ++i) quotient.data()[i] = a.data()[i] / divisor;
  return quotient;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Rows, Columns>& operator+=(Eigen::Matrix<Scalar, Rows, Columns>& a,
                                               const Eigen::Matrix<Scalar, Rows, Columns>& b) {
  return a = a + b;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Rows, Columns>& operator-=(Eigen::Matrix<Scalar, Rows, Columns>& a,
                                               const Eigen::Matrix<Scalar, Rows, Columns>& b) {
  return a = a - b;
}

template <class Factor, class Scalar, int Rows, int Columns,
          class = std::enable_if_t<std::is_same<Factor, Scalar>::value>>
FixedMatrix<Scalar, Rows, Columns>& operator*=(Eigen::Matrix<Scalar, Rows, Columns>& a, const Factor& factor) {
  return a = factor * a;
}

template <class Divisor, class Scalar, int Rows, int Columns,
          class = std::enable_if_t<std::is_same<Divisor, Scalar>::value>>
FixedMatrix<Scalar, Rows, Columns>& operator/=(Eigen::Matrix<Scalar, Rows, Columns>& a, const Divisor& divisor) {
  return a = a / divisor;
}

/// Each sum from its first term to its last, as in Eigen's products.
template <class Scalar, int Rows, int Inner, int Columns>
FixedMatrix<Scalar, Rows, Columns> operator*(const Eigen::Matrix<Scalar, Rows, Inner>& a,
                                             const Eigen::Matrix<Scalar, Inner, Columns>& b) {
  Eigen::Matrix<Scalar, Rows, Columns> product;
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < Columns; ++j) {
      Scalar sum = a(i, 0) * b(0, j);
      for (int k = 1; k < Inner; ++k) sum += a(i, k) * b(k, j);
      product(i, j) = sum;
    }
  return product;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<double, Rows, Columns> to_double(const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Eigen::Matrix<double, Rows, Columns> result;
  for (int i = 0; i < Rows * Columns; ++i) result.data()[i] = static_cast<double>(a.data()[i]);
  return result;
}

template <class Scalar, int Rows, int Columns>
FixedMatrix<float, Rows, Columns> to_float(const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Eigen::Matrix<float, Rows, Columns> result;
  for (int i = 0; i < Rows * Columns; ++i) result.data()[i] = static_cast<float>(a.data()[i]);
  return result;
}

/// The transpose. By its elements: g++ 12 says of Eigen's, with -O1 and its assertions, that it may be uninitialised.
template <class Scalar, int Rows, int Columns>
FixedMatrix<Scalar, Columns, Rows> transposed(const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Eigen::Matrix<Scalar, Columns, Rows> result;
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < Columns; ++j) result(j, i) = a(i, j);
  return result;
}

/// The largest magnitude of an entry; entries that are NaN do not count.
template <class Scalar, int Rows, int Columns>
Scalar largest_magnitude(const Eigen::Matrix<Scalar, Rows, Columns>& a) {
  Scalar largest = 0;
  for (int i = 0; i < Rows * Columns; ++i) largest = std::max(largest, std::abs(a.data()[i]));
  return largest;
}

/// A rigid motion applied to a point.
inline Eigen::Vector3d operator*(const Eigen::Isometry3d& motion, const Eigen::Vector3d& p) {
  const Eigen::Matrix4d& m = motion.matrix();
  return {m(0, 0) * p.x() + m(0, 1) * p.y() + m(0, 2) * p.z() + m(0, 3),
          m(1, 0) * p.x() + m(1, 1) * p.y() + m(1, 2) * p.z() + m(1, 3),
          m(2, 0) * p.x() + m(2, 1) * p.y() + m(2, 2) * p.z() + m(2, 3)};
}

}  // namespace stillpoint
