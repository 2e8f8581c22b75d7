// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/surrounding_depth.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {
namespace {

/// A hole of 20 x 20 pixels round (50, 40), 1 m to its left and 3 m elsewhere.
class SurroundingDepthTest : public testing::Test {
 protected:
  SurroundingDepthTest() {
    depth_.setTo(3.0f);
    depth_.colRange(0, 40).setTo(1.0f);
    depth_(cv::Rect(40, 30, 20, 20)).setTo(0.0f);
  }

  SurroundingDepth at(const Vector2f& pixel, int reach_px) const {
    return surrounding_depth(FrameView(gray_, DepthView::tum(depth_), 0.0), pixel, reach_px, GuardedDepth(),
                             KinectNoise());
  }

  cv::Mat gray_ = cv::Mat(80, 100, CV_8UC1, cv::Scalar(0)), depth_ = cv::Mat(80, 100, CV_32FC1);
};

TEST_F(SurroundingDepthTest, FindsBothSurfacesBesideAHole) {
  const SurroundingDepth found = at({50, 40}, 20);
  EXPECT_EQ(found.nearest_m, 1.0);
  EXPECT_EQ(found.farthest_m, 3.0);
}

TEST_F(SurroundingDepthTest, WalksOverHolesOfSixteenBitsToo) {
  cv::Mat depth_mm;
  depth_.convertTo(depth_mm, CV_16UC1, 1000.0);
  const FrameView frame(gray_, DepthView(depth_mm, 1000.0), 0.0);
  const SurroundingDepth found = surrounding_depth(frame, {50, 40}, 20, GuardedDepth(), KinectNoise());
  EXPECT_FLOAT_EQ(static_cast<float>(found.nearest_m), 1.0f);
  EXPECT_FLOAT_EQ(static_cast<float>(found.farthest_m), 3.0f);
}

// From x = 56 the right rim, at 60, is near, the left one, at 39, is not.
TEST_F(SurroundingDepthTest, EndsAtItsReach) {
  const SurroundingDepth found = at({56, 40}, 8);
  EXPECT_EQ(found.nearest_m, 3.0);
  EXPECT_EQ(found.farthest_m, 3.0);
  EXPECT_EQ(at({50, 40}, 4).farthest_m, 0.0);
  EXPECT_EQ(at({50, 40}, 4).nearest_m, 0.0) << "nothing found is nothing, not infinity";
}

TEST_F(SurroundingDepthTest, WithoutDepthOrPixelThereIsNothing) {
  EXPECT_EQ(at({std::numeric_limits<float>::quiet_NaN(), 40}, 20).farthest_m, 0.0);
  EXPECT_EQ(at({1e30f, -1e30f}, 20).farthest_m, 0.0);
  EXPECT_EQ(
      surrounding_depth(FrameView(gray_, DepthView(), 0.0), {50, 40}, 20, GuardedDepth(), KinectNoise()).farthest_m,
      0.0);
}

}  // namespace
}  // namespace stillpoint
