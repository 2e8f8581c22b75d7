// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "stillpoint/core/random.hpp"

namespace stillpoint::geometry_test {
namespace {

constexpr double kRounding = 1e-12;  // a few operations on numbers of size one

Vector2f rounded_as_float(const Vector2d& pixel) { return rounded(Vector2f(pixel.cast<float>())); }

Vector3d any_vector(Random& random) { return {random.gaussian(), random.gaussian(), random.gaussian()}; }

TEST(Geometry, RoundedIsLround) {
  for (const float half : {0.5f, 1.5f, 2.5f, 196.5f, 4095.5f, 4194303.5f}) {
    for (const float x : {half, std::nextafter(half, 0.0f), std::nextafter(half, 1e9f)}) {
      EXPECT_EQ(rounded(x), std::lround(x)) << x;
      EXPECT_EQ(rounded(-x), std::lround(-x)) << -x;
    }
  }
  for (const float x : {0.0f, -0.0f, 8388607.0f, 8388609.0f, 2147483520.0f}) EXPECT_EQ(rounded(x), std::lround(x)) << x;
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const auto x = static_cast<float>(random.uniform(-5000.0, 5000.0));
    EXPECT_EQ(rounded(x), std::lround(x)) << x;
  }
}

// 196.5 - 8e-7 lies within half of a float's last digit (8e-6) of 196.5, which is what it becomes.
TEST(Geometry, RoundedTakesFloatsAsTheyAre) {
  Vector2f (*volatile const function)(const Vector2d&) = rounded_as_float;  // compiled for any pixel
  EXPECT_EQ(function({196.5 - 8e-7, 196.5 - 3e-5}), Vector2f(197, 196));
}

TEST(Geometry, SkewIsTheCrossProduct) {
  EXPECT_EQ(skew({1, 2, 3}) * Vector3d(4, 5, 6), Vector3d(-3, 6, -3));  // (2·6 − 3·5, 3·4 − 1·6, 1·5 − 2·4)
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3d a = any_vector(random), b = any_vector(random);
    EXPECT_LE((skew(a) * b - a.cross(b)).norm(), kRounding);
  }
}

TEST(Geometry, RotationFromVectorTurnsTheRightWay) {
  const double quarter = std::acos(0.0);
  const Matrix3d about_z = rotation_from_vector({0, 0, quarter});
  EXPECT_LE((about_z * Vector3d(1, 0, 0) - Vector3d(0, 1, 0)).norm(), kRounding);
  EXPECT_EQ(rotation_from_vector(Vector3d::Zero()), Matrix3d::Identity());
}

TEST(Geometry, RotationAngleUndoesRotationFromVector) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const double angle = std::pow(10.0, random.uniform(-11.0, 0.497));  // up to just below π
    const Vector3d axis = any_vector(random).normalized();
    // Of the angle for small ones; near π the sine is small and the rounding of the cosine takes over.
    EXPECT_NEAR(rotation_angle(rotation_from_vector(angle * axis)), angle, 1e-7 * angle) << angle;
  }
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(rotation_angle(rotation_from_vector({pi, 0, 0})), pi, kRounding);
  EXPECT_EQ(rotation_angle(Matrix3d::Identity()), 0.0);
}

TEST(Geometry, VectorFromRotationUndoesRotationFromVector) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const double angle = std::pow(10.0, random.uniform(-13.0, 0.497));  // up to just below π
    const Vector3d omega = angle * any_vector(random).normalized();
    EXPECT_LE((vector_from_rotation(rotation_from_vector(omega)) - omega).norm(), 1e-15 + kRounding * angle) << angle;
  }
  EXPECT_EQ(vector_from_rotation(Matrix3d::Identity()), Vector3d::Zero());
  const Matrix3d half_turn = Vector3d(-1, 1, -1).asDiagonal();
  EXPECT_LE((vector_from_rotation(half_turn).cwiseAbs() - Vector3d(0, std::acos(-1.0), 0)).norm(), kRounding);
}

TEST(Geometry, InvertedIsTheMotionBack) {
  Pose motion = Pose::Identity();
  motion.linear() = rotation_from_vector({0.4, -0.2, 1.3});
  motion.translation() = Vector3d(1, -2, 3);
  EXPECT_TRUE(inverted(motion).isApprox(motion.inverse(), kRounding));
  EXPECT_TRUE((inverted(motion) * motion).matrix().isIdentity(kRounding));
}

TEST(Geometry, AtConstantVelocityTurnsAndShiftsByTheTime) {
  // A quarter turn per second about z, and 2 m/s along x: after half a second 45 degrees and 1 m.
  const double quarter = std::acos(0.0);
  const Pose moved = at_constant_velocity({0, 0, quarter}, {2, 0, 0}, 0.5);
  const double half = std::sqrt(0.5);
  EXPECT_LE((moved * Vector3d(1, 0, 0) - Vector3d(1 + half, half, 0)).norm(), kRounding);
}

TEST(Geometry, OrthonormalizedStopsTheDriftOfLongChains) {
  Random random(3);
  Pose step = Pose::Identity();
  step.linear() = rotation_from_vector({0.1, -0.2, 0.3});
  step.translation() = Vector3d(0.01, 0.02, 0.03);
  Pose chain = Pose::Identity();
  for (int i = 0; i < 10000; ++i) chain = orthonormalized(chain * step);
  EXPECT_LE((chain.linear() * chain.linear().transpose() - Matrix3d::Identity()).norm(), 1e-14);

  Pose skewed = step;
  skewed.linear() *= 1.001;
  const Matrix3d repaired = orthonormalized(skewed).linear();
  EXPECT_LE((repaired * repaired.transpose() - Matrix3d::Identity()).norm(), kRounding);
  EXPECT_LE((repaired - step.linear()).norm(), 1e-3) << "not farther away than the input was";
  EXPECT_EQ(orthonormalized(skewed).translation(), step.translation());
}

TEST(Geometry, ARotationFromAQuaternionIsEigensWhateverItsLength) {
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q(random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian());
    const Matrix3d expected = q.normalized().toRotationMatrix();
    EXPECT_TRUE(rotation_from_quaternion(q.w(), q.x(), q.y(), q.z()).isApprox(expected, kRounding));
  }
  EXPECT_EQ(rotation_from_quaternion(-2, 0, 0, 0), Matrix3d(Matrix3d::Identity()));
}

TEST(Geometry, PosesAreEigens) {
  Random random(10);
  const Pose pose = make_pose(rotation_from_vector(any_vector(random)), any_vector(random));
  EXPECT_EQ(rotation_of(pose), Matrix3d(pose.linear()));
  EXPECT_EQ(translation_of(pose), Vector3d(pose.translation()));
  EXPECT_EQ(Eigen::RowVector4d(pose.matrix().row(3)), Eigen::RowVector4d(0, 0, 0, 1));
}

}  // namespace
}  // namespace stillpoint::geometry_test
