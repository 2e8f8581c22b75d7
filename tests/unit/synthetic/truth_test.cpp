// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/truth.hpp"

#include <gtest/gtest.h>

namespace stillpoint::synthetic {
namespace {

/// A mover that has slid along x and turned at constant speeds for a long time.
Mover steady(double metres_per_s, double radians_per_s) {
  Mover mover;
  mover.path = Path(
      {{-10.0, {-10 * metres_per_s, 0, 0}, -10 * radians_per_s}, {10.0, {10 * metres_per_s, 0, 0}, 10 * radians_per_s}},
      Blend::linear);
  mover.parts.push_back({});
  return mover;
}

bool moves(const Mover& mover, const Vector3d& point, const MotionRule& rule = {}) {
  return PartMotion(mover, mover.parts[0], 0.0, -1 / 30.0, -5 / 30.0, rule).moves(point);
}

TEST(PartMotion, SlidingCountsFromSixCentimetresASecond) {
  EXPECT_TRUE(moves(steady(0.12, 0), {0, 0, 0}));   // 4 mm since the last frame
  EXPECT_TRUE(moves(steady(0.08, 0), {0, 0, 0}));   // 2.7 mm, but 13.3 mm in 5 frames
  EXPECT_FALSE(moves(steady(0.05, 0), {0, 0, 0}));  // 1.7 mm and 8.3 mm
  EXPECT_FALSE(moves(steady(0, 0), {0, 0, 0}));
}

TEST(PartMotion, TurningCountsWhereItIsFarFromTheAxis) {
  const Mover turning = steady(0, 0.1);        // in 5 frames 0.0167 rad
  EXPECT_TRUE(moves(turning, {1.0, 0, 0}));    // 16.7 mm
  EXPECT_FALSE(moves(turning, {0.5, 0, 0}));   // 8.3 mm
  EXPECT_FALSE(moves(turning, {0, -5.0, 0}));  // on the axis
}

TEST(PartMotion, APointAtRestCountsWhenTheOriginMoves) {
  // The origin slides 13.3 mm along x in 5 frames and turns by −0.0133 rad: a point 1 m ahead stays where it is.
  EXPECT_TRUE(moves(steady(0.08, -0.08), {0, 0, 1.0}));
  // Without the slide's excess over 10 mm neither counts: 0.05 m/s, 8.3 mm.
  EXPECT_FALSE(moves(steady(0.05, -0.05), {0, 0, 1.0}));
}

TEST(PartMotion, OnlyTheWavingPartOfASittingMoverMoves) {
  Mover mover = steady(0, 0);
  mover.parts.push_back({});
  Joint& elbow = mover.parts[1].joint;
  elbow.axis = Vector3d::UnitZ();
  elbow.wave_rad = 0.5;
  elbow.wave_start_s = -5;
  elbow.wave_end_s = 5;  // at time 0 the swing is at its fastest: 0.5 rad · 2π / s, 0.105 rad a frame
  const MotionRule rule;
  EXPECT_FALSE(PartMotion(mover, mover.parts[0], 0, -1 / 30.0, -5 / 30.0, rule).moves({0.3, 0, 0}));
  EXPECT_TRUE(PartMotion(mover, mover.parts[1], 0, -1 / 30.0, -5 / 30.0, rule).moves({0.3, 0, 0}));
  EXPECT_FALSE(PartMotion(mover, mover.parts[1], 0, -1 / 30.0, -5 / 30.0, rule).moves({0.005, 0, 0}));
}

TEST(IgnoreSilhouettes, MarksTwoPixelsOnBothSides) {
  ImageBuffer ids, labels;
  ids.resize(24, 12, PixelFormat::gray8);
  labels.resize(24, 12, PixelFormat::gray8);
  for (int v = 0; v < 12; ++v)
    for (int u = 0; u < 24; ++u) {
      ids.row<std::uint8_t>(v)[u] = u < 8 ? 0 : u < 16 ? 1 : 2;  // static, mover 0, mover 1
      labels.row<std::uint8_t>(v)[u] = u < 8 ? 0 : 255;
    }
  std::vector<std::uint8_t> scratch;
  ignore_silhouettes(ids.view(), scratch, labels);
  for (int v = 0; v < 12; ++v)
    for (int u = 0; u < 24; ++u) {
      const bool rim = (u >= 6 && u < 10) || (u >= 14 && u < 18);
      EXPECT_EQ(labels.row<std::uint8_t>(v)[u], rim ? 64 : u < 8 ? 0 : 255) << u << ' ' << v;
    }
}

struct Boxes : testing::Test {
  ImageBuffer ids;
  std::vector<Mover> movers = std::vector<Mover>(2);
  std::vector<TruthBox> boxes;

  Boxes() {
    ids.resize(60, 50, PixelFormat::gray8);
    std::fill_n(ids.row<std::uint8_t>(0), 60 * 50, std::uint8_t{0});
    movers[0].class_name = "person";
  }
  void fill(int x, int y, int width, int height, std::uint8_t id) {
    for (int v = y; v < y + height; ++v) std::fill_n(ids.row<std::uint8_t>(v) + x, width, id);
  }
};

TEST_F(Boxes, AreTheVisibleExtentPaddedByFourPixels) {
  fill(10, 12, 20, 20, 1);
  find_boxes(ids.view(), movers, boxes);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].class_name, "person");
  EXPECT_EQ(boxes[0].mover, 0u);
  EXPECT_EQ(boxes[0].x, 6);
  EXPECT_EQ(boxes[0].y, 8);
  EXPECT_EQ(boxes[0].width, 28);
  EXPECT_EQ(boxes[0].height, 28);
  EXPECT_EQ(boxes[0].visible_pixels, 400);
}

TEST_F(Boxes, EndAtTheImage) {
  fill(40, 0, 20, 20, 2);
  find_boxes(ids.view(), movers, boxes);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].class_name, kUnknownClass);
  EXPECT_EQ(boxes[0].x, 36);
  EXPECT_EQ(boxes[0].y, 0);
  EXPECT_EQ(boxes[0].width, 24);
  EXPECT_EQ(boxes[0].height, 24);
}

TEST_F(Boxes, AreNotGivenForFewPixelsOrWithoutAClass) {
  fill(10, 12, 20, 20, 1);
  ids.row<std::uint8_t>(12)[10] = 0;  // 399 are left
  fill(35, 12, 20, 25, 2);
  movers[1].class_name.clear();
  find_boxes(ids.view(), movers, boxes);
  EXPECT_TRUE(boxes.empty());
}

}  // namespace
}  // namespace stillpoint::synthetic
