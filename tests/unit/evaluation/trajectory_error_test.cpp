// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/evaluation/trajectory_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::trajectory_error_test {
namespace {

constexpr double kRounding = 1e-9;

/// Poses 1 s apart on the x axis.
Trajectory on_a_line(const std::vector<double>& x_m) {
  Trajectory trajectory;
  for (const double x : x_m) {
    StampedPose pose;
    pose.timestamp_s = static_cast<double>(trajectory.size());
    pose.world_from_camera.translation().x() = x;
    trajectory.push_back(pose);
  }
  return trajectory;
}

Trajectory random_walk(Random& random, std::size_t count) {
  Trajectory trajectory;
  StampedPose pose;
  for (std::size_t i = 0; i < count; ++i) {
    pose.timestamp_s = static_cast<double>(i) / 30.0;
    Pose step = Pose::Identity();
    step.linear() = rotation_from_vector(0.1 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian()));
    step.translation() = 0.1 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
    pose.world_from_camera = orthonormalized(pose.world_from_camera * step);
    trajectory.push_back(pose);
  }
  return trajectory;
}

RelativeErrorOptions every(double delta, DeltaUnit unit, PairSelection pairs) {
  RelativeErrorOptions options;
  options.delta = delta;
  options.unit = unit;
  options.pairs = pairs;
  return options;
}

TEST(AbsoluteTrajectoryError, HandComputedWithoutAlignment) {
  Trajectory estimate = on_a_line({0.0, 1.3, 2.0});
  estimate[2].world_from_camera.linear() = rotation_from_vector({0, M_PI / 6, 0});
  const auto result = absolute_trajectory_error(on_a_line({0.0, 1.0, 2.5}), estimate, Alignment::none);
  EXPECT_EQ(result.alignment.status, AlignmentStatus::ok);
  ASSERT_EQ(result.errors.translation_m.size(), 3u);
  EXPECT_NEAR(result.errors.translation_m[0], 0.0, kRounding);
  EXPECT_NEAR(result.errors.translation_m[1], 0.3, kRounding);
  EXPECT_NEAR(result.errors.translation_m[2], 0.5, kRounding);
  EXPECT_NEAR(result.errors.rotation_deg[1], 0.0, kRounding);
  EXPECT_NEAR(result.errors.rotation_deg[2], 30.0, kRounding);
  EXPECT_EQ(result.errors.timestamps_s[2], 2.0);
}

TEST(AbsoluteTrajectoryError, AlignmentTakesBackAMovedWorld) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Trajectory reference = random_walk(random, 40);
    Similarity moved;
    moved.rotation = rotation_from_vector({random.gaussian(), random.gaussian(), random.gaussian()});
    moved.translation = Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
    const auto se3 = absolute_trajectory_error(reference, transformed(moved, reference), Alignment::se3);
    EXPECT_LT(error_statistics(se3.errors.translation_m).max, kRounding) << "seed " << seed;
    EXPECT_LT(error_statistics(se3.errors.rotation_deg).max, 1e-5) << "seed " << seed;

    moved.scale = 0.4;
    const Trajectory small = transformed(moved, reference);
    const auto sim3 = absolute_trajectory_error(reference, small, Alignment::sim3);
    EXPECT_LT(error_statistics(sim3.errors.translation_m).max, kRounding) << "seed " << seed;
    EXPECT_NEAR(sim3.alignment.target_from_source.scale, 1 / 0.4, kRounding) << "seed " << seed;
    const auto unscaled = absolute_trajectory_error(reference, small, Alignment::se3);
    EXPECT_GT(error_statistics(unscaled.errors.translation_m).max, 0.01) << "seed " << seed;
  }
}

TEST(AbsoluteTrajectoryError, StraightPathCannotBeAligned) {
  const Trajectory line = on_a_line({0.0, 1.0, 2.0, 3.0});
  const auto result = absolute_trajectory_error(line, line, Alignment::se3);
  EXPECT_EQ(result.alignment.status, AlignmentStatus::collinear);
  EXPECT_TRUE(result.errors.translation_m.empty());
  EXPECT_EQ(absolute_trajectory_error(line, line, Alignment::none).errors.translation_m.size(), 4u);
}

TEST(AbsoluteTrajectoryError, NothingInCommonGivesNoErrors) {
  Trajectory later = on_a_line({0.0, 1.0});
  for (StampedPose& pose : later) pose.timestamp_s += 100.0;
  const auto result = absolute_trajectory_error(on_a_line({0.0, 1.0, 2.0}), later, Alignment::none);
  EXPECT_TRUE(result.errors.translation_m.empty());
  EXPECT_EQ(absolute_trajectory_error({}, {}, Alignment::se3).alignment.status, AlignmentStatus::too_few_points);
}

TEST(RelativeTrajectoryError, HandComputedByFrames) {
  // Steps: reference 1 1 1 1, estimate 1.1 0.8 1 1.5; two frames 2 2 2, estimate 1.9 1.8 2.5.
  const Trajectory reference = on_a_line({0, 1, 2, 3, 4}), estimate = on_a_line({0, 1.1, 1.9, 2.9, 4.4});
  const auto expect_errors = [&](double delta, PairSelection pairs, const std::vector<double>& expected) {
    const auto errors = relative_trajectory_error(reference, estimate, every(delta, DeltaUnit::frames, pairs));
    ASSERT_EQ(errors.translation_m.size(), expected.size()) << delta;
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(errors.translation_m[i], expected[i], kRounding) << delta << ' ' << i;
  };
  expect_errors(1, PairSelection::consecutive, {0.1, 0.2, 0.0, 0.5});
  expect_errors(1, PairSelection::all, {0.1, 0.2, 0.0, 0.5});
  expect_errors(2, PairSelection::all, {0.1, 0.2, 0.5});
  expect_errors(2, PairSelection::consecutive, {0.1, 0.5});
  expect_errors(3, PairSelection::consecutive, {0.1});
  expect_errors(4, PairSelection::all, {0.4});
  expect_errors(5, PairSelection::all, {});
}

TEST(RelativeTrajectoryError, HandComputedByPath) {
  // The estimate's path: 0 0.5 1.0 1.75 2.0 3.0 3.0 3.5 m. Consecutive, 1 m: the first stretch ends at pose 2; from
  // there 0.75 is too short, 1.0 ends at pose 4; then pose 5; then 0.5 is left over.
  const Trajectory estimate = on_a_line({0, 0.5, 1.0, 1.75, 2.0, 3.0, 3.0, 3.5});
  const Trajectory reference = on_a_line({0, 0, 0, 0, 0, 0, 0, 0});
  const auto consecutive =
      relative_trajectory_error(reference, estimate, every(1.0, DeltaUnit::metres, PairSelection::consecutive));
  EXPECT_EQ(consecutive.timestamps_s, (std::vector<double>{4, 5}));

  // All, 1 m within 0.1: 0 to 2; from 1 (target 1.5) 1.75 misses by 0.25; 2 to 4; from 3 (2.75) 3.0 misses; 4 to 5, the
  // first of the two at 3.0; from 5 (4.0) 3.5 misses; so do 6 and 7.
  const auto all = relative_trajectory_error(reference, estimate, every(1.0, DeltaUnit::metres, PairSelection::all));
  EXPECT_EQ(all.timestamps_s, (std::vector<double>{2, 4, 5}));
}

TEST(RelativeTrajectoryError, StandingStillDoesNotHideAPairByPath) {
  const Trajectory estimate = on_a_line({0, 0.5, 0.5, 0.5, 1.0});
  const auto all = relative_trajectory_error(estimate, estimate, every(1.0, DeltaUnit::metres, PairSelection::all));
  EXPECT_EQ(all.timestamps_s, std::vector<double>{4});
}

TEST(RelativeTrajectoryError, DoesNotSeeAMovedWorld) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Trajectory reference = random_walk(random, 40);
    Similarity moved;
    moved.rotation = rotation_from_vector({random.gaussian(), random.gaussian(), random.gaussian()});
    moved.translation = Vector3d(1, 2, 3);
    const auto errors = relative_trajectory_error(reference, transformed(moved, reference));
    EXPECT_EQ(errors.translation_m.size(), 39u);
    EXPECT_LT(error_statistics(errors.translation_m).max, kRounding);
    EXPECT_LT(error_statistics(errors.rotation_deg).max, 1e-5);
  }
}

TEST(RelativeTrajectoryError, ShortTrajectoriesGiveNoErrors) {
  for (const auto unit : {DeltaUnit::frames, DeltaUnit::metres})
    for (const auto pairs : {PairSelection::consecutive, PairSelection::all})
      for (const Trajectory& trajectory : {Trajectory{}, on_a_line({1.0})})
        EXPECT_TRUE(relative_trajectory_error(trajectory, trajectory, every(1, unit, pairs)).translation_m.empty());
}

TEST(RelativeTrajectoryError, DeltaThatMakesNoSenseIsAnError) {
  const auto message = [](double delta, DeltaUnit unit) {
    return error_of([&] { relative_trajectory_error({}, {}, every(delta, unit, PairSelection::all)); });
  };
  EXPECT_EQ(message(1.5, DeltaUnit::frames),
            "relative trajectory error: delta is 1.500000, expected a whole number of frames");
  for (const double delta : {0.0, -1.0, std::nan("")})
    EXPECT_NE(message(delta, DeltaUnit::metres).find("expected a positive number"), std::string::npos) << delta;
}

}  // namespace
}  // namespace stillpoint::trajectory_error_test
