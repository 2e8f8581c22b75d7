// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/prior/foreground_prior.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint {
namespace {

static_assert(is_prior<ForegroundPrior>::value);

/// A person at 1.5 m, 30 px wide, before a wall at 3 m; the box is twice as wide.
class ForegroundPriorTest : public testing::Test {
 protected:
  ForegroundPriorTest() {
    depth_.setTo(3.0f);
    depth_(cv::Rect(65, 20, 30, 80)).setTo(1.5f);
    prior_.detections = {{{50, 20, 60, 80}, Mobility::dynamic, 1.0f}};
  }

  Detection only(const cv::Mat& depth) {
    Regions regions;
    prior_.regions(FrameView(gray_, DepthView::tum(depth), 0.0), regions);
    EXPECT_EQ(regions.detections.size(), 1u);
    return regions.detections.at(0);
  }

  cv::Mat gray_ = cv::Mat(120, 160, CV_8UC1, cv::Scalar(0)), depth_ = cv::Mat(120, 160, CV_32FC1);
  ForegroundPrior prior_;
};

TEST_F(ForegroundPriorTest, TheMiddleOfABoxIsTheThing) {
  const Detection person = only(depth_);
  EXPECT_NEAR(person.nearest_m, 1.4, 1e-6);
  EXPECT_NEAR(person.farthest_m, 1.6, 1e-6);
  EXPECT_TRUE(person.holds({80, 60}, 1.5));
  EXPECT_FALSE(person.holds({55, 60}, 3.0)) << "the wall past a shoulder";
  EXPECT_FALSE(person.holds({80, 60}, 0.9)) << "what stands before the person";
  EXPECT_FALSE(person.holds({130, 60}, 1.5)) << "outside the box";
  EXPECT_TRUE(person.holds({80, 60}, 0.0)) << "without a depth nothing speaks against it";
}

// From 1.3 m at the head to 1.7 m at the feet: 0.005 m a row, half way down 1.5 m. The wall at 3 m shows between the
// legs, in the lowest fifth, and is not asked.
TEST_F(ForegroundPriorTest, APersonWhoIsLookedDownOnLeans) {
  for (int v = 20; v < 100; ++v) depth_(cv::Rect(65, v, 30, 1)).setTo(1.3f + 0.005f * (static_cast<float>(v) - 20.0f));
  depth_(cv::Rect(68, 84, 24, 16)).setTo(3.0f);
  const Detection person = only(depth_);
  EXPECT_NEAR(person.depth_slope_m, 0.4, 0.01);
  EXPECT_NEAR(person.nearest_m, 1.4, 0.01);
  EXPECT_NEAR(person.farthest_m, 1.6, 0.01);
  EXPECT_TRUE(person.holds({80, 22}, 1.31));
  EXPECT_FALSE(person.holds({80, 22}, 1.69)) << "as deep as the feet, at the height of the head";
  EXPECT_TRUE(person.holds({66, 98}, 1.69));
  EXPECT_FALSE(person.holds({66, 98}, 1.31));
}

TEST_F(ForegroundPriorTest, ADepthImageOfAnotherSizeHasTheSameFieldOfView) {
  cv::Mat half(60, 80, CV_32FC1, cv::Scalar(3.0f));
  half(cv::Rect(33, 10, 14, 40)).setTo(1.5f);
  EXPECT_NEAR(only(half).farthest_m, 1.6, 1e-6);
}

TEST_F(ForegroundPriorTest, WithoutEnoughDepthTheWholeBoxIsTheThing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(only(cv::Mat()).farthest_m, kInfinity);
  depth_.setTo(0.0f);
  EXPECT_EQ(only(depth_).farthest_m, kInfinity);
  depth_(cv::Rect(75, 20, 10, 4)).setTo(1.5f);  // a twentieth of the box's height
  EXPECT_EQ(only(depth_).farthest_m, kInfinity);
}

TEST_F(ForegroundPriorTest, ABoxOutsideTheImageHasNoDepth) {
  prior_.detections[0].box = {-500, -500, 60, 80};
  EXPECT_EQ(only(depth_).nearest_m, 0.0);
}

}  // namespace
}  // namespace stillpoint
