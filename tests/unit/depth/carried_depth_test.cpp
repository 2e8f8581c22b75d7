// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/carried_depth.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint::carried_depth_test {
namespace {

constexpr int kWidth = 160, kHeight = 120;

/// A board 1 m before the camera, a wall at 3 m. The camera stands; when depth was measured the board covered columns
/// 60 to 99 and rows 40 to 79, and it has gone 10 px to the right since.
class CarriedDepthTest : public testing::Test {
 protected:
  CarriedDepthTest() {
    gray_.resize(kWidth, kHeight, PixelFormat::gray8);
    paint(1);
  }

  void paint(int shrink) {
    depth_.resize(kWidth / shrink, kHeight / shrink, PixelFormat::depth16);
    for (int v = 0; v < kHeight / shrink; ++v)
      for (int u = 0; u < kWidth / shrink; ++u)
        depth_.row<std::uint16_t>(v)[u] =
            u >= 60 / shrink && u < 100 / shrink && v >= 40 / shrink && v < 80 / shrink ? 1000 : 3000;
  }

  void corner(float x, float y, float flow_x, MatchState state = MatchState::matched) {
    const std::size_t i = matches_.size();
    matches_.resize(i + 1);
    matches_.current.pixel[i] = {x, y};
    matches_.reference.pixel[i] = {x - flow_x, y};
    matches_.state[i] = state;
  }

  void board_corners() {
    for (const float x : {75.0f, 90.0f, 105.0f})
      for (const float y : {45.0f, 60.0f, 75.0f}) corner(x, y, 10);
  }
  void wall_corners() {
    for (const float x : {45.0f, 55.0f, 120.0f, 130.0f})
      for (const float y : {30.0f, 60.0f, 90.0f}) corner(x, y, 0);
  }

  DepthView as_it_came() const { return DepthView::millimetres(depth_.view()); }

  /// @param current  the static depth, some of its holes filled; as it came, where the camera stands
  DepthView carried(const DepthView& current, double delay = 1.0) {
    return carried_(FrameView(gray_.view(), as_it_came(), 0.0), as_it_came(), current, delay, matches_, workspace_);
  }
  DepthView carried(double delay = 1.0) { return carried(as_it_came(), delay); }

  ImageBuffer gray_, depth_;
  Matches matches_;
  Workspace workspace_;
  CarriedDepth carried_;
};

TEST_F(CarriedDepthTest, ASurfaceIsWhereItsCornersCarriedIt) {
  board_corners();
  wall_corners();
  const DepthView depth = carried();
  EXPECT_EQ(depth.metres(69, 60), 3.0f) << "uncovered: as the wall's corners";
  EXPECT_EQ(depth.metres(70, 60), 1.0f);
  EXPECT_EQ(depth.metres(109, 60), 1.0f);
  EXPECT_EQ(depth.metres(110, 60), 3.0f);
  EXPECT_EQ(depth.metres(80, 39), 3.0f);
  EXPECT_EQ(depth.metres(80, 40), 1.0f);
  EXPECT_EQ(depth.metres(80, 79), 1.0f);
  EXPECT_EQ(depth.metres(80, 80), 3.0f);
}

// Half of the time between frames, half of the way.
TEST_F(CarriedDepthTest, ByAsMuchAsItIsLate) {
  board_corners();
  wall_corners();
  const DepthView depth = carried(0.5);
  EXPECT_EQ(depth.metres(64, 60), 3.0f);
  EXPECT_EQ(depth.metres(65, 60), 1.0f);
  EXPECT_EQ(depth.metres(104, 60), 1.0f);
  EXPECT_EQ(depth.metres(105, 60), 3.0f);
}

TEST_F(CarriedDepthTest, DepthThatIsTooNewGoesBack) {
  board_corners();
  wall_corners();
  const DepthView depth = carried(-1.0);
  EXPECT_EQ(depth.metres(49, 60), 3.0f);
  EXPECT_EQ(depth.metres(50, 60), 1.0f);
  EXPECT_EQ(depth.metres(89, 60), 1.0f);
  EXPECT_EQ(depth.metres(90, 60), 3.0f);
}

// What it has left is not the board's any more, and nobody knows the wall's depth.
TEST_F(CarriedDepthTest, WithoutAnythingBehindNothingIsKnownThere) {
  board_corners();
  const DepthView depth = carried();
  EXPECT_EQ(depth.metres(69, 60), 0.0f);
  EXPECT_EQ(depth.metres(70, 60), 1.0f);
  EXPECT_EQ(depth.metres(109, 60), 1.0f);
  EXPECT_EQ(depth.metres(110, 60), 3.0f) << "as it came";
}

TEST_F(CarriedDepthTest, WithoutCornersDepthIsAsItWas) {
  corner(90, 60, 10, MatchState::lost);
  const DepthView depth = carried();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(depth.metres(u, v), as_it_came().metres(u, v)) << u << ' ' << v;
}

// A corner tells of what is 48 px around it at the farthest: the board's upper left corner is 28 and 35 px away from
// (98, 75), 45 in all; from (109, 79) it is 55 px.
TEST_F(CarriedDepthTest, ACornerTellsOfWhatIsNear) {
  corner(98, 75, 10);
  EXPECT_EQ(carried().metres(106, 44), 1.0f);
  EXPECT_EQ(carried().metres(71, 41), 1.0f);
  matches_.begin({});
  corner(109, 79, 10);
  EXPECT_EQ(carried().metres(106, 44), 1.0f);
  EXPECT_EQ(carried().metres(62, 41), 1.0f) << "as it came: not taken away";
}

// The wall's corners are nearer to the border of the board than its own.
TEST_F(CarriedDepthTest, TheNearestSurfaceHidesTheOthers) {
  corner(90, 60, 10);
  for (const float y : {30.0f, 60.0f, 90.0f})
    for (const float x : {112.0f, 114.0f}) corner(x, y, 0);
  EXPECT_EQ(carried().metres(108, 60), 1.0f);
}

// Six are asked, the nearest: not the eight before them in the list, which are farther away and say that the board
// stood.
TEST_F(CarriedDepthTest, TheNearestCornersAreAsked) {
  for (const float x : {62.0f, 64.0f, 66.0f, 68.0f})
    for (const float y : {42.0f, 78.0f}) corner(x, y, 0);
  board_corners();
  EXPECT_EQ(carried().metres(106, 60), 1.0f);
  matches_.begin({});
  for (const float x : {62.0f, 64.0f, 66.0f, 68.0f})
    for (const float y : {42.0f, 78.0f}) corner(x, y, 0);
  corner(105, 60, 10);
  EXPECT_EQ(carried().metres(106, 60), 1.0f);
}

// A host's features with a place in the last frame count where the matcher has no corners of its own.
TEST_F(CarriedDepthTest, TheHostsFeaturesCountWhereThereAreNoCorners) {
  board_corners();
  wall_corners();
  matches_.host_count = matches_.size();
  EXPECT_EQ(carried().metres(105, 60), 1.0f);
  corner(20, 20, 0);
  EXPECT_EQ(carried().metres(105, 60), 3.0f) << "one corner, far away";
}

// A hole of 20 px, filled from the last frame: 10 px of it get what was measured beside it; to the others no corner
// carried anything, but it is not what came late.
TEST_F(CarriedDepthTest, AFilledHoleStaysFilled) {
  board_corners();
  wall_corners();
  for (int u = 75; u < 95; ++u) depth_.row<std::uint16_t>(60)[u] = 0;
  ImageBuffer filled;
  filled.assign(depth_.view());
  for (int u = 75; u < 95; ++u) filled.row<std::uint16_t>(60)[u] = 1020;
  const DepthView depth = carried(DepthView::millimetres(filled.view()));
  EXPECT_EQ(depth.metres(84, 60), 1.0f) << "measured at 74";
  EXPECT_EQ(depth.metres(85, 60), 1.02f);
  EXPECT_EQ(depth.metres(94, 60), 1.02f);
}

// A depth image of half the size: 5 of its pixels.
TEST_F(CarriedDepthTest, OfASmallerDepthImageToo) {
  paint(2);
  board_corners();
  wall_corners();
  const DepthView depth = carried();
  EXPECT_EQ(depth.image.width, kWidth / 2);
  EXPECT_EQ(depth.metres(34, 30), 3.0f);
  EXPECT_EQ(depth.metres(35, 30), 1.0f);
  EXPECT_EQ(depth.metres(54, 30), 1.0f);
  EXPECT_EQ(depth.metres(55, 30), 3.0f);
}

// A corner that came from outside the image has no depth; holes and the border are nothing to carry.
TEST_F(CarriedDepthTest, WhatComesFromOutsideIsNotKnown) {
  corner(5, 60, 10);
  const DepthView depth = carried();
  EXPECT_EQ(depth.metres(3, 60), 3.0f);
  depth_.row<std::uint16_t>(60)[80] = 0;
  matches_.begin({});
  corner(90, 60, 10);
  EXPECT_EQ(carried().metres(105, 60), 3.0f) << "its own depth is a hole";
}

}  // namespace
}  // namespace stillpoint::carried_depth_test
