// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/reprojection_information.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "stillpoint/core/camera.hpp"

namespace stillpoint::reprojection_information_test {
namespace {

EpipolarShift<double> shift_px(double x_px, double y_px) {
  EpipolarShift<double> shift(Camera(1, 1, 0, 0, 1, 1), Vector3d::Zero(), 0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
  shift.x_px = x_px;
  shift.y_px = y_px;
  return shift;
}

// p = ray / ρ is seen at project(R ray / ρ + t); the oracle is the difference quotient by ρ.
TEST(EpipolarShift, IsTheDerivativeOfThePixelByTheInverseDepth) {
  const Camera camera(500, 520, 320, 240, 640, 480);
  const Pose reference_from_current = make_pose(rotation_from_vector({0.1, -0.2, 0.3}), {0.4, -0.1, 0.2});
  const Vector3d ray(0.3, -0.2, 1.0);
  const double inverse_depth = 0.5, sigma = 0.02, h = 1e-6;
  const auto there = [&](double rho) { return Vector3d(reference_from_current * Vector3d(ray / rho)); };
  const Vector2d expected =
      sigma * (camera.project(there(inverse_depth + h)) - camera.project(there(inverse_depth - h))) / (2 * h);
  const Vector3d at = there(inverse_depth);
  const EpipolarShift<double> shift(camera, translation_of(reference_from_current), at.x(), at.y(), at.z(),
                                    at.x() / at.z(), at.y() / at.z(), sigma / inverse_depth / at.z());
  EXPECT_NEAR(shift.x_px, expected.x(), 1e-6);
  EXPECT_NEAR(shift.y_px, expected.y(), 1e-6);
  EXPECT_GT(std::abs(shift.y_px), 0.1) << "the scene tests both axes";
}

TEST(ReprojectionInformation, IsTheInverseOfTheCovariance) {
  const Vector2d along(3.0, -0.5);
  const double variance = 0.49;
  const Eigen::Matrix2d covariance = variance * Eigen::Matrix2d::Identity() + along * along.transpose();
  const Eigen::Matrix2d expected = covariance.inverse();
  const ReprojectionInformation<double> found(variance, shift_px(along.x(), along.y()));
  EXPECT_NEAR(found.xx, expected(0, 0), 1e-12);
  EXPECT_NEAR(found.xy, expected(0, 1), 1e-12);
  EXPECT_NEAR(found.yy, expected(1, 1), 1e-12);
  const Vector2d residual(0.7, 1.9);
  EXPECT_NEAR(found.squared_distance(residual.x(), residual.y()), residual.dot(expected * residual), 1e-12);
}

TEST(ReprojectionInformation, OfAnUnknownDepthIsTheDistanceFromTheEpipolarLine) {
  // The line runs along (0.6, 0.8); (3, 4) + 2 (−0.8, 0.6) lies 2 px beside it. σ = 0.5 px: (2 / 0.5)² = 16.
  const ReprojectionInformation<double> found(0.25, shift_px(0.6e6, 0.8e6));
  EXPECT_NEAR(found.squared_distance(3.0 - 1.6, 4.0 + 1.2), 16.0, 1e-3);
}

}  // namespace
}  // namespace stillpoint::reprojection_information_test
