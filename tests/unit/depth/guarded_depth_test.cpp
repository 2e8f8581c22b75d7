// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/depth/guarded_depth.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint::guarded_depth_test {
namespace {

static_assert(is_depth_lookup<GuardedDepth>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// 6 × 5 pixels at 2 m, to be damaged.
struct Wall {
  std::array<float, 30> metres;
  Wall() { metres.fill(2.0f); }
  float& at(int u, int v) { return metres[static_cast<std::size_t>(6 * v + u)]; }
  DepthView view() const { return ImageView(metres.data(), 6, 5, 6 * sizeof(float), PixelFormat::depth32f); }
};

/// An edge is more than 0.02 m + 6.6 σ, with a Kinect's 0.0012 + 0.0019 (z − 0.4)²: 0.060 m at 2 m.
GuardedDepth guarded() {
  GuardedDepth lookup;
  lookup.fewest_neighbours = 6;
  lookup.jump_m = 0.02;
  lookup.jump_sigmas = 6.6;
  return lookup;
}

TEST(GuardedDepth, IsTheDepthOfTheRoundedPixelOnASurface) {
  Wall wall;
  wall.at(3, 2) = 2.03f;
  const GuardedDepth lookup = guarded();
  EXPECT_EQ(lookup.at(wall.view(), {3, 2}), static_cast<double>(2.03f)) << "nothing is averaged";
  EXPECT_EQ(lookup.at(wall.view(), {3.4f, 1.6f}), static_cast<double>(2.03f));
  EXPECT_EQ(lookup.at(wall.view(), {2.4f, 2.0f}), 2.0);
}

// 5 × 5 pixels from a width of 960 on: two pixels away is an edge there, and 16 of 25 holes are too many.
TEST(GuardedDepth, TheNeighbourhoodGrowsWithTheImage) {
  const GuardedDepth lookup = guarded();
  for (const int width : {959, 960}) {
    std::vector<float> metres(static_cast<std::size_t>(width) * 7, 2.0f);
    const DepthView wall(
        ImageView(metres.data(), width, 7, static_cast<std::size_t>(width) * sizeof(float), PixelFormat::depth32f));
    const bool is_wide = width == 960;
    EXPECT_EQ(lookup.at(wall, {20, 3}), 2.0);
    EXPECT_EQ(lookup.at(wall, {1, 3}), is_wide ? 0.0 : 2.0) << "the border";
    metres[static_cast<std::size_t>(3 * width + 22)] = 3.0f;
    EXPECT_EQ(lookup.at(wall, {20, 3}), is_wide ? 0.0 : 2.0);
    for (const int v : {1, 5})
      for (int u = 48; u <= 52; ++u) metres[static_cast<std::size_t>(v * width + u)] = 0.0f;
    EXPECT_EQ(lookup.at(wall, {50, 3}), is_wide ? 0.0 : 2.0) << "15 of 25";
    metres[static_cast<std::size_t>(width + 48)] = metres[static_cast<std::size_t>(width + 49)] = 2.0f;
    EXPECT_EQ(lookup.at(wall, {50, 3}), 2.0) << "17 of 25, as 6 of 9";
  }
}

// Of a camera on its side: 960 rows count as 960 columns do.
TEST(GuardedDepth, TheNeighbourhoodGrowsWithTheLongerSide) {
  std::vector<float> metres(std::size_t{7} * 960, 2.0f);
  const DepthView wall(ImageView(metres.data(), 7, 960, 7 * sizeof(float), PixelFormat::depth32f));
  EXPECT_EQ(guarded().at(wall, {3, 20}), 2.0);
  metres[std::size_t{22} * 7 + 3] = 3.0f;
  EXPECT_EQ(guarded().at(wall, {3, 20}), 0.0) << "an edge two pixels away";
}

TEST(GuardedDepth, ThereIsNoneAtAJump) {
  const GuardedDepth lookup = guarded();
  for (const float neighbour : {1.93f, 2.07f}) {
    Wall wall;
    wall.at(1, 1) = neighbour;
    EXPECT_EQ(lookup.at(wall.view(), {2, 2}), 0.0) << "diagonal";
    EXPECT_EQ(lookup.at(wall.view(), {1, 2}), 0.0);
    EXPECT_EQ(lookup.at(wall.view(), {3, 2}), 2.0) << "two pixels away";
    wall.at(1, 1) = neighbour < 2 ? 1.95f : 2.05f;
    EXPECT_EQ(lookup.at(wall.view(), {2, 2}), 2.0) << "noise";
  }
  // What counts is the spread: 0.04 nearer on one side and 0.04 farther on the other is a jump of 0.08.
  Wall slope;
  slope.at(1, 2) = 1.96f;
  slope.at(3, 2) = 2.04f;
  EXPECT_EQ(lookup.at(slope.view(), {2, 2}), 0.0);
}

// 0.02 + 6.6 σ is 0.032 at 1 m and 0.113 at 3 m.
TEST(GuardedDepth, AJumpIsMeasuredByTheNoiseOfItsDepth) {
  const GuardedDepth lookup = guarded();
  for (const auto& [depth, step, is_edge] :
       {std::tuple{1.0f, 0.025f, false}, {1.0f, 0.04f, true}, {3.0f, 0.10f, false}, {3.0f, 0.12f, true}}) {
    Wall wall;
    wall.metres.fill(depth);
    wall.at(2, 1) = depth + step;
    EXPECT_EQ(lookup.at(wall.view(), {2, 2}) == 0.0, is_edge) << depth << " + " << step;
  }
}

// A stereo pair of f b = 50 px m and 0.25 px has σ = 0.005 z²: at 2 m an edge is more than 0.02 + 6.6 · 0.02 = 0.152 m.
TEST(GuardedDepth, AJumpIsMeasuredByTheNoiseOfTheSensorAtHand) {
  const GuardedDepth lookup = guarded();
  const StereoNoise stereo{500.0, 0.1, 0.25};
  Wall wall;
  wall.at(2, 1) = 2.14f;
  EXPECT_EQ(lookup.at(wall.view(), {2, 2}), 0.0) << "an edge for a Kinect";
  EXPECT_EQ(lookup.at(wall.view(), {2, 2}, stereo), 2.0);
  wall.at(2, 1) = 2.16f;
  EXPECT_EQ(lookup.at(wall.view(), {2, 2}, stereo), 0.0);
}

TEST(GuardedDepth, ThereIsNoneAtAHole) {
  const GuardedDepth lookup = guarded();
  Wall wall;
  wall.at(1, 1) = 0.0f;
  wall.at(2, 1) = kNaN;
  wall.at(3, 1) = -1.0f;
  EXPECT_EQ(lookup.at(wall.view(), {2, 2}), 2.0) << "six of nine are left, and holes are no jump";
  EXPECT_EQ(lookup.at(wall.view(), {2, 1}), 0.0);
  wall.at(1, 2) = 0.0f;
  EXPECT_EQ(lookup.at(wall.view(), {2, 2}), 0.0) << "five of nine";
}

TEST(GuardedDepth, ThereIsNoneAtTheBorderAndOutside) {
  const GuardedDepth lookup = guarded();
  const Wall wall;
  EXPECT_EQ(lookup.at(wall.view(), {1, 1}), 2.0);
  EXPECT_EQ(lookup.at(wall.view(), {4, 3}), 2.0);
  for (const Vector2f& pixel :
       {Vector2f(0, 0), Vector2f(0, 2), Vector2f(5, 2), Vector2f(2, 4), Vector2f(5, 4), Vector2f(-3, 2),
        Vector2f(2, 100), Vector2f(kNaN, 2), Vector2f(2, kNaN), Vector2f(kInfinity, 2), Vector2f(2, -kInfinity),
        Vector2f(1e30f, 2), Vector2f(-1e30f, -1e30f)})
    EXPECT_EQ(lookup.at(wall.view(), pixel), 0.0) << pixel.transpose();
}

// 2³² + 512 is 512 in 32 bits: too far away must not come back inside.
TEST(GuardedDepth, WhatIsTooFarAwayForAnIntegerIsOutside) {
  static const std::array<float, 5 * 1024> wall = [] {
    std::array<float, 5 * 1024> metres{};
    metres.fill(2.0f);
    return metres;
  }();
  const DepthView view(ImageView(wall.data(), 1024, 5, 1024 * sizeof(float), PixelFormat::depth32f));
  const GuardedDepth lookup = guarded();
  EXPECT_EQ(lookup.at(view, {512.0f, 2.0f}), 2.0);
  EXPECT_EQ(lookup.at(view, {4294967808.0f, 2.0f}), 0.0);
}

TEST(GuardedDepth, SmallAndEmptyImagesHaveNone) {
  const GuardedDepth lookup = guarded();
  EXPECT_EQ(lookup.at(DepthView(), {0, 0}), 0.0);
  const std::uint16_t one = 10000;
  EXPECT_EQ(lookup.at(ImageView(&one, 1, 1, sizeof one, PixelFormat::depth16), {0, 0}), 0.0);
}

}  // namespace
}  // namespace stillpoint::guarded_depth_test
