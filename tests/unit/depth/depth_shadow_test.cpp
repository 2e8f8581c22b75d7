// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/depth/depth_shadow.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {
namespace {

/// Something at 1 m, from column 320 on, before a wall at 2 m: of the wall a strip beside it has no depth. With f = 500
/// px and a baseline of 80 mm it is 500 · 0.08 · (1 / 1 − 1 / 2) = 20 px wide, in the columns 300 to 319.
class DepthShadowTest : public ::testing::Test {
 protected:
  DepthShadowTest() {
    depth_.colRange(320, 640).setTo(1.0);
    depth_.colRange(300, 320).setTo(0.0);
  }

  DepthShadow shadow() const { return {FrameView(gray_, DepthView::tum(depth_), 0.0), camera_}; }

  Camera camera_{500, 500, 319.5, 239.5, 640, 480};
  cv::Mat gray_{480, 640, CV_8UC1, cv::Scalar(90)}, depth_{480, 640, CV_32FC1, cv::Scalar(2.0)};
};

TEST_F(DepthShadowTest, TheBaselineIsMeasured) {
  EXPECT_NEAR(shadow().baseline_on_left_m(), 0.08, 1e-9);
  EXPECT_EQ(shadow().baseline_on_right_m(), 0.0) << "no jump to that side";
  cv::flip(depth_, depth_, 1);
  EXPECT_NEAR(shadow().baseline_on_right_m(), 0.08, 1e-9);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0);
}

TEST_F(DepthShadowTest, AShadowLiesOnTheFartherSurface) {
  EXPECT_EQ(shadow().farther_m({310, 100}), 2.0);
  EXPECT_EQ(shadow().farther_m({300, 479}), 2.0);
  EXPECT_EQ(shadow().farther_m({317, 0}), 2.0) << "3 px from the nearer surface";
  EXPECT_EQ(shadow().farther_m({318, 0}), 0.0) << "2 px: its edge";
  EXPECT_EQ(shadow().farther_m({299, 100}), 0.0) << "has a depth";
  EXPECT_EQ(shadow().farther_m({320, 100}), 0.0) << "has a depth";
}

TEST_F(DepthShadowTest, SixteenBitsAndOtherSizes) {
  cv::Mat raw;
  depth_.convertTo(raw, CV_16UC1, 5000.0);
  depth_ = raw;
  EXPECT_NEAR(shadow().baseline_on_left_m(), 0.08, 1e-9);
  EXPECT_EQ(shadow().farther_m({310, 100}), 2.0);
  cv::resize(raw, depth_, {320, 240}, 0, 0, cv::INTER_NEAREST);
  EXPECT_NEAR(shadow().baseline_on_left_m(), 0.08, 1e-9) << "10 px at a focal length of 250 px";
  EXPECT_EQ(shadow().farther_m({310, 100}), 2.0);
  EXPECT_EQ(shadow().farther_m({319, 100}), 0.0);
}

// Hair and sleeves leave holes, too: beside the rim of the nearer surface, from where a shadow would have ended.
TEST_F(DepthShadowTest, WhatIsLostBeforeTheShadowIsNot) {
  depth_(cv::Rect(320, 0, 8, 160)).setTo(0.0);  // 28 px: 1.25 · 20 + 3
  EXPECT_EQ(shadow().farther_m({320, 100}), 2.0) << "the 21st pixel: whole pixels";
  EXPECT_EQ(shadow().farther_m({321, 100}), 0.0);
  EXPECT_EQ(shadow().farther_m({310, 100}), 2.0);
  depth_(cv::Rect(320, 0, 9, 160)).setTo(0.0);
  EXPECT_EQ(shadow().farther_m({310, 100}), 0.0) << "29 px are another kind of hole";
  EXPECT_EQ(shadow().farther_m({310, 300}), 2.0);
}

TEST_F(DepthShadowTest, HolesOfAnyWidthAreNoShadows) {
  Random random(1);
  for (int v = 0; v < 480; ++v) depth_.row(v).colRange(320, 320 + static_cast<int>(random.index(40))).setTo(0.0);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0);
  EXPECT_EQ(shadow().farther_m({310, 100}), 0.0);
}

// 70 to 150 px: baselines of 0.28 to 0.6 m, all in the bin of what is too wide to be measured.
TEST_F(DepthShadowTest, WideHolesOfAnyWidthAreNoShadowsEither) {
  Random random(1);
  for (int v = 0; v < 480; ++v) depth_.row(v).colRange(320, 370 + static_cast<int>(random.index(80))).setTo(0.0);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0);
  EXPECT_EQ(shadow().farther_m({310, 100}), 0.0);
}

TEST_F(DepthShadowTest, MostJumpsMustHaveOne) {
  depth_(cv::Rect(300, 0, 20, 230)).setTo(2.0);
  EXPECT_NEAR(shadow().baseline_on_left_m(), 0.08, 1e-9) << "29 of 60 rows have none";
  depth_(cv::Rect(300, 0, 20, 250)).setTo(2.0);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0) << "31";
}

TEST_F(DepthShadowTest, LittleOrNothingToSee) {
  EXPECT_EQ(shadow().farther_m({-1, 100}), 0.0);
  EXPECT_EQ(shadow().farther_m({310, 480}), 0.0);
  EXPECT_EQ(shadow().farther_m({std::numeric_limits<float>::quiet_NaN(), 100}), 0.0);
  depth_.colRange(300, 320).setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(shadow().farther_m({310, 100}), 2.0) << "a hole as well";
  depth_.rowRange(0, 330).setTo(2.0);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0) << "19 jumps: in the rows 332, 340, …, 476";
  depth_.setTo(0.0);
  EXPECT_EQ(shadow().farther_m({310, 100}), 0.0);
  depth_ = cv::Mat();
  EXPECT_EQ(shadow().farther_m({310, 100}), 0.0);
}

// A step of 5 cm at 1 m is no jump: a hole there may lie on either side of it.
TEST_F(DepthShadowTest, AStepIsNoJump) {
  depth_.colRange(0, 300).setTo(1.05);
  EXPECT_EQ(shadow().baseline_on_left_m(), 0.0);
}

}  // namespace
}  // namespace stillpoint
