// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/fixed_to_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "motion_scene.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint::fixed_to_camera_test {
namespace {

class FixedToCameraTest : public testing::Test {
 protected:
  /// Corners of one depth that all moved equally far; the next `count` features unless told from which on.
  void add(std::size_t count, double step_px, double depth_m, std::size_t frame = 0) {
    add_features(features, count, step_px, depth_m, frame);
    features += count;
  }
  void add_features(std::size_t first, std::size_t count, double step_px, double depth_m, std::size_t frame) {
    const auto camera = test::test_camera();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d pixel(random.uniform(20, 600), random.uniform(20, 460));
      PointConstraint point;
      point.point = camera.back_project(pixel, depth_m > 0 ? depth_m : 2.0);
      point.pixel = pixel + Vector2d(0.6, 0.8) * step_px;
      point.depth_m = depth_m;
      point.depth_slope = depth_m > 0 ? 100.0 : 0.0;
      point.weight = 0.8;
      point.weight_without_prior = 0.9;
      point.frame = frame;
      point.feature = first + i;
      points.push_back(point);
    }
  }

  /// Which constraints lost their weight.
  std::vector<bool> down_weighted() {
    stage.down_weight(points, features, test::test_camera(), workspace);
    std::vector<bool> lost;
    for (const PointConstraint& point : points) {
      EXPECT_EQ(point.weight < 0.1, point.weight_without_prior < 0.1);
      EXPECT_TRUE(point.weight < 0.1 || point.weight == 0.8);
      lost.push_back(point.weight < 0.1);
    }
    return lost;
  }

  /// The first `fixed` of the constraints, and no others.
  std::vector<bool> first(std::size_t fixed) const {
    std::vector<bool> flags(points.size(), false);
    std::fill_n(flags.begin(), fixed, true);
    return flags;
  }

  FixedToCamera stage;
  std::vector<PointConstraint> points;
  std::size_t features = 0;
  Random random{1};
  Workspace workspace;
};

TEST_F(FixedToCameraTest, WhatStaysBeforeAllThatMovesIs) {
  add(20, 0.1, 0.45);
  add(80, 2.0, 3.0);
  EXPECT_EQ(down_weighted(), first(20));
}

TEST_F(FixedToCameraTest, SwitchedOffNothingIs) {
  stage.is_enabled = false;
  add(20, 0.1, 0.45);
  add(80, 2.0, 3.0);
  EXPECT_EQ(down_weighted(), first(0));
}

TEST_F(FixedToCameraTest, WithoutConstraintsNothingIs) { EXPECT_EQ(down_weighted(), first(0)); }

// 0.3 px, as for `StationaryCamera`.
TEST_F(FixedToCameraTest, WhatMovesALittleIsNot) {
  add(10, 0.28, 0.45);
  add(10, 0.32, 0.45);
  add(80, 2.0, 3.0);
  EXPECT_EQ(down_weighted(), first(10));
}

// The others move by 0.95 px: noise may have left the near ones at rest.
TEST_F(FixedToCameraTest, WhereTheOthersHardlyMoveNothingIs) {
  add(20, 0.1, 0.45);
  add(80, 0.95, 3.0);
  EXPECT_EQ(down_weighted(), first(0));
}

// Harmonic mean depth of the others: 2 / (1/2 + 1/6) = 3 m; what is fixed lies within 2.1 m.
TEST_F(FixedToCameraTest, ItLiesBeforeTheOthers) {
  add(10, 0.0, 2.05);
  add(2, 0.0, 2.15);
  add(40, 2.0, 2.0);
  add(40, 2.0, 6.0);
  EXPECT_EQ(down_weighted(), first(10));
}

// Somebody walks through the view of a stationary camera, a table is near, and the wall stays where it is: 9 of 80 are
// more than a tenth.
TEST_F(FixedToCameraTest, WhereSomethingFartherStaysTheCameraMayBeStationary) {
  add(20, 0.0, 0.45);
  add(9, 0.0, 4.0);
  add(80, 3.0, 2.0);
  EXPECT_EQ(down_weighted(), first(0));
}

TEST_F(FixedToCameraTest, AFewThatStayFartherAwayDoNotMatter) {
  add(20, 0.0, 0.45);
  add(7, 0.0, 4.0);
  add(80, 3.0, 2.0);
  EXPECT_EQ(down_weighted(), first(20));
}

// Four of 84 are fewer than a twentieth: near the point about which a camera turns some stay by chance.
TEST_F(FixedToCameraTest, AFewCornersAreNothing) {
  add(4, 0.0, 0.45);
  add(80, 3.0, 2.0);
  EXPECT_EQ(down_weighted(), first(0));
}

// What has no depth may be near or out of range: it is neither fixed nor behind.
TEST_F(FixedToCameraTest, WithoutADepthNobodyKnowsWhereItLies) {
  add(20, 0.0, 0.45);
  add(20, 0.0, 0.0);
  add(80, 3.0, 2.0);
  EXPECT_EQ(down_weighted(), first(20));
}

TEST_F(FixedToCameraTest, WhereNothingThatMovesHasADepthNothingIs) {
  add(20, 0.0, 0.45);
  add(80, 3.0, 0.0);
  EXPECT_EQ(down_weighted(), first(0));
}

// What moved before has little weight in the motion: it is no world to lie before.
TEST_F(FixedToCameraTest, TheWeightsCount) {
  add(20, 0.0, 0.45);
  add(80, 0.5, 3.0);
  add(80, 5.0, 1.0);
  for (std::size_t k = 100; k < 180; ++k) points[k].weight = 0.008;
  stage.down_weight(points, features, test::test_camera(), workspace);
  EXPECT_EQ(points[0].weight, 0.8);
}

// A slow camera: from frame to frame the world moves by half a pixel, since an older one by five.
TEST_F(FixedToCameraTest, AnOlderFrameSpeaksForAll) {
  add(20, 0.0, 0.45);
  add(80, 0.5, 3.0);
  add_features(0, 20, 0.1, 0.45, 1);
  add_features(20, 80, 5.0, 3.0, 1);
  std::vector<bool> expected = first(20);
  std::fill_n(expected.begin() + 100, 20, true);
  EXPECT_EQ(down_weighted(), expected);
}

}  // namespace
}  // namespace stillpoint::fixed_to_camera_test
