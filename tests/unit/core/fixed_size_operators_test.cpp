// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Sums and products of small matrices: what Eigen's own give, but matrices and not expressions.

#include "stillpoint/core/fixed_size_operators.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::fixed_size_operators_test {

constexpr double kRounding = 1e-13;  // of a few sums that nearly cancel

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> random_matrix(Random& random) {
  Eigen::Matrix<double, Rows, Columns> m;
  for (int i = 0; i < Rows * Columns; ++i) m.data()[i] = random.uniform() - 0.5;
  return m;
}

TEST(FixedSizeOperators, GiveMatricesAndNoExpressions) {
  const Vector3d a = Vector3d::Ones();
  const Matrix3d m = Matrix3d::Identity();
  static_assert(std::is_same_v<decltype(a + a), Vector3d> && std::is_same_v<decltype(a - a), Vector3d>);
  static_assert(std::is_same_v<decltype(2.0 * a), Vector3d> && std::is_same_v<decltype(a / 2.0), Vector3d>);
  static_assert(std::is_same_v<decltype(m * a), Vector3d> && std::is_same_v<decltype(m * m), Matrix3d>);
  EXPECT_EQ(m * (a + a), Vector3d(2, 2, 2));
}

TEST(FixedSizeOperators, LeaveToEigenWhatHasNoFixedSizeOrIsAnExpression) {
  const Eigen::VectorXd any = Eigen::VectorXd::Ones(4);
  EXPECT_EQ(Eigen::VectorXd(any + 2.0 * any), Eigen::VectorXd::Constant(4, 3.0));
  const Vector3d a(1, 2, 3);
  EXPECT_EQ(Vector3d(a + a.cross(Vector3d::UnitX())), Vector3d(1, 5, 1));
  EXPECT_EQ(Vector3d(2 * a), Vector3d(2, 4, 6));  // a whole number is not the matrix' scalar
}

TEST(FixedSizeOperators, AgreeWithEigensBesidesRounding) {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    const Matrix3d m = random_matrix<3, 3>(random), k = random_matrix<3, 3>(random);
    const Vector3d v = random_matrix<3, 1>(random), w = random_matrix<3, 1>(random);
    EXPECT_TRUE((m * v).isApprox(m.lazyProduct(v), kRounding));
    EXPECT_TRUE((m * k).isApprox(m.lazyProduct(k), kRounding));
    EXPECT_EQ(v - w, Vector3d(v.array() - w.array()));
    EXPECT_EQ(-(v + w), Vector3d(-(v.array() + w.array())));
    Vector3d sum = v;
    sum += w;
    sum -= 0.5 * w;
    sum *= 3.0;
    sum /= 7.0;
    EXPECT_TRUE(sum.isApprox(Vector3d((v.array() + 0.5 * w.array()) * (3.0 / 7.0)), kRounding));
    Pose pose = Pose::Identity();
    pose.linear() = m;
    pose.translation() = w;
    EXPECT_TRUE((pose * v).isApprox(m.lazyProduct(v) + w, kRounding));
  }
}

TEST(FixedSizeOperators, TransposesConvertsAndFindsTheLargestByHand) {
  Eigen::Matrix<double, 2, 3> a;
  a << 1, -7.5, 3, 4, 5, 6;
  Eigen::Matrix<double, 3, 2> expected;
  expected << 1, 4, -7.5, 5, 3, 6;
  EXPECT_EQ(transposed(a), expected);
  EXPECT_EQ(largest_magnitude(a), 7.5);
  EXPECT_EQ(largest_magnitude(Vector3d(Vector3d::Zero())), 0.0);
  EXPECT_EQ(to_float(Vector2d(0.1, 2)), Vector2f(0.1f, 2.0f));
  EXPECT_EQ(to_double(Vector2f(0.1f, 2.0f)), Vector2d(static_cast<double>(0.1f), 2.0));
}

}  // namespace stillpoint::fixed_size_operators_test
