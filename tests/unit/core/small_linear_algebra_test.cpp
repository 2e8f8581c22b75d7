// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/small_linear_algebra.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

template <int N>
Eigen::Matrix<double, N, N> random_gram(Random& random, int rank) {
  Eigen::Matrix<double, N, N> gram = Eigen::Matrix<double, N, N>::Zero();
  for (int r = 0; r < rank; ++r) {
    Eigen::Matrix<double, N, 1> row;
    for (int i = 0; i < N; ++i) row(i) = random.gaussian();
    gram += row * row.transpose();
  }
  return gram;
}

// 1 · 4 · 1 + 2 · (1 · 2 · 3) + 3 · 5 · 3 = 61
TEST(QuadraticForm, ByHand) {
  Eigen::Matrix2d a;
  a << 4, 2, 2, 5;
  EXPECT_EQ(quadratic_form(a, Eigen::Vector2d(1, 3)), 61.0);
}

TEST(Cholesky, TwoUnknownsByHand) {
  // 4 x + 2 y = 2, 2 x + 5 y = 9: x = -1/2, y = 2. The inverse is (5 -2; -2 4) / 16.
  Eigen::Matrix2d a;
  a << 4, 2, 2, 5;
  const Cholesky<2> factors(a);
  ASSERT_TRUE(factors.positive_definite());
  EXPECT_TRUE(factors.solve({2, 9}).isApprox(Eigen::Vector2d(-0.5, 2), 1e-15));
  Eigen::Matrix2d inverse;
  inverse << 5, -2, -2, 4;
  EXPECT_TRUE(factors.inverse().isApprox(inverse / 16, 1e-15));
}

TEST(Cholesky, AgreesWithEigenAndNamesWhatHasNoSolution) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Matrix<double, 7, 7> a = random_gram<7>(random, 20);
    const Eigen::Matrix<double, 7, 1> b = a.col(trial % 7) + Eigen::Matrix<double, 7, 1>::Ones();
    EXPECT_TRUE(Cholesky<7>(a).solve(b).isApprox(a.ldlt().solve(b), 1e-9));  // rounding times the condition
    EXPECT_TRUE((Cholesky<7>(a).inverse() * a).isIdentity(1e-9));
  }
  EXPECT_FALSE(Cholesky<6>(Eigen::Matrix<double, 6, 6>::Zero()).positive_definite());
  EXPECT_FALSE(Cholesky<6>(-Eigen::Matrix<double, 6, 6>::Identity()).positive_definite());
  const double kNaN = std::nan("");
  const Cholesky<6> broken(kNaN * Eigen::Matrix<double, 6, 6>::Identity());
  EXPECT_FALSE(broken.positive_definite());
  EXPECT_TRUE(broken.solve(Eigen::Matrix<double, 6, 1>::Ones()).array().isNaN().all());
}

TEST(SymmetricEigen, AgreesWithEigenAtFullAndLowRank) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Matrix<double, 9, 9> a = random_gram<9>(random, trial % 2 == 0 ? 30 : 8);
    const SymmetricEigen<9> found(a);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> expected(a);
    for (int k = 0; k < 9; ++k) {
      EXPECT_NEAR(found.value(k), expected.eigenvalues()(k), 1e-12 * a.trace());
      EXPECT_LT((a * found.vector(k) - found.value(k) * found.vector(k)).norm(), 1e-12 * a.trace());
      EXPECT_NEAR(found.vector(k).norm(), 1.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace stillpoint
