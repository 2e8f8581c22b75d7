// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/stationary_camera.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "motion_scene.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint {
namespace {

constexpr float kLost = std::numeric_limits<float>::quiet_NaN();
constexpr double kNoDepth = 0.0;

/// Corners of the filter's own, all in one place: only how far they moved, how far away they are and what memory thinks
/// of them counts.
class StationaryCameraTest : public testing::Test {
 protected:
  /// @param moved_px  since the last frame
  void add(std::size_t count, double moved_px, double depth_m, float static_prior = 1.0f) {
    const std::size_t first = matches_.size();
    matches_.resize(first + count);
    for (std::size_t i = first; i < matches_.size(); ++i) {
      matches_.state[i] = MatchState::matched;
      matches_.space_static_prior[i] = static_prior;
      matches_.reference.undistorted[i] = {300.0, 200.0};
      // Askew by 3 : 4, so that both coordinates count.
      matches_.current.undistorted[i] = Vector2d(300.0, 200.0) + moved_px * Vector2d(0.6, -0.8);
      matches_.current.set_depth(i, depth_m, 0.01, test::test_camera());
    }
  }

  /// Another older frame in which every corner was found where it is now, at a pose.
  OlderFrame& reproject_into_past(const Pose& reference_from_current = Pose::Identity()) {
    OlderFrame& frame = matches_.past_observations.add(matches_.size());
    frame.reference_from_current = reference_from_current;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      frame.of_feature[i].state = ObservationState::seen;
      frame.of_feature[i].dissimilarity = 0.02f;
      frame.of_feature[i].found = matches_.current.undistorted[i].cast<float>();
    }
    return frame;
  }

  static void move(OlderFrame& frame, std::size_t first, std::size_t count, float moved_px) {
    for (std::size_t i = first; i < first + count; ++i) frame.of_feature[i].found += moved_px * Vector2f(0.8f, 0.6f);
  }

  bool stands(bool stood) const { return camera_.since_last_frame(test::observations_of(matches_), stood); }

  StationaryCamera camera_;
  Matches matches_;
};

// ---- Since the last frame ----

TEST_F(StationaryCameraTest, StandsWhereAllIsAtRest) {
  add(100, 0.0, 2.0);
  EXPECT_TRUE(stands(false));
  EXPECT_TRUE(stands(true));
  camera_.is_enabled = false;
  EXPECT_FALSE(stands(false));
  EXPECT_FALSE(stands(true));
}

TEST_F(StationaryCameraTest, WithoutMatchesNothingIsKnown) {
  EXPECT_FALSE(stands(true));
  add(100, 0.0, 2.0);
  for (MatchState& state : matches_.state) state = MatchState::lost;
  EXPECT_FALSE(stands(true));
}

TEST_F(StationaryCameraTest, BeginsToStandWithNineTenths) {
  add(91, 0.0, kNoDepth);
  add(9, 2.0, kNoDepth);
  EXPECT_TRUE(stands(false));
  add(9, 2.0, kNoDepth);
  EXPECT_FALSE(stands(false)) << "91 of 109";
}

TEST_F(StationaryCameraTest, AtRestIsWhatMovedLess) {
  add(10, 0.29, 2.0);
  EXPECT_TRUE(stands(false));
  matches_.resize(0);
  add(10, 0.31, 2.0);
  EXPECT_FALSE(stands(true)) << "all of them: nothing is left behind";
}

// A person at 0.6 m fills four fifths of the view; a wall at 3 m does not move.
TEST_F(StationaryCameraTest, GoesOnStandingWhileAWallBehindIsAtRest) {
  add(20, 0.0, 3.0);
  add(80, 2.0, 0.6);
  EXPECT_TRUE(stands(true));
  EXPECT_FALSE(stands(false)) << "a camera that moved does not begin to stand with so little";
}

// The camera moves; its own hood moves along, in front.
TEST_F(StationaryCameraTest, ARobotsOwnHoodIsNoWall) {
  add(20, 0.0, 0.4);
  add(80, 2.0, 3.0);
  EXPECT_FALSE(stands(true));
  EXPECT_FALSE(stands(false));
}

TEST_F(StationaryCameraTest, TooSmallAWallProvesNothing) {
  add(4, 0.0, 3.0);
  add(96, 2.0, 0.6);
  EXPECT_FALSE(stands(true)) << "4 % of the corners";
  add(2, 0.0, 3.0);
  EXPECT_TRUE(stands(true)) << "6 of 102";
}

TEST_F(StationaryCameraTest, WithoutDepthNobodyKnowsWhatLiesBehind) {
  add(20, 0.0, kNoDepth);
  add(80, 2.0, kNoDepth);
  EXPECT_FALSE(stands(true)) << "no depth at all";
  matches_.resize(20);
  add(80, 2.0, 0.6);
  EXPECT_FALSE(stands(true)) << "none at rest";
  matches_.resize(0);
  add(20, 0.0, 3.0);
  add(80, 2.0, kNoDepth);
  EXPECT_FALSE(stands(true)) << "none that moves";
}

// Corners without a depth count for the share, but do not draw the mean depth towards them: of 10 at 3 m and 10 without
// a depth the mean is 3 m.
TEST_F(StationaryCameraTest, TheMeanDepthIsOfThoseThatHaveOne) {
  add(10, 0.0, 0.5);
  add(10, 0.0, kNoDepth);
  add(80, 2.0, 0.6);
  EXPECT_FALSE(stands(true)) << "at rest at 0.5 m is in front of 0.6 m";
  matches_.resize(0);
  add(20, 0.0, 3.0);
  add(5, 2.0, 2.5);
  add(75, 2.0, kNoDepth);
  EXPECT_TRUE(stands(true)) << "3 m is behind 2.5 m";
}

TEST_F(StationaryCameraTest, ALowStaticPriorAtRestProvesLess) {
  add(20, 0.0, 3.0, 0.1f);
  add(80, 2.0, 0.6);
  EXPECT_FALSE(stands(true)) << "2 of 82";
}

TEST_F(StationaryCameraTest, ALowStaticPriorInMotionDisprovesLess) {
  add(50, 0.0, 2.0);
  add(50, 2.0, 2.0, 0.1f);
  EXPECT_TRUE(stands(false)) << "50 of 55";
  for (float& prior : matches_.space_static_prior) prior = 1.0f;
  EXPECT_FALSE(stands(false)) << "50 of 100";
}

// A hood of a low static prior before a wall: by weight what rests is at 1 / ((10 / 3 + 0.1 · 10 / 0.3) / 11) = 1.65 m,
// behind the 1 m of what moves; by count it would be at 1 / ((10 / 3 + 10 / 0.3) / 20) = 0.55 m. And a wall of a low
// one behind a hood: at 1 / ((10 / 0.9 + 0.1 · 10 / 3) / 11) = 0.96 m by weight, at 1 / ((10 / 0.9 + 10 / 3) / 20)
// = 1.38 m by count.
TEST_F(StationaryCameraTest, TheStaticPriorWeighsTheDepthsToo) {
  add(10, 0.0, 3.0);
  add(10, 0.0, 0.3, 0.1f);
  add(80, 2.0, 1.0);
  EXPECT_TRUE(stands(true));
  for (float& prior : matches_.space_static_prior) prior = 1.0f;
  EXPECT_FALSE(stands(true));
  matches_.resize(0);
  add(10, 0.0, 0.9);
  add(10, 0.0, 3.0, 0.1f);
  add(80, 2.0, 1.0);
  EXPECT_FALSE(stands(true));
  for (float& prior : matches_.space_static_prior) prior = 1.0f;
  EXPECT_TRUE(stands(true));
}

// ---- Since older frames ----

TEST_F(StationaryCameraTest, WithoutAnOlderFrameNothingSpeaksAgainst) {
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_)));
}

TEST_F(StationaryCameraTest, ASlowMotionShowsInAnOlderFrame) {
  add(100, 0.05, 2.0);
  reproject_into_past();
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_)));
  move(reproject_into_past(), 0, 100, 0.5f);
  EXPECT_TRUE(stands(true)) << "not to be seen from frame to frame";
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_))) << "all moved by half a pixel";
}

TEST_F(StationaryCameraTest, TheOldestFrameOfTheStandIsAsked) {
  add(100, 0.0, 2.0);
  move(reproject_into_past(), 0, 100, 0.5f);
  reproject_into_past();
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_))) << "frames come the nearest in time first";
}

TEST_F(StationaryCameraTest, AFrameFromBeforeTheStandIsNotAsked) {
  add(100, 0.0, 2.0);
  OlderFrame& moved = reproject_into_past(test::pose_of(Vector3d::Zero(), {0.01, 0, 0}));
  move(moved, 0, 100, 5.0f);
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_))) << "nobody to ask";
  matches_.past_observations.clear();
  move(reproject_into_past(), 0, 100, 0.5f);
  move(reproject_into_past(test::pose_of({1e-5, 0, 0}, Vector3d::Zero())), 0, 100, 0.0f);
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_)))
      << "the older one is not of the stand, however near its pose";
}

// Since the camera turned, poses are chained: one that is the identity is rounded.
TEST_F(StationaryCameraTest, AFrameOfTheStandMayHaveARoundedPose) {
  add(100, 0.05, 2.0);
  move(reproject_into_past(test::pose_of({1e-14, 0, -2e-15}, {3e-15, 0, 0})), 0, 100, 0.5f);
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_)));
}

// The person and the wall of above, half a second ago.
TEST_F(StationaryCameraTest, AWallBehindAPersonIsEnoughInAnOlderFrameToo) {
  add(20, 0.0, 3.0);
  add(80, 0.0, 0.6);
  move(reproject_into_past(), 20, 80, 4.0f);
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_)));
  matches_.past_observations.clear();
  move(reproject_into_past(), 0, 90, 4.0f);
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_)))
      << "all that is left at rest belongs to the person";
}

// What moved by 4 px is at 2 m. If the camera had moved, a wall at 140 m would have by 4 · 2 / 140 = 0.057 px, one at
// 180 m by 0.044 px.
TEST_F(StationaryCameraTest, AWallTooFarAwayToShowTheMotionProvesNothing) {
  for (const auto& [wall_m, is_evidence] : {std::pair(140.0, true), std::pair(180.0, false)}) {
    matches_ = Matches();
    add(20, 0.0, wall_m);
    add(80, 4.0, 2.0);
    EXPECT_EQ(stands(true), is_evidence) << wall_m;
    move(reproject_into_past(), 20, 80, 4.0f);
    EXPECT_EQ(camera_.since_older_frames(test::observations_of(matches_)), is_evidence) << wall_m;
  }
}

TEST_F(StationaryCameraTest, NorDoesItWhereItIsTheMajority) {
  for (const auto& [wall_m, is_evidence] : {std::pair(140.0, true), std::pair(180.0, false)}) {
    matches_ = Matches();
    add(95, 0.0, wall_m);
    add(5, 4.0, 2.0);
    EXPECT_EQ(stands(true), is_evidence) << wall_m;
    EXPECT_EQ(stands(false), is_evidence) << wall_m;
  }
  matches_ = Matches();
  add(95, 0.0, kNoDepth);
  add(5, 4.0, 2.0);
  EXPECT_TRUE(stands(true)) << "without a depth nobody knows that it is too far";
}

TEST_F(StationaryCameraTest, ALostObservationSaysNothing) {
  add(100, 0.0, 2.0);
  OlderFrame& frame = reproject_into_past();
  for (std::size_t i = 0; i < 95; ++i) {
    frame.of_feature[i].dissimilarity = kLost;
    frame.of_feature[i].found = {0, 0};
  }
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_))) << "the five that were seen are at rest";
  for (std::size_t i = 0; i < 95; ++i) frame.of_feature[i].found = matches_.current.undistorted[i].cast<float>();
  move(frame, 95, 5, 0.5f);
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_))) << "the five that were seen moved";
}

TEST_F(StationaryCameraTest, WhatWasHiddenOrOutsideSaysNothing) {
  add(100, 0.0, 2.0);
  OlderFrame& frame = reproject_into_past();
  move(frame, 0, 95, 5.0f);
  for (std::size_t i = 0; i < 95; ++i)
    frame.of_feature[i].state = i % 2 == 0 ? ObservationState::occluded : ObservationState::none;
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_)));
}

// Keypoints are where the host's texture is, perhaps all on one mover; corners are spread over the picture.
TEST_F(StationaryCameraTest, OlderFramesAreAskedForTheFiltersOwnCornersOnly) {
  add(100, 0.0, 2.0);
  matches_.host_count = 95;
  OlderFrame& frame = reproject_into_past();
  move(frame, 0, 95, 5.0f);
  EXPECT_TRUE(camera_.since_older_frames(test::observations_of(matches_)));
  move(frame, 95, 5, 0.5f);
  EXPECT_FALSE(camera_.since_older_frames(test::observations_of(matches_)));
}

}  // namespace
}  // namespace stillpoint
