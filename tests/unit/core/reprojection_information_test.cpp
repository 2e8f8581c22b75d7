// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/reprojection_information.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace stillpoint::reprojection_information_test {
namespace {

TEST(ReprojectionInformation, IsTheInverseOfTheCovariance) {
  const Vector2d along(3.0, -0.5);
  const double variance = 0.49;
  const Eigen::Matrix2d covariance = variance * Eigen::Matrix2d::Identity() + along * along.transpose();
  const Eigen::Matrix2d expected = covariance.inverse();
  const ReprojectionInformation<double> found(variance, along.x(), along.y());
  EXPECT_NEAR(found.xx, expected(0, 0), 1e-12);
  EXPECT_NEAR(found.xy, expected(0, 1), 1e-12);
  EXPECT_NEAR(found.yy, expected(1, 1), 1e-12);
  const Vector2d residual(0.7, 1.9);
  EXPECT_NEAR(found.squared_distance(residual.x(), residual.y()), residual.dot(expected * residual), 1e-12);
}

TEST(ReprojectionInformation, OfAnUnknownDepthIsTheDistanceFromTheEpipolarLine) {
  // The line runs along (0.6, 0.8); (3, 4) + 2 (−0.8, 0.6) lies 2 px beside it. σ = 0.5 px: (2 / 0.5)² = 16.
  const ReprojectionInformation<double> found(0.25, 0.6e6, 0.8e6);
  EXPECT_NEAR(found.squared_distance(3.0 - 1.6, 4.0 + 1.2), 16.0, 1e-3);
}

}  // namespace
}  // namespace stillpoint::reprojection_information_test
