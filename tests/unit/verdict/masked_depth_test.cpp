// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/verdict/masked_depth.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::masked_depth_test {
namespace {

template <class Value>
cv::Mat ramp(int rows, int columns, int type) {
  cv::Mat depth(rows, columns, type);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) depth.at<Value>(v, u) = static_cast<Value>(1 + v * columns + u);
  return depth;
}

/// Zero where the mask of the same size is 0, the depth elsewhere; the caller's bytes as they were.
template <class Value>
void expect_zeroed(int type) {
  const cv::Mat depth = ramp<Value>(6, 8, type), before = depth.clone();
  cv::Mat mask(6, 8, CV_8UC1, cv::Scalar(255));
  mask.at<std::uint8_t>(2, 3) = mask.at<std::uint8_t>(5, 7) = 0;
  ImageBuffer masked;
  masked_depth(DepthView::tum(depth), mask, masked);
  ASSERT_EQ(as_mat(masked.view()).type(), type);
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 8; ++u) {
      const bool is_dropped = (v == 2 && u == 3) || (v == 5 && u == 7);
      EXPECT_EQ(as_mat(masked.view()).at<Value>(v, u), is_dropped ? Value{0} : before.at<Value>(v, u))
          << u << ", " << v;
    }
  EXPECT_NE(masked.view().data, depth.data);
  EXPECT_EQ(std::memcmp(depth.data, before.data, depth.total() * depth.elemSize()), 0);
}

TEST(MaskedDepth, IsZeroWhereTheMaskIsAndTheCallersImageIsUntouched) {
  expect_zeroed<std::uint16_t>(CV_16UC1);
  expect_zeroed<float>(CV_32FC1);
}

TEST(MaskedDepth, AMaskOfFloatsIsAnError) {
  ImageBuffer masked;
  EXPECT_EQ(error_of([&] {
              masked_depth(DepthView::tum(ramp<std::uint16_t>(6, 8, CV_16UC1)), cv::Mat(6, 8, CV_32FC1, 1.0), masked);
            }),
            "masked_depth: the mask is no gray8 image, expected gray8, one byte per pixel");
}

TEST(MaskedDepth, ReadsRowsWithGaps) {
  const cv::Mat wide = ramp<std::uint16_t>(6, 10, CV_16UC1);
  const cv::Mat depth = wide(cv::Rect(1, 0, 8, 6));
  ImageBuffer masked;
  masked_depth(DepthView::tum(depth), cv::Mat(6, 8, CV_8UC1, cv::Scalar(255)), masked);
  EXPECT_EQ(cv::countNonZero(as_mat(masked.view()) != depth), 0);
}

// Pixel u of a depth image of half the size covers 2u and 2u + 1: its centre is at 2u + 1/2, which rounds to 2u + 1.
TEST(MaskedDepth, FollowsTheMaskAtHalfItsResolution) {
  const cv::Mat depth = ramp<std::uint16_t>(3, 4, CV_16UC1);
  cv::Mat mask(6, 8, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(4, 2, 2, 2)).setTo(0);  // all that depth pixel (2, 1) covers
  ImageBuffer masked;
  masked_depth(DepthView::tum(depth), mask, masked);
  ASSERT_EQ(masked.view().width, 4);
  cv::Mat expected = depth.clone();
  expected.at<std::uint16_t>(1, 2) = 0;
  EXPECT_EQ(cv::countNonZero(as_mat(masked.view()) != expected), 0);
}

// Pixel u of a depth image of twice the size lies at u/2 − 1/4: 2 and 3 of them belong to pixel 1 of the mask.
TEST(MaskedDepth, FollowsTheMaskAtTwiceItsResolution) {
  const cv::Mat depth = ramp<float>(4, 8, CV_32FC1);
  cv::Mat mask(2, 4, CV_8UC1, cv::Scalar(255));
  mask.at<std::uint8_t>(1, 1) = 0;
  ImageBuffer masked;
  masked_depth(DepthView::tum(depth), mask, masked);
  cv::Mat expected = depth.clone();
  expected(cv::Rect(2, 2, 2, 2)).setTo(0);
  EXPECT_EQ(cv::countNonZero(as_mat(masked.view()) != expected), 0);
}

TEST(MaskedDepth, OfNothingIsNothingAndWithoutAMaskAllIsKept) {
  ImageBuffer masked;
  masked_depth(DepthView(), cv::Mat(6, 8, CV_8UC1, cv::Scalar(0)), masked);
  EXPECT_TRUE(masked.view().empty());
  const cv::Mat depth = ramp<float>(6, 8, CV_32FC1);
  masked_depth(DepthView::tum(depth), ImageView(), masked);
  EXPECT_EQ(cv::countNonZero(as_mat(masked.view()) != depth), 0);
}

}  // namespace
}  // namespace stillpoint::masked_depth_test
