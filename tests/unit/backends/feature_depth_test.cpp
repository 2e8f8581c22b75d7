// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/feature_depth.hpp"

#include <gtest/gtest.h>
#include <opencv2/core/mat.hpp>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/opencv.hpp"

namespace feature_depth_test {
namespace {

constexpr int kWidth = 640, kHeight = 480;

/// A wall that is 0.001 m farther away with each pixel of the image to the right, seen by a depth image of some size.
/// Its pixel u covers the image from u·s to (u + 1)·s, with s image pixels for each, so its centre is at
/// (u + ½)·s - ½.
cv::Mat wall(int width, int height) {
  cv::Mat depth(height, width, CV_32FC1);
  const double image_px = static_cast<double>(kWidth) / width;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      depth.at<float>(v, u) = static_cast<float>(1.0 + 0.001 * ((u + 0.5) * image_px - 0.5));
  return depth;
}

double depth_at(const cv::Mat& depth, const cv::Point2f& pixel) {
  const cv::Mat gray(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  return examples::depth_at(stillpoint::FrameView(gray, depth, 0.0), pixel, {});
}

TEST(FeatureDepth, IsTheSameByDepthImagesOfAnySize) {
  for (const cv::Point2f& pixel : {cv::Point2f(100, 50), cv::Point2f(600, 400), cv::Point2f(321.4f, 240.2f)})
    for (const double scale : {0.5, 1.0, 1.5}) {
      const cv::Mat depth = wall(static_cast<int>(scale * kWidth), static_cast<int>(scale * kHeight));
      const double rounding_m = 0.001 * 0.5 / scale;  // to whole pixels of the depth image
      EXPECT_NEAR(depth_at(depth, pixel), 1.0 + 0.001 * pixel.x, rounding_m + 1e-6) << scale << ' ' << pixel.x;
    }
}

TEST(FeatureDepth, IsNothingAtRimsEdgesAndFarAway) {
  cv::Mat depth = wall(kWidth / 2, kHeight / 2);
  EXPECT_EQ(depth_at(depth, {0, 100}), 0.0);
  EXPECT_EQ(depth_at(depth, {639, 100}), 0.0);
  EXPECT_EQ(depth_at({}, {100, 100}), 0.0);
  depth.col(51).setTo(0.0f);
  EXPECT_EQ(depth_at(depth, {101, 100}), 0.0) << "beside a pixel without depth";
  depth.col(51).setTo(2.0f);
  EXPECT_EQ(depth_at(depth, {101, 100}), 0.0) << "beside another surface";
  depth.setTo(7.0f);
  EXPECT_EQ(depth_at(depth, {101, 100}), 0.0);
}

}  // namespace
}  // namespace feature_depth_test
