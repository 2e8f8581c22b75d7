// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/matches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"

namespace stillpoint {
namespace {

TEST(Matches, BeginForgetsTheFrameBefore) {
  const Camera camera(500, 500, 320, 240, 640, 480);
  const std::vector<Vector2f> first = {{1, 2}, {3, 4}, {5, 6}}, second = {{7, 8}, {9, 10}};
  Matches matches;
  matches.begin(first);
  matches.resize(5);  // two corners of the matcher's own
  matches.state[1] = MatchState::matched;
  matches.reference.pixel[1] = {3, 3};
  matches.current.undistorted[1] = matches.reference.undistorted[1] = {3, 4};
  matches.current.set_depth(1, 2.0, 0.01, camera);
  matches.reference.set_depth(1, 2.0, 0.01, camera);
  ASSERT_TRUE(matches.metric(1));
  EXPECT_EQ(matches.host_count, 3u);
  EXPECT_EQ(matches.size(), 5u);

  matches.begin(second);
  EXPECT_EQ(matches.host_count, 2u);
  EXPECT_EQ(matches.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(matches.current.pixel[i], second[i]);
    EXPECT_EQ(matches.state[i], MatchState::lost);
    EXPECT_TRUE(matches.reference.pixel[i].array().isNaN().all());
    EXPECT_TRUE(matches.current.point[i].array().isNaN().all());
    EXPECT_TRUE(matches.current.undistorted[i].array().isNaN().all());
    EXPECT_EQ(matches.current.depth_m[i], 0.0);
    EXPECT_EQ(matches.current.depth_sigma_m[i], std::numeric_limits<double>::infinity());
    EXPECT_FALSE(matches.matched(i) || matches.metric(i));
  }
}

TEST(Matches, AreMetricOnlyWhenMatchedWithDepthAtBothEnds) {
  const Camera camera(500, 500, 320, 240, 640, 480);
  for (const MatchState state : {MatchState::matched, MatchState::lost, MatchState::near_edge, MatchState::outside}) {
    for (int depths = 0; depths < 4; ++depths) {
      const std::vector<Vector2f> pixel = {{1, 2}};
      Matches matches;
      matches.begin(pixel);
      matches.state[0] = state;
      matches.current.set_depth(0, depths & 1 ? 1.0 : 0.0, 0.01, camera);
      matches.reference.set_depth(0, depths & 2 ? 1.0 : 0.0, 0.01, camera);
      const bool found = state == MatchState::matched || state == MatchState::near_edge;
      EXPECT_EQ(matches.matched(0), found);
      EXPECT_EQ(matches.metric(0), found && depths == 3);
    }
  }
}

TEST(FrameFeatures, SetDepthTakesADepthBack) {
  const Camera camera(500, 400, 320, 230, 640, 480);
  FrameFeatures observations;
  observations.resize(1);
  observations.undistorted[0] = {420, 170};
  observations.set_depth(0, 2.0, 0.02, camera);
  EXPECT_LE((observations.point[0] - Vector3d(0.4, -0.3, 2.0)).norm(), 1e-15);  // 100 / 500 · 2, −60 / 400 · 2
  EXPECT_EQ(observations.depth_sigma_m[0], 0.02);
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    observations.set_depth(0, 2.0, 0.02, camera);
    observations.set_depth(0, none, 0.02, camera);
    EXPECT_FALSE(observations.has_depth(0));
    EXPECT_EQ(observations.depth_m[0], 0.0);
    EXPECT_EQ(observations.depth_sigma_m[0], std::numeric_limits<double>::infinity());
    EXPECT_TRUE(observations.point[0].array().isNaN().all());
  }
}

}  // namespace
}  // namespace stillpoint
