// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/epipolar/metric_scale.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace stillpoint {
namespace {

TEST(MetricScale, WeightedMedianIgnoresTheWildAndTheNotFinite) {
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<ScaleVote> votes = {{0.1, 0.01}, {0.11, 0.01}, {0.12, 0.01}, {9.0, 0.01}, {-50.0, 1.0}, {kNaN, 0.01}};
  const auto scale = metric_scale(votes, 3);
  ASSERT_TRUE(scale.has_value());
  EXPECT_EQ(scale->metres, 0.11);  // half of the weight (401 / 2) is reached with the second hundred
  EXPECT_FALSE(metric_scale(votes, 6));
  EXPECT_FALSE(metric_scale({}, 0));
}

}  // namespace
}  // namespace stillpoint
