// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Names for the Eigen types that cross stage borders.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

#include "stillpoint/core/fixed_size_operators.hpp"
#include "stillpoint/core/no_fast_math.hpp"

namespace stillpoint {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Rigid motion, named `target_from_source`: maps points of source into target, metres.
using Pose = Eigen::Isometry3d;

// By elements, as in fixed_size_operators.hpp: Eigen's blocks of a matrix are types of their own.

inline Matrix3d rotation_of(const Pose& pose) {
  Matrix3d rotation;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) rotation(row, column) = pose.matrix()(row, column);
  return rotation;
}

inline Vector3d translation_of(const Pose& pose) {
  const Eigen::Matrix4d& matrix = pose.matrix();
  return {matrix(0, 3), matrix(1, 3), matrix(2, 3)};
}

inline Pose make_pose(const Matrix3d& rotation, const Vector3d& translation) {
  Pose pose = Pose::Identity();
  Eigen::Matrix4d& matrix = pose.matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix(row, column) = rotation(row, column);
    matrix(row, 3) = translation(row);
  }
  return pose;
}

/// For messages and figures; the library computes in radians.
inline constexpr double kDegreesPerRadian = 57.29577951308232;

/// A small motion x = (ω, v): rotation vector, translation.
inline Vector3d rotation_part(const Vector6d& x) { return {x(0), x(1), x(2)}; }
inline Vector3d translation_part(const Vector6d& x) { return {x(3), x(4), x(5)}; }
inline Vector6d joined(const Vector3d& rotation, const Vector3d& translation) {
  Vector6d x;
  for (int i = 0; i < 3; ++i) {
    x(i) = rotation(i);
    x(3 + i) = translation(i);
  }
  return x;
}

/// Whether no entry is infinite or NaN.
template <class Scalar, int Rows, int Columns>
bool is_finite(const Eigen::Matrix<Scalar, Rows, Columns>& m) noexcept {
  for (int i = 0; i < Rows * Columns; ++i)
    if (!std::isfinite(m.data()[i])) return false;
  return true;
}

/// What std::lround gives, for what fits an int, without a call: half a pixel is rounded away from 0. In floats
/// throughout: by way of doubles GCC 12 at -O3 rounds pairs of doubles that were made float before as if they were not.
inline int rounded(float pixel) noexcept {
  constexpr float kBelowHalf = 0x1.fffffep-2f;  // ½ itself would carry what is just below it over
  return static_cast<int>(pixel + std::copysign(kBelowHalf, pixel));
}

/// The pixel in whose square a place lies.
inline Vector2f rounded(const Vector2f& pixel) noexcept {
  return {static_cast<float>(rounded(pixel.x())), static_cast<float>(rounded(pixel.y()))};
}

/// The matrix of the cross product: skew(a) * b = a × b.
inline Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// a bᵀ.
inline Matrix3d outer_product(const Vector3d& a, const Vector3d& b) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = a(i) * b(j);
  return m;
}

/// Rotation by the vector ω (axis times angle, radians): Rodrigues' formula, I cos + [a]× sin + a aᵀ (1 - cos). Written
/// out, as Eigen::AngleAxis has it, which takes every file longer to compile.
inline Matrix3d rotation_from_vector(const Vector3d& omega) {
  const double angle = omega.norm();
  if (angle < 1e-12) return Matrix3d(Matrix3d::Identity()) + skew(omega);
  const double x = omega.x() / angle, y = omega.y() / angle, z = omega.z() / angle;
  const double sine = std::sin(angle), cosine = std::cos(angle), versine = 1.0 - cosine;
  const double xy = versine * x * y, xz = versine * x * z, yz = versine * y * z;
  Matrix3d rotation;
  rotation << versine * x * x + cosine, xy - sine * z, xz + sine * y,  //
      xy + sine * z, versine * y * y + cosine, yz - sine * x,          //
      xz - sine * y, yz + sine * x, versine * z * z + cosine;
  return rotation;
}

/// Angle of a rotation, radians in [0, π]. Taken from sine and cosine, so that small angles keep their digits.
inline double rotation_angle(const Matrix3d& rotation) {
  const Vector3d axis_sine(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                           rotation(1, 0) - rotation(0, 1));
  return std::atan2(axis_sine.norm(), rotation.trace() - 1.0);
}

/// The vector ω of a rotation, radians: the inverse of `rotation_from_vector`.
inline Vector3d vector_from_rotation(const Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Vector3d axis(q.x(), q.y(), q.z());
  const double sine = axis.norm();  // of half the angle
  if (!(sine > 1e-12)) return (q.w() < 0.0 ? -2.0 : 2.0) * axis;
  return 2.0 * std::atan2(sine, std::abs(q.w())) * (axis / (q.w() < 0.0 ? -sine : sine));  // q and -q are the same
}

/// The rotation of a quaternion (w, x, y, z) of any length but 0.
inline Matrix3d rotation_from_quaternion(double w, double x, double y, double z) {
  const double length = std::sqrt((x * x + z * z) + (y * y + w * w));
  w /= length, x /= length, y /= length, z /= length;
  const double x2 = 2 * x, y2 = 2 * y, z2 = 2 * z;
  Matrix3d rotation;
  rotation << 1 - (y2 * y + z2 * z), y2 * x - z2 * w, z2 * x + y2 * w,  //
      y2 * x + z2 * w, 1 - (x2 * x + z2 * z), z2 * y - x2 * w,          //
      z2 * x - y2 * w, z2 * y + x2 * w, 1 - (x2 * x + y2 * y);
  return rotation;
}

/// The motion back: source_from_target. What `Pose::inverse` gives; that compiles four ways to invert for the one that
/// is taken, a fifth of a second in every file.
inline Pose inverted(const Pose& motion) {
  const Matrix3d rotation = transposed(rotation_of(motion));
  return make_pose(rotation, -(rotation * translation_of(motion)));
}

/// One motion after the other: a_from_c. What `a_from_b * b_from_c` gives, in a third of a second less for every file.
inline Pose composed(const Pose& a_from_b, const Pose& b_from_c) {
  const Matrix3d rotation = rotation_of(a_from_b);
  return make_pose(rotation * rotation_of(b_from_c), rotation * translation_of(b_from_c) + translation_of(a_from_b));
}

/// A share of a small motion, to first order: rotation angle and translation times `factor`.
inline Pose scaled(const Pose& motion, double factor) {
  if (std::abs(factor - 1.0) < 1e-6) return motion;  // evenly spaced frames: rounding of their time stamps only
  return make_pose(rotation_from_vector(factor * vector_from_rotation(rotation_of(motion))),
                   factor * translation_of(motion));
}

/// The motion within a time at constant velocity, to first order: rotation angle and translation times the time.
inline Pose at_constant_velocity(const Vector3d& angular_rad_s, const Vector3d& linear_m_s, double elapsed_s) {
  return make_pose(rotation_from_vector(elapsed_s * angular_rad_s), elapsed_s * linear_m_s);
}

/// The same pose with its rotation made orthonormal again: products of many poses, and `inverted` (which transposes),
/// drift away from it.
inline Pose orthonormalized(const Pose& pose) {
  const Eigen::Quaterniond q(rotation_of(pose));
  return make_pose(rotation_from_quaternion(q.w(), q.x(), q.y(), q.z()), translation_of(pose));
}

}  // namespace stillpoint
