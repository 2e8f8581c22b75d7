// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/tracked_object.hpp"

#include <gtest/gtest.h>

namespace stillpoint {
namespace {

// Its velocity is known to 0.2 m/s; 0.5 s later its step to that frame is known to 0.5 s of the velocity's uncertainty
// then, and the millimetres of its last measurement are gone.
TEST(TrackedObject, ThePredictedMotionIsKnownAsWellAsTheVelocity) {
  TrackedObject object;
  object.linear.correct({1, 0, 0}, 0.04 * Matrix3d::Identity());
  object.mover.covariance = 1e-6 * Matrix6d::Identity();
  object.mover.has_rotation = true;
  object.predict(Pose::Identity(), 0.5);
  EXPECT_NEAR(object.mover.current_from_reference.translation().x(), 0.5 * object.linear.velocity().x(), 1e-12);
  const Matrix3d expected = 0.25 * object.linear.covariance();
  EXPECT_GT(expected(0, 0), 0.25 * 0.038);
  EXPECT_TRUE((object.mover.covariance.bottomRightCorner<3, 3>().isApprox(expected, 1e-12)));
  EXPECT_FALSE(object.mover.has_rotation) << "a turn that is not sure is not predicted";
  EXPECT_TRUE((object.mover.covariance.topLeftCorner<3, 3>().isZero()));
}

TEST(TrackedObject, ASureTurnIsPredicted) {
  TrackedObject object;
  object.surely_turns = object.mover.has_rotation = true;
  object.angular.correct({0, 1, 0}, 0.01 * Matrix3d::Identity());
  object.predict(Pose::Identity(), 0.1);
  EXPECT_TRUE(object.mover.has_rotation);
  EXPECT_TRUE((object.mover.covariance.topLeftCorner<3, 3>().isApprox(0.01 * object.angular.covariance(), 1e-12)));
}

// It turns about its centroid: how far it turns says nothing of where the centroid goes, J = [−[c]×, I].
TEST(TrackedObject, WhereItsCentroidGoesIsKnownAsWellAsItsVelocity) {
  TrackedObject object;
  object.surely_turns = object.mover.has_rotation = true;
  object.mover.centroid = {0.4, -0.2, 3.0};
  object.linear.correct({0.5, 0, 0}, 0.0025 * Matrix3d::Identity());
  object.angular.correct({0, 1, 0}, 0.01 * Matrix3d::Identity());
  object.predict(Pose::Identity(), 0.1);
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -skew(object.mover.centroid), Matrix3d::Identity();
  const Matrix3d of_centroid = jacobian * object.mover.covariance * jacobian.transpose();
  EXPECT_TRUE(of_centroid.isApprox(0.01 * object.linear.covariance(), 1e-9)) << of_centroid;
  EXPECT_TRUE(object.mover.covariance.isApprox(object.mover.covariance.transpose(), 1e-12));
}

}  // namespace
}  // namespace stillpoint
