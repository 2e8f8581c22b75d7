// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/inertia.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion_scene.hpp"

namespace stillpoint {
namespace {

/// After one second: a velocity that is known within √12 m and √12 / 4 rad, and twelve constraints that say what one
/// says, so that its information is 12 / 12 = 1 along an axis and 12 / (12 / 16) = 16 about it.
Inertia by_hand() {
  Inertia inertia;
  inertia.acceleration_m_s2 = std::sqrt(12.0);
  inertia.angular_acceleration_rad_s2 = std::sqrt(12.0) / 4.0;
  return inertia;
}

MotionPrior predicted(const Pose& pose, double elapsed_s = 1.0) { return {std::nullopt, false, pose, elapsed_s}; }

Matrix6d information(double rotation, double translation) {
  Vector6d diagonal;
  diagonal << Vector3d::Constant(rotation), Vector3d::Constant(translation);
  return diagonal.asDiagonal();
}

// 48 and 16 about an axis, 3 and 1 along it: a quarter of the way to 0.2 rad and 0.4 m.
TEST(Inertia, GoesAsFarAsItsShareOfTheInformation) {
  Matrix6d sum = information(48.0, 3.0);
  const Pose fused = by_hand().fuse(Pose::Identity(), sum, predicted(test::pose_of({0, 0, 0.2}, {0.4, 0, 0})));
  EXPECT_LT(test::rotation_error(fused, test::pose_of({0, 0, 0.05}, {0, 0, 0})), 1e-9);
  EXPECT_LT(test::translation_error(fused, test::pose_of({0, 0, 0}, {0.1, 0, 0})), 1e-9);
  EXPECT_TRUE(sum.isApprox(information(64.0, 4.0), 1e-9));
}

// By hand at 0.03 s: √12 m/s² · 0.03² s² gives an information of 12 / (12 · 0.03⁴) = 1 / 0.03⁴ along an axis. A
// hundredth of that time is a hundredth of the way, no less: 1 / (0.03² · 0.0003²).
TEST(Inertia, AVelocityIsNotKnownBetterBecauseTheNextFrameIsNear) {
  for (const double elapsed_s : {0.03, 0.0003}) {
    Matrix6d sum = information(0.0, 0.0);
    by_hand().fuse(Pose::Identity(), sum, predicted(Pose::Identity(), elapsed_s));
    EXPECT_NEAR(sum(3, 3) * 9e-4 * elapsed_s * elapsed_s, 1.0, 1e-9);
    EXPECT_NEAR(sum(0, 0) * 9e-4 * elapsed_s * elapsed_s, 16.0, 1e-9);
  }
}

// Two images whose stamps are 0.1 ms apart were not taken 0.1 ms apart.
TEST(Inertia, StampsNextToEachOtherSayNothing) {
  EXPECT_FALSE(Inertia().applies(predicted(Pose::Identity(), 1e-4)));
  EXPECT_TRUE(Inertia().applies(predicted(Pose::Identity(), 1.0 / 240.0)));
}

// What the constraints hold stays; what they leave open goes all the way, from any pose.
TEST(Inertia, FillsInWhatTheConstraintsLeaveOpen) {
  const Pose found = test::pose_of({0.3, -0.2, 0.1}, {1.0, 2.0, -0.5});
  const Pose further = test::pose_of({0, 0, 0.02}, {0.03, 0, 0});
  Matrix6d open = Matrix6d::Zero();
  EXPECT_TRUE(by_hand().fuse(found, open, predicted(further * found)).isApprox(further * found, 1e-9));
  Matrix6d held = information(1e12, 1e12);
  EXPECT_TRUE(by_hand().fuse(found, held, predicted(further * found)).isApprox(found, 1e-9));
  Matrix6d turn_only = information(1e12, 0.0);
  const Pose fused = by_hand().fuse(found, turn_only, predicted(further * found));
  EXPECT_LT(test::rotation_error(fused, found), 1e-9);
  EXPECT_LT((fused.translation() - found.translation() - Vector3d(0.03, 0, 0)).norm(), 1e-9);
}

// A turn against a shift: the constraints know only their sum, ω + v = 0.1 with the information 100 along it. The
// velocity says 0 and 0 and is surer of the turn (16 against 1), so that the shift takes more of it: minimise
// 100 (ω + v − 0.1)² + 16 ω² + v²: v = 16 ω and ω = 10 / (1700 + 16) = 0.005828.
TEST(Inertia, SharesWhatOnlyTheSumIsKnownOf) {
  Matrix6d sum = Matrix6d::Zero();
  sum(2, 2) = sum(3, 3) = sum(2, 3) = sum(3, 2) = 100.0;
  // Found at ω = 0.1, v = 0, which fits as well as any; back to rest it is −0.1 about z.
  const Pose fused = by_hand().fuse(test::pose_of({0, 0, 0.1}, {0, 0, 0}), sum, predicted(Pose::Identity()));
  EXPECT_NEAR(vector_from_rotation(fused.linear()).z(), 10.0 / 1716.0, 1e-6);
  EXPECT_NEAR(fused.translation().x(), 160.0 / 1716.0, 1e-6);
}

// √480 m off with information 3 and 1: e² = 480 / (1/3 + 1) / 12 = 30. Student's weight with ten degrees of freedom is
// (10 + 6) / (10 + 30) = 0.4, so that 0.4 / 3.4 of the way is left.
TEST(Inertia, AJoltIsBelieved) {
  Matrix6d sum = information(48.0, 3.0);
  const Pose fused =
      by_hand().fuse(Pose::Identity(), sum, predicted(test::pose_of({0, 0, 0}, {std::sqrt(480.0), 0, 0})));
  EXPECT_NEAR(fused.translation().x(), std::sqrt(480.0) * 0.4 / 3.4, 1e-9);
  EXPECT_NEAR(sum(3, 3), 3.4, 1e-9);
  EXPECT_NEAR(sum(0, 0), 48.0 + 0.4 * 16.0, 1e-9);
  Matrix6d near = information(48.0, 3.0);
  const Pose steady = by_hand().fuse(Pose::Identity(), near, predicted(test::pose_of({0, 0, 0}, {0.4, 0, 0})));
  EXPECT_NEAR(steady.translation().x(), 0.1, 1e-9) << "never more than in full";
}

// An acceleration leaves the predicted place by t²: after half the time the velocity is sixteen times as informative.
TEST(Inertia, KnowsLessTheLongerItWaits) {
  Matrix6d sum = Matrix6d::Zero();
  by_hand().fuse(Pose::Identity(), sum, predicted(Pose::Identity(), 0.5));
  EXPECT_TRUE(sum.isApprox(information(256.0, 16.0), 1e-9));
}

TEST(Inertia, NoTimeIsNoReasonToMove) {
  const Pose found = test::pose_of({0.1, 0, 0}, {1, 2, 3});
  for (const double elapsed_s : {1e-200, 0.0}) {
    Matrix6d sum = information(48.0, 3.0);
    EXPECT_TRUE(by_hand().fuse(found, sum, predicted(Pose::Identity(), elapsed_s)).isApprox(found, 0.0));
    EXPECT_TRUE(sum.isApprox(information(48.0, 3.0), 0.0));
  }
}

TEST(Inertia, AppliesWhereThereIsAPredictionAndAMass) {
  Inertia inertia;
  EXPECT_TRUE(inertia.applies(predicted(Pose::Identity())));
  EXPECT_FALSE(inertia.applies(MotionPrior{}));
  EXPECT_FALSE(inertia.applies(MotionPrior{Pose::Identity()})) << "the expected motion is another matter";
  inertia.acceleration_m_s2 = 0.0;
  EXPECT_FALSE(inertia.applies(predicted(Pose::Identity())));
  inertia = Inertia();
  inertia.angular_acceleration_rad_s2 = 0.0;
  EXPECT_FALSE(inertia.applies(predicted(Pose::Identity())));
}

}  // namespace
}  // namespace stillpoint
