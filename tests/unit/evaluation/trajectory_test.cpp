// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/evaluation/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"

namespace stillpoint {
namespace {

/// Poses at the given times; the x coordinate counts them, so that a pose is known again.
Trajectory at_times(const std::vector<double>& times_s) {
  Trajectory trajectory;
  for (const double time_s : times_s) {
    StampedPose pose;
    pose.timestamp_s = time_s;
    pose.world_from_camera.translation().x() = static_cast<double>(trajectory.size());
    trajectory.push_back(pose);
  }
  return trajectory;
}

std::vector<int> indices(const Trajectory& trajectory) {
  std::vector<int> result;
  for (const StampedPose& pose : trajectory)
    result.push_back(static_cast<int>(pose.world_from_camera.translation().x()));
  return result;
}

TEST(Associate, EachPoseOfTheShorterTakesTheNearestOfTheLonger) {
  // Estimate 0.995 lies between 0.99 and 1.0; the nearest is found by difference, not by order.
  const auto pairs = associate(at_times({0.0, 0.99, 1.0, 2.0}), at_times({0.004, 0.9951, 1.991}));
  EXPECT_EQ(indices(pairs.reference), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(indices(pairs.estimate), (std::vector<int>{0, 1, 2}));
}

TEST(Associate, LimitIsInclusive) {
  const auto at_limit = associate(at_times({0.0, 1.0}), at_times({0.25}), 0.25);
  EXPECT_EQ(at_limit.estimate.size(), 1u);
  const auto beyond = associate(at_times({0.0, 1.0}), at_times({0.26}), 0.25);
  EXPECT_TRUE(beyond.estimate.empty());
}

TEST(Associate, LimitIsATime) {
  for (const double limit_s : {-0.01, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(associate(at_times({0.0}), at_times({0.0}), limit_s), Error) << limit_s;
  EXPECT_EQ(associate(at_times({0.0, 5.0}), at_times({0.0, 0.0, 9.0}), 0.0).reference.size(), 1u);
  EXPECT_EQ(associate(at_times({0.0}), at_times({9.0}), std::numeric_limits<double>::infinity()).reference.size(), 1u);
}

TEST(Associate, TieGoesToTheEarlierAndEqualTimesToTheFirst) {
  const auto tie = associate(at_times({0.0, 0.5, 1.0}), at_times({0.25}), 1.0);
  EXPECT_EQ(indices(tie.reference), std::vector<int>{0});
  const auto equal = associate(at_times({0.0, 0.5, 0.5, 0.5}), at_times({0.6}), 1.0);
  EXPECT_EQ(indices(equal.reference), std::vector<int>{1});
}

TEST(Associate, PoseOfTheLongerMayBeTakenTwice) {
  const auto pairs = associate(at_times({0.0, 5.0, 6.0}), at_times({0.001, 0.002}));
  EXPECT_EQ(indices(pairs.reference), (std::vector<int>{0, 0}));
}

TEST(Associate, OfEqualLengthTheEstimateLooksForPartners) {
  // From the estimate: 0.4 and 0.6 both find 0.5. From the reference: 0.5 would find 0.4, and 9 nothing.
  const auto pairs = associate(at_times({0.5, 9.0}), at_times({0.4, 0.6}), 0.2);
  EXPECT_EQ(indices(pairs.reference), (std::vector<int>{0, 0}));
  EXPECT_EQ(indices(pairs.estimate), (std::vector<int>{0, 1}));
}

TEST(Associate, ReferenceMayBeTheShorterOne) {
  const auto pairs = associate(at_times({1.0}), at_times({0.0, 0.999, 2.0}));
  EXPECT_EQ(indices(pairs.reference), std::vector<int>{0});
  EXPECT_EQ(indices(pairs.estimate), std::vector<int>{1});
}

TEST(Associate, EmptyTrajectoryGivesNoPair) {
  EXPECT_TRUE(associate({}, at_times({1.0})).reference.empty());
  EXPECT_TRUE(associate(at_times({1.0}), {}).reference.empty());
  EXPECT_TRUE(associate({}, {}).reference.empty());
}

TEST(Associate, AgreesWithSearchOverAllPairs) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const auto times = [&random](std::size_t count) {
      std::vector<double> result;
      double time_s = 0.0;
      // Multiples of 1/64 are exact, so that ties and equal times happen and mean the same in both searches.
      for (std::size_t i = 0; i < count; ++i) result.push_back(time_s += static_cast<double>(random.index(4)) / 64.0);
      return result;
    };
    const std::vector<double> longer = times(30), shorter = times(1 + random.index(29));
    constexpr double kLimit_s = 1.0 / 64.0;
    std::vector<int> expected_shorter, expected_longer;
    for (std::size_t i = 0; i < shorter.size(); ++i) {
      std::size_t best = 0;
      for (std::size_t j = 0; j < longer.size(); ++j)
        if (std::abs(longer[j] - shorter[i]) < std::abs(longer[best] - shorter[i])) best = j;
      if (std::abs(longer[best] - shorter[i]) > kLimit_s) continue;
      expected_shorter.push_back(static_cast<int>(i));
      expected_longer.push_back(static_cast<int>(best));
    }
    const auto pairs = associate(at_times(longer), at_times(shorter), kLimit_s);
    EXPECT_EQ(indices(pairs.estimate), expected_shorter) << "seed " << seed;
    EXPECT_EQ(indices(pairs.reference), expected_longer) << "seed " << seed;
  }
}

TEST(Associate, TimeRunningBackwardsOrNotFiniteIsNamed) {
  const auto message = [](const Trajectory& reference, const Trajectory& estimate) {
    return error_of([&] { associate(reference, estimate); });
  };
  EXPECT_EQ(
      message(at_times({1.0}), at_times({2.0, 1.5})),
      "estimated trajectory: timestamp of pose 1 is 1.500000, expected a finite time not before the previous pose's");
  EXPECT_EQ(message(at_times({std::numeric_limits<double>::quiet_NaN()}), at_times({2.0})),
            "reference trajectory: timestamp of pose 0 is nan, expected a finite time not before the previous pose's");
}

}  // namespace
}  // namespace stillpoint
