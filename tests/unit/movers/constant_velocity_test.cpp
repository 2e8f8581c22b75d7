// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/constant_velocity.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace stillpoint::constant_velocity_test {
namespace {

constexpr double kExact = 1e-12;

// Variance 1 before, noise 1: the gain is ½, so the velocity is half of what was measured, and its variance ½.
TEST(ConstantVelocity, MeasurementAsGoodAsWhatIsKnownMovesItHalfTheWay) {
  ConstantVelocity filter(1.0);
  filter.correct({2, 0, -4}, Matrix3d::Identity());
  EXPECT_LT((filter.velocity() - Vector3d(1, 0, -2)).norm(), kExact);
  EXPECT_LT((filter.covariance() - 0.5 * Matrix3d::Identity()).norm(), kExact);
}

// 2 m/s² that change every 1/30 s: after 0.5 s 15 independent steps of 1/15 m/s, 15 / 225 = 1/15 (m/s)² more, whatever
// the frame rate.
TEST(ConstantVelocity, VarianceGrowsWithTime) {
  for (const int frames : {1, 5, 15, 45}) {
    ConstantVelocity filter(1.0);
    for (int i = 0; i < frames; ++i) filter.predict(Matrix3d::Identity(), 0.5 / frames, 2.0);
    EXPECT_LT((filter.covariance() - (1.0 + 1.0 / 15.0) * Matrix3d::Identity()).norm(), 1e-12) << frames;
  }
}

TEST(ConstantVelocity, TurnsWithTheCamera) {
  ConstantVelocity filter(1e3);
  filter.correct({1, 0, 0}, Vector3d(1e-12, 4, 9).asDiagonal());
  Matrix3d quarter;  // x becomes y
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  filter.predict(quarter, 0.0, 1.0);
  EXPECT_LT((filter.velocity() - Vector3d(0, 1, 0)).norm(), 1e-9);
  EXPECT_NEAR(filter.covariance()(0, 0), 4.0, 1e-4) << "what was y's variance";
}

TEST(ConstantVelocity, WhatIsNoMeasurementChangesNothing) {
  ConstantVelocity filter(1.0);
  filter.correct(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), Matrix3d::Identity());
  filter.correct({1, 1, 1}, -2.0 * Matrix3d::Identity());
  EXPECT_EQ(filter.velocity(), Vector3d::Zero());
  EXPECT_EQ(filter.covariance(), Matrix3d::Identity());
}

}  // namespace
}  // namespace stillpoint::constant_velocity_test
