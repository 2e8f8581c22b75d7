// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/pipeline/motion_expectation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace stillpoint {
namespace {

Pose shift(double x_m) {
  Pose pose = Pose::Identity();
  pose.translation().x() = x_m;
  return pose;
}

Motion motion(bool stationary, Status status = Status::ok) {
  Motion motion;
  motion.status = status;
  motion.stationary = stationary;
  if (!stationary) motion.current_from_reference = shift(0.1);
  return motion;
}

/// Statuses of a frame that could not be judged: its motion is none.
constexpr Status kUnusable[] = {Status::first_frame, Status::no_keypoints, Status::too_few_matches, Status::no_depth,
                                Status::no_consensus};

// ---- What a host may say that is no motion ----

/// Finite, and no motion of a camera all the same.
std::vector<Pose> absurd_poses() {
  std::vector<Pose> poses(6, Pose::Identity());
  poses[0].linear() *= 1e308;
  poses[1].linear() *= 1.1;
  poses[2].linear()(0, 0) = -1.0;  // a mirror
  poses[3].linear().setZero();
  poses[4].linear()(2, 1) = 1e200;
  poses[5].linear()(0, 1) = std::numeric_limits<double>::quiet_NaN();
  return poses;
}

TEST(MotionExpectation, WhatIsNotRigidIsNotBelieved) {
  for (const Pose& absurd : absurd_poses()) {
    MotionExpectation expectation;
    expectation.advance(1.0, motion(false));
    expectation.feedback(shift(5.0));
    expectation.advance(1.1, motion(false));
    expectation.expect(absurd);
    expectation.feedback(absurd);
    const MotionPrior prior = expectation.at(1.2);
    ASSERT_TRUE(prior.current_from_reference) << absurd.matrix();
    EXPECT_TRUE(prior.current_from_reference->isApprox(shift(0.1))) << absurd.matrix() << "\nthe velocity holds on";
    EXPECT_TRUE(prior.predicted->isApprox(shift(0.1)));
  }
}

TEST(MotionExpectation, AHundredMetresAFrameAreTheMost) {
  for (const auto& [metres, is_believed] : {std::pair{99.0, true}, {101.0, false}, {1e308, false}}) {
    MotionExpectation expectation;
    expectation.expect(shift(metres));
    EXPECT_EQ(expectation.at(1.0).current_from_reference.has_value(), is_believed) << metres;
    MotionExpectation told;  // the world may be as large as it likes
    const double far_m = metres < 1e300 ? 5e6 : 0.0;
    told.advance(1.0, motion(false));
    told.feedback(shift(far_m));
    told.advance(1.1, motion(false));
    told.feedback(shift(far_m - metres));
    ASSERT_TRUE(told.at(1.2).current_from_reference);
    EXPECT_NEAR(told.at(1.2).current_from_reference->translation().x(), is_believed ? metres : 0.1, 1e-6) << metres;
  }
}

TEST(MotionExpectation, ARotationThatHasDriftedIsMadeOne) {
  Pose drifted = shift(0.2);
  drifted.linear() *= 1.001;
  MotionExpectation expectation;
  expectation.expect(drifted);
  ASSERT_TRUE(expectation.at(1.0).current_from_reference);
  EXPECT_TRUE(expectation.at(1.0).current_from_reference->isApprox(shift(0.2), 1e-12));
}

TEST(MotionExpectation, TimeStampsARoundingApartGiveNoVelocity) {
  MotionExpectation expectation;
  expectation.advance(0.0, motion(false));
  expectation.advance(5e-324, motion(false));
  for (const std::optional<Pose>& pose : {expectation.at(0.1).current_from_reference, expectation.at(0.1).predicted}) {
    if (pose) {
      EXPECT_TRUE(is_plausible_motion(*pose)) << pose->matrix();
    }
  }
  expectation.advance(0.1, motion(false));
  expectation.advance(0.2, motion(false));
  ASSERT_TRUE(expectation.at(0.3).predicted) << "what was wrong is not remembered";
  EXPECT_TRUE(expectation.at(0.3).predicted->isApprox(shift(0.1), 1e-6)) << expectation.at(0.3).predicted->matrix();
}

// ---- Does the camera stand? ----

TEST(MotionExpectation, ACameraStandsAtFirst) {
  MotionExpectation expectation;
  EXPECT_TRUE(expectation.at(1.0).stationary);
  expectation.expect(shift(0.1));
  EXPECT_TRUE(expectation.at(1.0).stationary) << "what the host says of the pose says nothing of the camera's stand";
  EXPECT_TRUE(MotionPrior().stationary);
  EXPECT_FALSE(Motion().stationary) << "a motion says so only where it knows";
}

TEST(MotionExpectation, ACameraStandsAsItsLastMotionDid) {
  MotionExpectation expectation;
  double time_s = 1.0;
  for (const bool stationary : {true, false, false, true, false}) {
    expectation.advance(time_s += 0.1, motion(stationary));
    EXPECT_EQ(expectation.at(time_s + 0.1).stationary, stationary);
  }
}

// All ways to an answer carry it: the velocity, the host's word, and none of both.
TEST(MotionExpectation, TheStandIsSaidWithEveryPose) {
  for (const bool stationary : {true, false}) {
    MotionExpectation expectation;
    expectation.advance(0.9, motion(stationary));
    expectation.advance(1.0, motion(stationary));
    ASSERT_TRUE(expectation.at(1.1).current_from_reference);
    EXPECT_EQ(expectation.at(1.1).stationary, stationary);
    expectation.expect(shift(0.3));
    ASSERT_TRUE(expectation.at(1.1).current_from_reference->isApprox(shift(0.3)));
    EXPECT_EQ(expectation.at(1.1).stationary, stationary);
    expectation.advance(1.6, motion(false, Status::no_consensus));
    ASSERT_FALSE(expectation.at(1.7).current_from_reference);
    EXPECT_EQ(expectation.at(1.7).stationary, stationary);
  }
}

// A wall without texture for a moment is no reason to believe that the camera set off, or stopped.
TEST(MotionExpectation, AnUnusableMotionLeavesTheStandAsItWas) {
  for (const Status status : kUnusable) {
    for (const bool stationary : {true, false}) {
      MotionExpectation expectation;
      expectation.advance(1.0, motion(stationary));
      expectation.advance(1.1, motion(!stationary, status));
      EXPECT_EQ(expectation.at(1.2).stationary, stationary) << to_string(status);
      EXPECT_FALSE(expectation.at(1.2).current_from_reference) << to_string(status);
    }
  }
}

// As FrameFilter::reset does it.
TEST(MotionExpectation, ACameraStandsAgainWhereAllIsForgotten) {
  MotionExpectation expectation;
  expectation.advance(1.0, motion(false));
  ASSERT_FALSE(expectation.at(1.1).stationary);
  expectation = MotionExpectation();
  EXPECT_TRUE(expectation.at(1.1).stationary);
  EXPECT_FALSE(expectation.at(1.1).current_from_reference);
  EXPECT_FALSE(expectation.last_timestamp_s());
}

// ---- Where will it be? ----

// 0.1 m within 0.1 s are 0.05 m within half of that. The first frame's interval is unknown.
TEST(MotionExpectation, TheVelocityHolds) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  EXPECT_FALSE(expectation.at(1.1).current_from_reference);
  expectation.advance(1.1, motion(false));
  EXPECT_TRUE(expectation.at(1.15).current_from_reference->isApprox(shift(0.05)));
  EXPECT_TRUE(expectation.at(1.3).current_from_reference->isApprox(shift(0.2)));
}

// 0.1 m within 0.1 s, then 0.1 m within 10 µs, by two stamps next to each other: the latter is no velocity of 10 km/s,
// and the mean one holds.
TEST(MotionExpectation, TwoStampsNextToEachOtherAreNoVelocity) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  expectation.advance(1.1, motion(false));
  expectation.advance(1.10001, motion(false));
  const MotionPrior prior = expectation.at(1.2);
  ASSERT_TRUE(prior.current_from_reference && prior.predicted);
  EXPECT_TRUE(prior.current_from_reference->isApprox(*prior.predicted));
  EXPECT_TRUE(expectation.at(1.10010).current_from_reference->isApprox(shift(0.9), 1e-6)) << "within ten times as long";
}

TEST(MotionExpectation, OnlyWhatTheHostSaysOfTheMotionItselfIsTold) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  expectation.feedback(shift(2.0));
  expectation.advance(1.1, motion(false));
  expectation.feedback(shift(1.6));
  EXPECT_FALSE(expectation.at(1.2).is_told);
  expectation.expect(shift(0.25));
  EXPECT_TRUE(expectation.at(1.2).is_told);
  expectation.advance(1.2, motion(false));
  EXPECT_FALSE(expectation.at(1.3).is_told) << "it was of that frame";
}

TEST(MotionExpectation, TheHostsPosesCorrectTheVelocity) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  expectation.feedback(shift(2.0));
  expectation.advance(1.1, motion(false));
  expectation.feedback(shift(1.6));
  EXPECT_TRUE(expectation.at(1.2).current_from_reference->isApprox(shift(0.4))) << "the camera went left: points right";
  expectation.advance(1.2, motion(false));
  EXPECT_TRUE(expectation.at(1.3).current_from_reference->isApprox(shift(0.1))) << "it fell silent";
}

// 0.1 m within 0.1 s: 1 m/s. With e^(−0.1 / 0.1) of it left, 3 m/s pull the mean to 1 + 2 (1 − 1/e).
TEST(MotionExpectation, ThePredictionIsTheMeanVelocitys) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  EXPECT_FALSE(expectation.at(1.1).predicted);
  expectation.advance(1.1, motion(false));
  EXPECT_TRUE(expectation.at(1.15).predicted->isApprox(shift(0.05)));
  EXPECT_NEAR(expectation.at(1.15).elapsed_s, 0.05, 1e-12);
  Motion faster = motion(false);
  faster.current_from_reference = shift(0.3);
  expectation.advance(1.2, faster);
  EXPECT_TRUE(expectation.at(1.3).current_from_reference->isApprox(shift(0.3)));
  EXPECT_NEAR(expectation.at(1.3).predicted->translation().x(), 0.1 + 0.2 * (1.0 - std::exp(-1.0)), 1e-9);
  expectation.advance(1.75, motion(false, Status::no_consensus));
  EXPECT_FALSE(expectation.at(1.85).predicted);
}

// A turning camera goes on to turn while a frame or two cannot be judged: 1 m/s, for half a second after it was seen.
TEST(MotionExpectation, TheVelocityOutlastsFramesWithoutAMotion) {
  for (const Status status : kUnusable) {
    MotionExpectation expectation;
    expectation.advance(1.0, Motion());
    expectation.advance(1.1, motion(false));
    expectation.advance(1.2, motion(false, status));
    for (const std::optional<Pose>& pose :
         {expectation.at(1.3).current_from_reference, expectation.at(1.3).predicted}) {
      ASSERT_TRUE(pose) << to_string(status);
      EXPECT_TRUE(pose->isApprox(shift(0.1), 1e-6)) << to_string(status);
    }
    expectation.advance(1.59, motion(false, status));
    EXPECT_TRUE(expectation.at(1.7).current_from_reference) << to_string(status);
    expectation.advance(1.61, motion(false, status));
    EXPECT_FALSE(expectation.at(1.7).current_from_reference) << to_string(status);
  }
}

// Said of a frame that never came: what is wrong now does not let it stand.
TEST(MotionExpectation, WhatIsNoneTakesThePlaceOfWhatWasSaid) {
  MotionExpectation expectation;
  expectation.expect(shift(0.3));
  expectation.expect(shift(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(expectation.at(1.0).is_told);
  EXPECT_FALSE(expectation.at(1.0).current_from_reference);
}

// A host that is led astray shall not take the filter's own velocity along; what an IMU says is better than any mean.
TEST(MotionExpectation, ThePredictionIsTheHostsWordButNotItsPoses) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  expectation.feedback(shift(2.0));
  expectation.advance(1.1, motion(false));
  expectation.feedback(shift(1.6));
  EXPECT_TRUE(expectation.at(1.2).current_from_reference->isApprox(shift(0.4)));
  EXPECT_TRUE(expectation.at(1.2).predicted->isApprox(shift(0.1)));
  expectation.expect(shift(0.25));
  EXPECT_TRUE(expectation.at(1.2).predicted->isApprox(shift(0.25)));
}

TEST(MotionExpectation, PosesThatAreNotFiniteSayNothing) {
  MotionExpectation expectation;
  expectation.advance(1.0, Motion());
  expectation.advance(1.1, motion(false));
  const Pose broken = shift(std::numeric_limits<double>::quiet_NaN());
  expectation.expect(broken);
  expectation.feedback(broken);
  EXPECT_TRUE(expectation.at(1.2).current_from_reference->isApprox(shift(0.1)));
}

}  // namespace
}  // namespace stillpoint
