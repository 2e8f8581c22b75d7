// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/pipeline/mean_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stillpoint {
namespace {

/// Turning about y and going along x.
Pose step(double turn_rad, double length_m) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_vector({0, turn_rad, 0});
  pose.translation().x() = length_m;
  return pose;
}

TEST(MeanVelocity, KnowsNothingAtFirstAndWhenItForgets) {
  MeanVelocity velocity;
  EXPECT_FALSE(velocity.during(0.1));
  velocity.add(step(0.1, 1.0), 0.1);
  EXPECT_TRUE(velocity.during(0.1));
  velocity.forget();
  EXPECT_FALSE(velocity.during(0.1));
}

TEST(MeanVelocity, TheFirstMotionCountsInFull) {
  MeanVelocity velocity;
  velocity.add(step(0.02, 0.1), 0.1);
  EXPECT_TRUE(velocity.during(0.1)->isApprox(step(0.02, 0.1), 1e-12));
  EXPECT_TRUE(velocity.during(0.05)->isApprox(step(0.01, 0.05), 1e-12));
}

// After 0.1 s · ln 2 half of what was known is left: halfway between 1 and 3 m/s, 0.2 and 0.6 rad/s.
TEST(MeanVelocity, ForgetsInATenthOfASecond) {
  const double half_life_s = MeanVelocity::kMemory_s * std::log(2.0);
  MeanVelocity velocity;
  velocity.add(step(0.2, 1.0), 1.0);
  velocity.add(step(0.6 * half_life_s, 3.0 * half_life_s), half_life_s);
  EXPECT_TRUE(velocity.during(0.1)->isApprox(step(0.04, 0.2), 1e-12));
}

// Two steps of half the length say what one says: the frame rate does not matter.
TEST(MeanVelocity, IsTheSameAtEveryFrameRate) {
  MeanVelocity slow, fast;
  for (MeanVelocity* velocity : {&slow, &fast}) velocity->add(step(0.2, 1.0), 1.0);
  slow.add(step(0.02, 0.4), 0.1);
  for (int half = 0; half < 2; ++half) fast.add(step(0.01, 0.2), 0.05);
  EXPECT_TRUE(slow.during(0.1)->isApprox(*fast.during(0.1), 1e-12));
}

}  // namespace
}  // namespace stillpoint
