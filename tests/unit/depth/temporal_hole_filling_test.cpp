// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/temporal_hole_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/depth/depth_noise.hpp"

namespace stillpoint::temporal_hole_filling_test {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr double kFocal_px = 100.0, kFactor = 1000.0;

Camera camera() { return Camera(kFocal_px, kFocal_px, 31.5, 23.5, kWidth, kHeight); }

/// An image with a depth image beside it, in millimetres or float metres.
struct Images {
  ImageBuffer gray, depth;
  double timestamp_s = 0.0;

  /// A gray pattern that is moved to the right, a wall everywhere.
  Images(double time_s, double depth_m, int right_px = 0, PixelFormat format = PixelFormat::depth16)
      : timestamp_s(time_s) {
    gray.resize(kWidth, kHeight, PixelFormat::gray8);
    depth.resize(kWidth, kHeight, format);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        gray.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(100 + 40 * ((u - right_px + kWidth) / 8 % 2));
        set(u, v, depth_m);
      }
  }

  void set(int u, int v, double depth_m) {
    if (depth.view().format == PixelFormat::depth16)
      depth.row<std::uint16_t>(v)[u] = static_cast<std::uint16_t>(std::lround(depth_m * kFactor));
    else
      depth.row<float>(v)[u] = static_cast<float>(depth_m);
  }
  void brighten(int by) {
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        gray.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(gray.row<std::uint8_t>(v)[u] + by);
  }
  /// @param hole_m  what stands for no depth
  void dig(int left, int right, double hole_m = 0.0) {
    for (int v = 10; v < 38; ++v)
      for (int u = left; u < right; ++u) set(u, v, hole_m);
  }
  FrameView view() const { return FrameView(gray.view(), DepthView(depth.view(), kFactor), timestamp_s); }
};

class TemporalHoleFillingTest : public testing::Test {
 protected:
  /// The depth of a pixel after the holes of `current` are filled, metres.
  float filled_m(const FrameView& reference, const FrameView& current, int u = 30, int v = 20,
                 const Pose& motion = Pose::Identity()) {
    filled_ = filling_.fill(reference, current, motion, camera(), KinectNoise());
    return filled_.metres(u, v);
  }
  float filled_m(const Images& reference, const Images& current, int u = 30, int v = 20,
                 const Pose& motion = Pose::Identity()) {
    return filled_m(reference.view(), current.view(), u, v, motion);
  }
  static Pose step(double x_m, double z_m) { return make_pose(Matrix3d::Identity(), {x_m, 0.0, z_m}); }

  TemporalHoleFilling filling_;
  DepthView filled_;
};

TEST_F(TemporalHoleFillingTest, AHoleTakesTheDepthOfTheLastFrameAndWhatIsMeasuredStays) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.01);
  now.dig(20, 40);
  EXPECT_EQ(filled_m(before, now), 2.0f);
  EXPECT_EQ(filled_.metres(45, 20), 2.01f) << "measured";
  EXPECT_NE(filled_.image.data, now.depth.view().data);
  EXPECT_EQ(now.view().depth.metres(30, 20), 0.0f) << "the host's image is not written to";
}

TEST_F(TemporalHoleFillingTest, FloatDepthWithoutAValueIsAHoleToo) {
  const Images before(0.0, 2.0, 0, PixelFormat::depth32f);
  for (const float hole_m : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Images now(0.033, 2.0, 0, PixelFormat::depth32f);
    now.dig(20, 40, static_cast<double>(hole_m));
    EXPECT_EQ(filled_m(before, now), 2.0f) << hole_m;
  }
}

// The camera goes 0.1 m ahead: the wall at 2 m is 1.9 m away. The pixel 3 to the left of the middle shows what was
// 3 · 1.9 / 2 = 2.85 to the left.
TEST_F(TemporalHoleFillingTest, DepthChangesWithTheMotion) {
  Images before(0.0, 2.0), now(0.033, 1.9);
  for (Images* const images : {&before, &now})
    for (int v = 0; v < kHeight; ++v) std::fill_n(images->gray.row<std::uint8_t>(v), kWidth, std::uint8_t{90});
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 28, 20, step(0.0, -0.1)), 1.9f, 1e-3f);
}

// What is seen goes 0.04 m to the right: at 2 m that is f x / z = 2 px. The wall is steep: 1 cm deeper with each pixel
// to the right, so that what was at pixel 28 in 1.98 m is at pixel 28 + 4 / 1.98 now. So pixel 30 shows 1.98 m, less
// what 0.02 px are.
TEST_F(TemporalHoleFillingTest, DepthMovesAlong) {
  Images before(0.0, 0.0), now(0.033, 2.0, 2);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) before.set(u, v, 1.7 + 0.01 * u);
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 30, 20, step(0.04, 0.0)), 1.98f, 2e-3f);
  EXPECT_NEAR(filled_m(before, now, 30, 20, step(0.05, 0.0)), 1.975f, 1e-3f) << "2.5 px: between two pixels";
}

// The same downwards: at 2 m 2.5 px, to pixel 20 from 17.5, where the wall is 1.8 + 0.01 · 17.5 m away.
TEST_F(TemporalHoleFillingTest, DepthMovesDownwardsAlong) {
  Images before(0.0, 0.0), now(0.033, 2.0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) before.set(u, v, 1.8 + 0.01 * v);
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 30, 20, make_pose(Matrix3d::Identity(), {0.0, 0.05, 0.0})), 1.975f, 1e-3f);
}

TEST_F(TemporalHoleFillingTest, WhereTheImageChangedSomethingElseHasCome) {
  for (const auto& [brighter, expected_m] : {std::pair{18, 2.0f}, std::pair{19, 0.0f}, std::pair{-19, 0.0f}}) {
    const Images before(0.0, 2.0);
    Images now(0.033, 2.0);
    now.dig(20, 40);
    now.brighten(brighter);
    EXPECT_EQ(filled_m(before, now), expected_m) << brighter;
  }
}

/// For how many frames a hole keeps its depth.
int frames_filled(TemporalHoleFilling& filling, double interval_s) {
  Images last(0.0, 2.0);
  for (int frame = 1; frame < 20; ++frame) {
    Images now(frame * interval_s, 2.0);
    now.dig(20, 40);
    const DepthView filled = filling.fill(last.view(), now.view(), Pose::Identity(), camera(), KinectNoise());
    if (!(filled.metres(30, 20) > 0.0f)) return frame - 1;
    now.depth.assign(filled.image);
    std::swap(last, now);
  }
  return 20;
}

TEST_F(TemporalHoleFillingTest, ATenthOfASecondAfterItWasMeasuredADepthIsGone) {
  for (const auto& [rate_hz, frames] : {std::pair{60.0, 6}, {30.0, 3}, {15.0, 1}, {10.0, 1}, {5.0, 0}}) {
    TemporalHoleFilling filling;
    EXPECT_EQ(frames_filled(filling, 1.0 / rate_hz), frames) << rate_hz << " Hz";
  }
}

TEST_F(TemporalHoleFillingTest, WhatIsMeasuredAgainIsNewAgain) {
  Images last(0.0, 2.0);
  for (int frame = 1; frame <= 12; ++frame) {
    Images now(frame / 30.0, 2.0);
    if (frame % 3 != 0) now.dig(20, 40);
    const DepthView filled = filling_.fill(last.view(), now.view(), Pose::Identity(), camera(), KinectNoise());
    EXPECT_EQ(filled.metres(30, 20), 2.0f) << frame;
    now.depth.assign(filled.image);
    std::swap(last, now);
  }
}

// At edges depth comes and goes in every frame: 96 of the 256 pixels of a tile must have lost it.
TEST_F(TemporalHoleFillingTest, AFewPixelsAreNotWorthIt) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.0);
  for (int v = 16; v < 32; ++v)
    for (int u = 20; u < 26; ++u) now.set(u, v, 0.0);
  EXPECT_EQ(filled_m(before, now, 22), 2.0f);
  now.set(20, 16, 2.0);
  EXPECT_EQ(filled_m(before, now, 22), 0.0f);
}

TEST_F(TemporalHoleFillingTest, TheDepthOfAnEdgeIsNotHandedOn) {
  Images before(0.0, 2.0), now(0.033, 2.0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 32; u < kWidth; ++u) before.set(u, v, 3.0);
  now.dig(20, 44);
  EXPECT_EQ(filled_m(before, now, 31), 0.0f);
  EXPECT_EQ(filled_.metres(32, 20), 0.0f);
  EXPECT_EQ(filled_.metres(30, 20), 2.0f);
  EXPECT_EQ(filled_.metres(33, 20), 3.0f);
}

// Posts at 0.5 m before a wall at 3 m; beside each a hole of f B (1 / 0.5 − 1/3) = 100 · 0.042 · 5/3 = 7 px, in all
// rows.
TEST_F(TemporalHoleFillingTest, AShadowOfTheSensorStaysAHole) {
  const Images before(0.0, 3.0);
  for (const double post_m : {0.5, 3.0}) {
    Images now(0.033, 3.0);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        if (u % 16 >= 1) now.set(u, v, u % 16 >= 8 ? post_m : 0.0);
    EXPECT_EQ(filled_m(before, now, 36), post_m < 3.0 ? 0.0f : 3.0f) << "posts at " << post_m << " m";
  }
}

TEST_F(TemporalHoleFillingTest, WhatWasOutsideTheImageOrBehindTheCameraStaysAHole) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.0);
  now.dig(0, kWidth);
  EXPECT_EQ(filled_m(before, now, 2, 20, step(0.2, 0.0)), 0.0f) << "10 px to the right";
  EXPECT_EQ(filled_m(before, now, 30, 20, step(0.0, -2.5)), 0.0f);
  EXPECT_EQ(filled_m(before, now, 30, 20, step(1e9, 0.0)), 0.0f);
}

TEST_F(TemporalHoleFillingTest, WithoutAnImageOfTheSameKindDepthComesBackAsItIs) {
  Images now(0.033, 2.0);
  now.dig(20, 40);
  const auto comes_back = [&](const FrameView& reference) {
    filled_m(reference, now.view());
    return filled_.image.data == now.depth.view().data;
  };
  const Images before(0.0, 2.0);
  FrameView reference = before.view();
  reference.depth = DepthView();
  EXPECT_TRUE(comes_back(reference)) << "no depth before";
  EXPECT_TRUE(comes_back(Images(0.0, 2.0, 0, PixelFormat::depth32f).view())) << "another format";
  ImageBuffer small;
  small.assign(before.depth.view());
  small.resize(kWidth, kHeight - 1, PixelFormat::depth16);
  reference.depth = DepthView(small.view(), kFactor);
  EXPECT_TRUE(comes_back(reference)) << "another size";
  filling_.is_enabled = false;
  EXPECT_TRUE(comes_back(before.view()));
}

// Colour at 30 Hz, depth at 15: every other frame has what the last one measured, and the third in a row nothing.
TEST_F(TemporalHoleFillingTest, AFrameWithoutADepthImageHasNothingButHoles) {
  for (const PixelFormat format : {PixelFormat::depth16, PixelFormat::depth32f}) {
    filling_ = TemporalHoleFilling();
    const Images before(0.0, 2.0, 0, format);
    const Images now(0.05, 2.0);
    FrameView blind = now.view();
    blind.depth = DepthView();
    const DepthView filled = filling_.fill(before.view(), blind, Pose::Identity(), camera(), KinectNoise());
    ASSERT_FALSE(filled.empty());
    EXPECT_EQ(filled.image.format, format);
    EXPECT_EQ(filled.metres(32, 24), 2.0f);
    const Images late(0.12, 2.0);
    FrameView later = late.view();
    later.depth = DepthView();
    EXPECT_TRUE(filling_.fill(before.view(), later, Pose::Identity(), camera(), KinectNoise()).empty()) << "too old";
  }
  const Images first(0.0, 2.0);
  FrameView blind = first.view();
  blind.depth = DepthView();
  EXPECT_TRUE(filling_.fill(blind, blind, Pose::Identity(), camera(), KinectNoise()).empty()) << "never any depth";
}

TEST_F(TemporalHoleFillingTest, ADepthImageOfHalfTheSizeIsFilledToo) {
  Images before(0.0, 2.0), now(0.033, 2.0);
  std::array<ImageBuffer, 2> half;
  for (ImageBuffer& depth : half) {
    depth.resize(kWidth / 2, kHeight / 2, PixelFormat::depth32f);
    for (int v = 0; v < kHeight / 2; ++v) std::fill_n(depth.row<float>(v), kWidth / 2, 2.0f);
  }
  for (int v = 2; v < 14; ++v) std::fill_n(half[1].row<float>(v) + 4, 10, 0.0f);
  FrameView reference = before.view(), current = now.view();
  reference.depth = DepthView(half[0].view());
  current.depth = DepthView(half[1].view());
  EXPECT_EQ(filled_m(reference, current, 10, 10), 2.0f);
  now.brighten(19);
  EXPECT_EQ(filled_m(reference, current, 10, 10), 0.0f);
}

}  // namespace
}  // namespace stillpoint::temporal_hole_filling_test
