// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/moved_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::moved_depth_test {
namespace {

constexpr int kWidth = 160, kHeight = 120;

Camera camera() { return Camera(100.0, 100.0, 79.5, 59.5, kWidth, kHeight); }

Pose shifted(double x_m, double y_m, double z_m) { return make_pose(Matrix3d::Identity(), {x_m, y_m, z_m}); }

class MovedDepthTest : public testing::Test {
 protected:
  /// @param depth_m  of a pixel of the depth image
  template <class DepthOf>
  FrameView frame(DepthOf depth_m, int shrink = 1) {
    gray_.resize(kWidth, kHeight, PixelFormat::gray8);
    depth_.resize(kWidth / shrink, kHeight / shrink, PixelFormat::depth32f);
    for (int v = 0; v < kHeight / shrink; ++v)
      for (int u = 0; u < kWidth / shrink; ++u) depth_.row<float>(v)[u] = depth_m(u, v);
    return FrameView(gray_.view(), DepthView(depth_.view()), 0.0);
  }

  ImageBuffer gray_, depth_;
  MovedDepth moved_;
};

TEST_F(MovedDepthTest, WithoutAMotionItIsTheSame) {
  const DepthView moved =
      moved_(frame([](int u, int v) { return u < 7 ? 0.0f : 1.0f + 0.01f * float(v); }), Pose::Identity(), camera());
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_FLOAT_EQ(moved.metres(u, v), depth_.row<float>(v)[u]) << u << ", " << v;
}

// 100 px · 0.1 m / 2 m = 5 px.
TEST_F(MovedDepthTest, AWallGoesToTheRightByItsParallax) {
  const DepthView moved = moved_(frame([](int, int) { return 2.0f; }), shifted(0.1, 0.0, 0.0), camera());
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(moved.metres(u, v), u < 5 ? 0.0f : 2.0f) << u << ", " << v;
}

// 16-bit depth is read in its unit, and what moves away is farther.
TEST_F(MovedDepthTest, OfSixteenBits) {
  frame([](int, int) { return 0.0f; });
  depth_.resize(kWidth, kHeight, PixelFormat::depth16);
  for (int v = 0; v < kHeight; ++v) std::fill_n(depth_.row<std::uint16_t>(v), kWidth, std::uint16_t{2000});
  const FrameView given(gray_.view(), DepthView::millimetres(depth_.view()), 0.0);
  EXPECT_FLOAT_EQ(moved_(given, shifted(0.0, 0.0, 0.5), camera()).metres(80, 60), 2.5f);
}

// A box at 1 m moves by 10 px, the wall behind it by 5: it hides 5 px more on its right, and uncovers 5 on its left.
TEST_F(MovedDepthTest, TheNearestWinsAndWhatWasHiddenHasNoDepth) {
  const auto depth_m = [](int u, int) { return u >= 60 && u < 100 ? 1.0f : 2.0f; };
  const DepthView moved = moved_(frame(depth_m), shifted(0.1, 0.0, 0.0), camera());
  EXPECT_EQ(moved.metres(64, 60), 2.0f);
  for (int u = 65; u < 70; ++u) EXPECT_EQ(moved.metres(u, 60), 0.0f) << u;
  for (int u = 70; u < 110; ++u) EXPECT_EQ(moved.metres(u, 60), 1.0f) << u;
  EXPECT_EQ(moved.metres(110, 60), 2.0f);
}

// From 2 m to 1.6 m everything is a quarter larger: each fifth column and row is a crack.
TEST_F(MovedDepthTest, CracksAreClosed) {
  const DepthView moved = moved_(frame([](int, int) { return 2.0f; }), shifted(0.0, 0.0, -0.4), camera());
  for (int v = 2; v < kHeight - 2; ++v)
    for (int u = 2; u < kWidth - 2; ++u) ASSERT_FLOAT_EQ(moved.metres(u, v), 1.6f) << u << ", " << v;
}

TEST_F(MovedDepthTest, WhatComesBehindTheCameraIsGone) {
  const DepthView moved = moved_(frame([](int, int) { return 2.0f; }), shifted(0.0, 0.0, -3.0), camera());
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(moved.metres(u, v), 0.0f);
}

// The oracle moves the points of single pixels through the lens itself. Depth images of half the size, too.
TEST_F(MovedDepthTest, ThroughALensItIsOffByLessThanAPixel) {
  const Camera lens(100.0, 100.0, 79.5, 59.5, kWidth, kHeight, AnyDistortion{BrownConrady{-0.3, 0.1, 0.001, -0.001}});
  const Pose motion = make_pose(rotation_from_vector({0.01, -0.03, 0.02}), {0.02, 0.01, -0.03});
  for (const int shrink : {1, 2}) {
    int compared = 0;
    for (int v = 10; v + 4 < kHeight / shrink; v += 9)
      for (int u = 10; u + 10 < kWidth / shrink; u += 9) {
        const FrameView given = frame([&](int x, int y) { return x == u && y == v ? 1.5f : 0.0f; }, shrink);
        const Vector2d pixel((u + 0.5) * shrink - 0.5, (v + 0.5) * shrink - 0.5);
        const Vector3d point = motion * lens.back_project(lens.undistort(pixel), 1.5);
        const Vector2d expected = (lens.distort(lens.project(point)) + Vector2d(0.5, 0.5)) / shrink;
        const DepthView moved = moved_(given, motion, lens);
        for (int y = 0; y < moved.image.height; ++y)
          for (int x = 0; x < moved.image.width; ++x)
            if (moved.metres(x, y) > 0) {
              ++compared;
              EXPECT_NEAR(x + 0.5, expected.x(), 1.0) << u << ", " << v;
              EXPECT_NEAR(y + 0.5, expected.y(), 1.0) << u << ", " << v;
              EXPECT_NEAR(moved.metres(x, y), point.z(), 0.01);
            }
      }
    EXPECT_GT(compared, 30);
  }
}

}  // namespace
}  // namespace stillpoint::moved_depth_test
