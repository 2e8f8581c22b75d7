// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/depth/depth_lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint::depth_lookup_test {
namespace {

static_assert(is_depth_lookup<RoundedDepth>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(DepthView, SixteenBitIsScaledByItsFactor) {
  cv::Mat depth(1, 3, CV_16UC1, cv::Scalar(0));
  depth.at<std::uint16_t>(0, 1) = 7500;
  depth.at<std::uint16_t>(0, 2) = 65535;
  EXPECT_EQ(DepthView::tum(depth).metres(1, 0), 1.5f);     // TUM: 5000 a metre
  EXPECT_EQ(DepthView(depth, 1000.0).metres(1, 0), 7.5f);  // millimetres
  EXPECT_EQ(DepthView::tum(depth).metres(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(DepthView::tum(depth).metres(2, 0), 13.107f);
}

TEST(DepthView, FloatIsMetresAndWhateverIsNoDepthIsZero) {
  cv::Mat depth = (cv::Mat_<float>(1, 6) << 2.25f, 0.0f, -1.0f, kNaN, kInfinity, -kInfinity);
  EXPECT_EQ(DepthView(depth, 1000.0).metres(0, 0), 2.25f) << "the factor is for 16 bit only";
  for (int u = 1; u < 6; ++u) EXPECT_EQ(DepthView::tum(depth).metres(u, 0), 0.0f) << u;
}

TEST(DepthView, ReadsAPartOfAnImage) {
  cv::Mat depth(4, 6, CV_16UC1, cv::Scalar(0));
  depth.at<std::uint16_t>(2, 3) = 5000;
  EXPECT_EQ(DepthView::tum(depth(cv::Rect(2, 1, 3, 3))).metres(1, 1), 1.0f);
}

TEST(DepthScale, KeepsTheFieldOfViewNotThePixelOrigin) {
  const cv::Mat image(480, 640, CV_8UC1), half(240, 320, CV_16UC1), wide(480, 1280, CV_16UC1);
  const DepthScale same(image, image), smaller(image, half), larger(image, wide);
  EXPECT_EQ(same({12.25f, 7.5f}), Vector2f(12.25f, 7.5f));
  // The left edge of the image is at −0.5 in both: (−0.5 + 0.5) / 2 − 0.5 = −0.5, the right one 639.5 becomes 319.5.
  EXPECT_EQ(smaller({-0.5f, 479.5f}), Vector2f(-0.5f, 239.5f));
  EXPECT_EQ(smaller({100.0f, 101.0f}), Vector2f(49.75f, 50.25f));  // 100.5 / 2 − 0.5, 101.5 / 2 − 0.5
  EXPECT_EQ(larger({10.0f, 10.0f}), Vector2f(20.5f, 10.0f));       // 10.5 · 2 − 0.5
}

TEST(RoundedDepth, ReadsTheNearestPixel) {
  const cv::Mat depth = (cv::Mat_<float>(2, 3) << 1, 2, 3, 4, 5, 6);
  const DepthView view = DepthView::tum(depth);
  const RoundedDepth lookup;
  EXPECT_EQ(lookup.at(view, {0.0f, 0.0f}), 1.0);
  EXPECT_EQ(lookup.at(view, {0.49f, 0.0f}), 1.0);
  EXPECT_EQ(lookup.at(view, {0.51f, 0.0f}), 2.0);  // not truncated
  EXPECT_EQ(lookup.at(view, {1.6f, 0.7f}), 6.0);
  EXPECT_EQ(lookup.at(view, {-0.4f, -0.4f}), 1.0);
  EXPECT_EQ(lookup.at(view, {2.4f, 1.4f}), 6.0);
}

TEST(RoundedDepth, IsZeroOutsideAndForWhatIsNoPixel) {
  const cv::Mat depth(2, 3, CV_32FC1, cv::Scalar(1.0));
  const DepthView view = DepthView::tum(depth);
  const RoundedDepth lookup;
  // 2³² and 1e30 are beyond what an int or a long holds: they must not wrap around to column 0.
  for (const float bad :
       {-0.6f, -5.0f, 3.0f, 4294967296.0f, -4294967296.0f, 1e30f, -1e30f, kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(lookup.at(view, {bad, 0.0f}), 0.0) << bad;
    EXPECT_EQ(lookup.at(view, {0.0f, bad}), 0.0) << bad;
    EXPECT_EQ(lookup.at(view, {bad, bad}), 0.0) << bad;
  }
  EXPECT_EQ(lookup.at(DepthView(), {0.0f, 0.0f}), 0.0);
}

// Eq. 4: each observation gets its undistorted pixel, its depth, that depth's noise and its 3D point.
TEST(Lift, FillsTheObservationsOfAFrame) {
  BrownConrady lens;
  lens.k1 = -0.2;
  const Camera camera(5, 5, 5, 4, 10, 8, {lens});
  const cv::Mat gray(8, 10, CV_8UC1, cv::Scalar(0));
  cv::Mat depth(4, 5, CV_16UC1, cv::Scalar(0));  // half the image's resolution
  depth.at<std::uint16_t>(1, 3) = 10000;         // 2 m
  const FrameView frame(gray, DepthView::tum(depth), 0.0);

  FrameFeatures observations;
  observations.resize(4);
  // Pixel (7, 3): depth pixel (3.25, 1.25) → (3, 1). On the plane (0.4, −0.2).
  observations.pixel = {{7, 3}, {1, 1}, {kNaN, 2}, {20, 3}};
  lift(frame, RoundedDepth{}, camera, KinectNoise{}, observations);

  const Vector2d undistorted = camera.undistort({7, 3});
  EXPECT_EQ(observations.undistorted[0], undistorted);
  EXPECT_GT((undistorted - Vector2d(7, 3)).norm(), 0.05) << "the lens must show";
  EXPECT_EQ(observations.depth_m[0], 2.0);
  EXPECT_DOUBLE_EQ(observations.depth_sigma_m[0], 0.0012 + 0.0019 * 1.6 * 1.6);
  EXPECT_LE((observations.point[0] - camera.back_project(undistorted, 2.0)).norm(), 1e-15);
  EXPECT_TRUE(observations.has_depth(0));

  for (const std::size_t none : {1u, 2u, 3u}) {
    EXPECT_FALSE(observations.has_depth(none));
    EXPECT_EQ(observations.depth_m[none], 0.0);
    EXPECT_EQ(observations.depth_sigma_m[none], std::numeric_limits<double>::infinity());
    EXPECT_TRUE(observations.point[none].array().isNaN().all());
  }
  EXPECT_TRUE(observations.undistorted[1].allFinite());
  EXPECT_TRUE(observations.undistorted[2].array().isNaN().all());
}

TEST(Lift, WithoutADepthImageGivesPixelsOnly) {
  const Camera camera(5, 5, 5, 4, 10, 8);
  const cv::Mat gray(8, 10, CV_8UC1, cv::Scalar(0));
  FrameFeatures observations;
  observations.resize(1);
  observations.pixel[0] = {7, 3};
  lift(FrameView(gray, DepthView(), 0.0), RoundedDepth{}, camera, KinectNoise{}, observations);
  EXPECT_EQ(observations.undistorted[0], Vector2d(7, 3));
  EXPECT_FALSE(observations.has_depth(0));
}

TEST(MedianDepth, CountsOnlyWhatHasADepth) {
  Workspace workspace;
  FrameFeatures observations;
  observations.resize(5);
  EXPECT_EQ(median_depth_m(observations, workspace), 0.0) << "no feature has a depth";
  observations.depth_m = {3.0, 0.0, 1.0, 0.0, 2.0};
  EXPECT_EQ(median_depth_m(observations, workspace), 2.0);
  EXPECT_EQ(observations.depth_m[0], 3.0) << "sorted in a copy";
}

}  // namespace
}  // namespace stillpoint::depth_lookup_test
