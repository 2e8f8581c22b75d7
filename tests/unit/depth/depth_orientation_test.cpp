// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/depth_orientation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::depth_orientation_test {
namespace {

constexpr int kWidth = 160, kHeight = 120;

/// Three bright boxes at 1 m before a dark wall at 3 m; none lies where another would, were the image turned over.
bool is_box(int u, int v) {
  const auto within = [&](int left, int top, int width, int height) {
    return u >= left && u < left + width && v >= top && v < top + height;
  };
  return within(8, 6, 40, 30) || within(70, 20, 24, 20) || within(100, 62, 16, 50);
}

class DepthOrientationTest : public testing::Test {
 protected:
  DepthOrientationTest() {
    gray_.resize(kWidth, kHeight, PixelFormat::gray8);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) gray_.row<std::uint8_t>(v)[u] = is_box(u, v) ? 200 : 50;
  }

  /// @param shrink  the depth image has this part of the gray one's width and height
  DepthOrientation of(bool mirrored, bool upside_down, int shrink = 1) {
    depth_.resize(kWidth / shrink, kHeight / shrink, PixelFormat::depth32f);
    for (int v = 0; v < kHeight / shrink; ++v)
      for (int u = 0; u < kWidth / shrink; ++u)
        depth_.row<float>(v)[u] =
            is_box(mirrored ? kWidth - 1 - shrink * u : shrink * u, upside_down ? kHeight - 1 - shrink * v : shrink * v)
                ? 1.0f
                : 3.0f;
    return DepthOrientation::of(FrameView(gray_.view(), DepthView(depth_.view()), 0.0));
  }

  ImageBuffer gray_, depth_;
};

TEST_F(DepthOrientationTest, AsItIsItFits) {
  const DepthOrientation orientation = of(false, false);
  ASSERT_TRUE(orientation.tells());
  EXPECT_FALSE(orientation.is_wrong());
  EXPECT_EQ(orientation.as_is, 150.0) << "each jump of the depth is one of the gray values";
}

TEST_F(DepthOrientationTest, TurnedOverItFitsTheOtherWayRound) {
  const DepthOrientation mirrored = of(true, false), upside_down = of(false, true), turned = of(true, true);
  EXPECT_TRUE(mirrored.is_wrong());
  EXPECT_EQ(mirrored.mirrored, 150.0);
  EXPECT_TRUE(upside_down.is_wrong());
  EXPECT_EQ(upside_down.upside_down, 150.0);
  EXPECT_TRUE(turned.is_wrong());
  EXPECT_EQ(turned.turned, 150.0);
}

TEST_F(DepthOrientationTest, OfAnotherSizeToo) {
  EXPECT_FALSE(of(false, false, 2).is_wrong());
  EXPECT_TRUE(of(true, false, 2).is_wrong());
  EXPECT_TRUE(of(false, true, 2).is_wrong());
  EXPECT_TRUE(of(true, true, 2).is_wrong());
}

TEST_F(DepthOrientationTest, WithoutJumpsNobodyKnows) {
  of(false, false);
  for (int v = 0; v < kHeight; ++v) std::fill_n(depth_.row<float>(v), kWidth, 2.0f);
  const DepthOrientation flat = DepthOrientation::of(FrameView(gray_.view(), DepthView(depth_.view()), 0.0));
  EXPECT_EQ(flat.jumps, 0u);
  EXPECT_FALSE(flat.tells());
  EXPECT_FALSE(flat.is_wrong());
  EXPECT_FALSE(DepthOrientation::of(FrameView(gray_.view(), DepthView(), 0.0)).tells());
}

}  // namespace
}  // namespace stillpoint::depth_orientation_test
