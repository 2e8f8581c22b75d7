// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/robust_pose.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "observations.hpp"
#include "stillpoint/core/random.hpp"

namespace {

using examples::PointObservation;
using examples::RobustPose;
using stillpoint::Pose;
using stillpoint::Random;

constexpr std::uint64_t kScenes = 20;

/// A room, whose pose is the identity, and a mover, which looks like `mover_pose` meant for the camera.
struct RoomAndMover {
  int of_room, of_mover;
  Pose mover_pose;

  /// Of the room first. Another scene for each seed.
  std::vector<PointObservation> observations(std::uint64_t seed) const {
    Random random(seed);
    std::vector<PointObservation> result;
    for (int i = 0; i < of_room + of_mover; ++i) {
      result.push_back(observation(random, i < of_room ? Pose::Identity() : mover_pose));
      result.back().feature = static_cast<std::size_t>(i);
    }
    return result;
  }
};

/// From `expected` the pose of the room is found, or that of the mover, and what fits it.
void expect_room(bool is_room, const RoomAndMover& scene, const Pose& expected) {
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Pose pose = expected;
    std::vector<std::uint8_t> inlier;
    ASSERT_TRUE(RobustPose{}(scene.observations(seed), camera(), pose, inlier)) << seed;
    EXPECT_LT(error_m(pose, is_room ? Pose::Identity() : scene.mover_pose), 1e-3) << seed;
    for (int i = 0; i < scene.of_room + scene.of_mover; ++i)
      EXPECT_EQ(inlier[static_cast<std::size_t>(i)], (i < scene.of_room) == is_room ? 1 : 0) << seed;
  }
}

TEST(RobustPose, NearTheExpectedPoseAMinorityIsEnough) { expect_room(true, {40, 60, aside(0.3)}, aside(0.005)); }

// Expected a fifth of a metre off, the search ends at the mover, which two features in five fit, more than the share of
// 0.3: but that is not near, and the room is likelier.
TEST(RobustPose, WhatTheSearchRunsOffToIsComparedWithRansac) {
  const RoomAndMover scene{60, 40, aside(0.6)};
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Pose searched = aside(0.8);
    std::vector<std::uint8_t> inlier;
    examples::PoseRefinement{}(scene.observations(seed), camera(), searched, inlier);
    ASSERT_LT(error_m(searched, scene.mover_pose), 1e-3) << seed;  // else this tests something else
  }
  expect_room(true, scene, aside(0.8));
}

// Neither is near, and the search ends at the mover, which most features fit: RANSAC finds it too.
TEST(RobustPose, FarFromTheExpectedPoseTheLikelierIsTaken) { expect_room(false, {30, 70, aside(0.6)}, aside(0.8)); }

// Eleven features that three keyframes know have 33 observations that fit: fewer than twelve are no pose.
TEST(RobustPose, FeaturesAreCountedNotObservations) {
  for (const std::size_t features : {std::size_t{11}, std::size_t{12}}) {
    Random random(7);
    std::vector<PointObservation> observations;
    for (std::size_t i = 0; i < 3 * features; ++i) {
      observations.push_back(observation(random, Pose::Identity()));
      observations.back().feature = i % features;
    }
    Pose pose = aside(0.01);
    std::vector<std::uint8_t> inlier;
    EXPECT_EQ(RobustPose{}(observations, camera(), pose, inlier), features == 12) << features;
    EXPECT_LT(error_m(pose, features == 12 ? Pose::Identity() : aside(0.01)), 1e-6) << features;
  }
}

TEST(RobustPose, WithoutAgreementThePoseStays) {
  Random random(8);
  std::vector<PointObservation> observations;
  for (std::size_t i = 0; i < 60; ++i) {
    observations.push_back(observation(random, Pose::Identity()));
    observations.back().pixel = {640 * random.uniform(), 480 * random.uniform()};
    observations.back().feature = i;
  }
  Pose pose = aside(0.01);
  std::vector<std::uint8_t> inlier;
  EXPECT_FALSE(RobustPose{}(observations, camera(), pose, inlier));
  EXPECT_TRUE(pose.matrix() == aside(0.01).matrix());
  EXPECT_FALSE(RobustPose{}(stillpoint::span<const PointObservation>(), camera(), pose, inlier));
}

}  // namespace
