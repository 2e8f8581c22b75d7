// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/pose_refinement.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "observations.hpp"
#include "stillpoint/core/random.hpp"

namespace {

using examples::PointObservation;
using examples::PoseRefinement;
using stillpoint::Pose;
using stillpoint::Random;
using stillpoint::Vector3d;

Pose some_pose(Random& random) {
  Pose pose = Pose::Identity();
  const auto small = [&] { return 0.1 * (2.0 * random.uniform() - 1.0); };
  pose.linear() = stillpoint::rotation_from_vector({small(), small(), small()});
  pose.translation() = Vector3d(small(), small(), small());
  return pose;
}

TEST(PoseRefinement, FindsThePoseOfExactObservations) {
  Random random(1);
  for (int run = 0; run < 50; ++run) {
    const Pose truth = some_pose(random);
    std::vector<PointObservation> observations;
    for (int i = 0; i < 40; ++i) observations.push_back(observation(random, truth));
    Pose pose = Pose::Identity();
    std::vector<std::uint8_t> inlier;
    EXPECT_EQ(PoseRefinement{}(observations, camera(), pose, inlier), 40u);
    EXPECT_LT(error_m(pose, truth),
              1e-6);  // metres; without noise a step squares the error, and the last is below 1e-5
  }
}

TEST(PoseRefinement, WrongObservationsAreLeftOut) {
  Random random(2);
  for (int run = 0; run < 50; ++run) {
    const Pose truth = some_pose(random);
    std::vector<PointObservation> observations;
    for (int i = 0; i < 60; ++i) {
      observations.push_back(observation(random, truth));
      if (i % 4 == 0) observations.back().pixel.x() += 30.0;
    }
    Pose pose = truth;
    std::vector<std::uint8_t> inlier;
    EXPECT_EQ(PoseRefinement{}(observations, camera(), pose, inlier), 45u);
    for (std::size_t i = 0; i < inlier.size(); ++i) EXPECT_EQ(inlier[i], i % 4 == 0 ? 0 : 1);
    EXPECT_LT(error_m(pose, truth), 1e-6);
  }
}

// With noise a step leaves a share of the error: the reweighting lags behind. A round ends at a step of 10 µm, so it is
// off by no more than about that from where steps of a picometre end.
TEST(PoseRefinement, ARoundEndsWhereTheNextStepWouldNotMatter) {
  Random random(5);
  for (int run = 0; run < 20; ++run) {
    const Pose truth = some_pose(random);
    std::vector<PointObservation> observations;
    for (int i = 0; i < 60; ++i) {
      observations.push_back(observation(random, truth));
      observations.back().pixel += 4.0 * stillpoint::Vector2d(random.uniform() - 0.5, random.uniform() - 0.5);
    }
    PoseRefinement refine, refine_fully;
    refine.options.rounds = refine_fully.options.rounds = 1;
    refine.options.iterations = refine_fully.options.iterations = 100;
    refine_fully.options.converged = 1e-12;
    Pose pose = Pose::Identity(), limit = Pose::Identity();
    std::vector<std::uint8_t> inlier;
    refine(observations, camera(), pose, inlier);
    refine_fully(observations, camera(), limit, inlier);
    EXPECT_LT(error_m(pose, limit), 2e-5) << "run " << run;
  }
}

// Thirty observations of the world, and ninety of a mover that went on by 4 mm, within the noise that is assumed:
// they pull the pose along by their share of the weight, 90 w / (30 + 90 w). All in full: 3 mm; with a weight of 1/60:
// 0.2 mm.
TEST(PoseRefinement, WeightsSayHowMuchAnObservationPulls) {
  for (const double weight : {1.0, 1.0 / 60.0}) {
    Random random(4);
    const Pose truth = some_pose(random);
    std::vector<PointObservation> observations;
    for (int i = 0; i < 120; ++i) {
      observations.push_back(observation(random, truth));
      observations.back().pixel_sigma = 20.0;
      observations.back().depth_sigma_m = 0.1;
      if (i % 4 == 0) continue;
      observations.back().p_world.x() += 0.004;
      observations.back().weight = weight;
    }
    Pose pose = truth;
    pose.translation().x() += 0.01;
    std::vector<std::uint8_t> inlier;
    PoseRefinement{}(observations, camera(), pose, inlier);
    EXPECT_NEAR(error_m(pose, truth), 0.004 * 90 * weight / (30 + 90 * weight), 0.0003) << weight;
  }
}

// A camera that went 0.5 m aside sees a point, 2 m off in the old view, 525 * 0.5 / 2 = 131 px further left. With an
// old depth that was 3 % (0.06 m) too long it expects 525 * 0.5 / 2.06 = 127.4 px, 3.8 px off: at 0.5 px far beyond the
// limit of 2.8 deviations, but with 0.05 m for the depth's own deviation (3.3 px here) it is as good an observation as
// any.
TEST(PoseRefinement, AnUncertainPointMayMissItsPixel) {
  Random random(3);
  Pose truth = Pose::Identity();
  truth.translation().x() = -0.5;
  std::vector<PointObservation> observations;
  for (int i = 0; i < 40; ++i) {
    observations.push_back(observation(random, truth));
    observations.back().pixel_sigma = 0.5;
  }
  const Vector3d p_world(0.3, 0.0, 2.0);
  PointObservation too_long{1.03 * p_world, camera().project(truth * p_world), 0.5};
  observations.push_back(too_long);
  too_long.p_sigma_m = p_world * (0.05 / p_world.z());
  observations.push_back(too_long);
  Pose pose = truth;
  std::vector<std::uint8_t> inlier;
  EXPECT_EQ(PoseRefinement{}(observations, camera(), pose, inlier), 41u);
  EXPECT_EQ(inlier[40], 0);
  EXPECT_EQ(inlier[41], 1);
}

TEST(PoseRefinement, APointBehindTheCameraFitsNothing) {
  Random random(4);
  std::vector<PointObservation> observations;
  for (int i = 0; i < 20; ++i) observations.push_back(observation(random, Pose::Identity()));
  observations.push_back({Vector3d(0, 0, -1), {319.5, 239.5}});
  observations.back().p_sigma_m = Vector3d(0, 0, 1);
  Pose pose = Pose::Identity();
  std::vector<std::uint8_t> inlier;
  EXPECT_EQ(PoseRefinement{}(observations, camera(), pose, inlier), 20u);
  EXPECT_EQ(inlier.back(), 0);
  EXPECT_LT(error_m(pose, Pose::Identity()), 1e-9);  // metres; it starts at the truth
}

}  // namespace
