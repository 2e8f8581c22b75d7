// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/robust_pose.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightings.hpp"
#include "stillpoint/core/random.hpp"

namespace {

using examples::PointSighting;
using examples::RobustPose;
using stillpoint::Pose;
using stillpoint::Random;

Pose aside(double x_m) {
  Pose pose = Pose::Identity();
  pose.translation().x() = x_m;
  return pose;
}

/// Sightings of the room, whose pose is the identity, then of a mover, which looks like `mover` meant for the camera.
std::vector<PointSighting> room_and_mover(Random& random, int of_room, int of_mover, const Pose& mover) {
  std::vector<PointSighting> sightings;
  for (int i = 0; i < of_room + of_mover; ++i) {
    sightings.push_back(sighting(random, i < of_room ? Pose::Identity() : mover));
    sightings.back().feature = static_cast<std::size_t>(i);
  }
  return sightings;
}

TEST(RobustPose, NearTheExpectedPoseAMinorityIsEnough) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const std::vector<PointSighting> sightings = room_and_mover(random, 40, 60, aside(0.3));
    Pose pose = aside(0.005);
    std::vector<std::uint8_t> inlier;
    ASSERT_TRUE(RobustPose{}(sightings, camera(), pose, inlier)) << seed;
    EXPECT_LT(error_m(pose, Pose::Identity()), 1e-3) << seed;
    for (std::size_t i = 0; i < inlier.size(); ++i) EXPECT_EQ(inlier[i], i < 40 ? 1 : 0) << seed;
  }
}

// Expected a fifth of a metre off, the search ends at the mover, which two features in five fit, more than the share of
// 0.3: but that is not near, and the room is likelier.
TEST(RobustPose, WhatTheSearchRunsOffToIsComparedWithRansac) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const std::vector<PointSighting> sightings = room_and_mover(random, 60, 40, aside(0.6));
    Pose pose = aside(0.8);
    std::vector<std::uint8_t> inlier;
    examples::PoseRefinement search;
    Pose searched = pose;
    search(sightings, camera(), searched, inlier);
    ASSERT_LT(error_m(searched, aside(0.6)), 1e-3) << seed;  // else this tests something else
    ASSERT_TRUE(RobustPose{}(sightings, camera(), pose, inlier)) << seed;
    EXPECT_LT(error_m(pose, Pose::Identity()), 1e-3) << seed;
  }
}

// Neither is near, and the search ends at the mover, which most features fit: RANSAC finds it too.
TEST(RobustPose, FarFromTheExpectedPoseTheLikelierIsTaken) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const std::vector<PointSighting> sightings = room_and_mover(random, 30, 70, aside(0.6));
    Pose pose = aside(0.8);
    std::vector<std::uint8_t> inlier;
    ASSERT_TRUE(RobustPose{}(sightings, camera(), pose, inlier)) << seed;
    EXPECT_LT(error_m(pose, aside(0.6)), 1e-3) << seed;
  }
}

// Eleven features that three keyframes know have 33 sightings that fit: fewer than twelve are no pose.
TEST(RobustPose, FeaturesAreCountedNotSightings) {
  for (const std::size_t features : {std::size_t{11}, std::size_t{12}}) {
    Random random(7);
    std::vector<PointSighting> sightings;
    for (std::size_t i = 0; i < 3 * features; ++i) {
      sightings.push_back(sighting(random, Pose::Identity()));
      sightings.back().feature = i % features;
    }
    Pose pose = aside(0.01);
    std::vector<std::uint8_t> inlier;
    EXPECT_EQ(RobustPose{}(sightings, camera(), pose, inlier), features == 12) << features;
    EXPECT_LT(error_m(pose, features == 12 ? Pose::Identity() : aside(0.01)), 1e-6) << features;
  }
}

TEST(RobustPose, WithoutAgreementThePoseStays) {
  Random random(8);
  std::vector<PointSighting> sightings;
  for (std::size_t i = 0; i < 60; ++i) {
    sightings.push_back(sighting(random, Pose::Identity()));
    sightings.back().pixel = {640 * random.uniform(), 480 * random.uniform()};
    sightings.back().feature = i;
  }
  Pose pose = aside(0.01);
  std::vector<std::uint8_t> inlier;
  EXPECT_FALSE(RobustPose{}(sightings, camera(), pose, inlier));
  EXPECT_TRUE(pose.matrix() == aside(0.01).matrix());
  EXPECT_FALSE(RobustPose{}(stillpoint::span<const PointSighting>(), camera(), pose, inlier));
}

}  // namespace
