// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/verdict/output_modes.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "unit/pipeline/mock_policies.hpp"

namespace stillpoint::output_modes_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A classifier that gives each feature what the test says.
struct ToldClassifier {
  std::vector<Label> told;
  void classify(const Observations& observations, const Evidence&, span<Label> labels, Workspace&) const {
    for (std::size_t i = 0; i < observations.size(); ++i) labels[i] = told[i];
  }
};
struct ToldPolicies : mock::Policies {
  using Classifier = ToldClassifier;
};

Label label(bool keep, float probability) {
  Label result;
  result.keep = keep;
  result.verdict = keep ? Verdict::kept : Verdict::dynamic;
  result.probability = probability;
  return result;
}

/// The result of a frame of 8 × 6 pixels.
class OutputModes : public testing::Test {
 protected:
  const FrameResult& judge(const std::vector<Vector2f>& pixels, const std::vector<Label>& labels) {
    filter.classifier.told = labels;
    filter.filter_frame(FrameView(gray, DepthView(), 1.0), pixels);
    return filter.filter_frame(FrameView(gray, DepthView(), 1.1), pixels);
  }

  FrameFilter<ToldPolicies> filter{Camera(10, 10, 3.5, 2.5, 8, 6)};
  cv::Mat gray = cv::Mat(6, 8, CV_8UC1, cv::Scalar(0));
};

TEST_F(OutputModes, WeightIsOneMinusTheProbabilityOfMoving) {
  const FrameResult& result = judge({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}},
                                    {label(true, 0.25f), label(false, 0.75f), label(true, 0.0f), label(false, 1.0f),
                                     label(true, 0.875f)});  // the last as the keep-floor leaves it
  std::vector<float> found;
  weights(result, found);
  EXPECT_EQ(found, (std::vector<float>{0.75f, 0.25f, 1.0f, 0.0f, 0.125f}));
}

TEST_F(OutputModes, WithoutAProbabilityWhatIsKeptWeighsOneAndWhatIsDroppedNothing) {
  std::vector<float> found;
  weights(judge({{0, 0}, {1, 1}}, {label(true, kNaN), label(false, kNaN)}), found);
  EXPECT_EQ(found, (std::vector<float>{1.0f, 0.0f}));
}

// 0.75 · 0.5 of a feature that is half trusted; what is not trusted at all counts a quarter, and nothing where it
// moves.
TEST_F(OutputModes, WhatMovedOnceWeighsLess) {
  std::vector<Label> labels = {label(true, 0.25f), label(true, 0.25f), label(true, kNaN), label(false, kNaN)};
  labels[0].trust = 0.5f;
  for (std::size_t i = 1; i < labels.size(); ++i) labels[i].trust = 0.01f;
  std::vector<float> found;
  weights(judge({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, labels), found);
  EXPECT_EQ(found, (std::vector<float>{0.375f, 0.75f * 0.35f, 0.35f, 0.0f}));
}

TEST_F(OutputModes, AFrameThatWasNotJudgedWeighsOneEverywhere) {
  std::vector<float> found(7, 0.5f);
  weights(filter.filter_frame(FrameView(gray, DepthView(), 1.0), std::vector<Vector2f>{{0, 0}, {1, 1}}), found);
  EXPECT_EQ(found, (std::vector<float>{1.0f, 1.0f})) << "one entry a feature, whatever was there before";
}

TEST(OutputFlags, FromWeightsKeepAtTheLimitAndDropNaN) {
  const std::vector<float> given = {0.5f, 0.499f, 1.0f, 0.0f, kNaN};
  std::vector<std::uint8_t> keep;
  flags_from_weights(given, keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{1, 0, 1, 0, 0}));
  flags_from_weights(given, keep, 0.75f);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 0, 1, 0, 0}));
}

TEST_F(OutputModes, TheMaskDropsWithinItsMarginAndLeadsBackToTheFlags) {
  const std::vector<Vector2f> pixels = {{1, 1}, {6, 4}};
  const FrameResult& result = judge(pixels, {label(false, kNaN), label(true, kNaN)});
  ImageBuffer mask;
  result.mask(mask, 1);
  std::vector<std::uint8_t> keep;
  flags_from_mask(mask.view(), pixels, keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 1}));
  // Margin 1: the four neighbours too, (2, 2) at distance √2 not. 1.49 rounds to 1, 1.51 to 2.
  flags_from_mask(mask.view(), std::vector<Vector2f>{{2, 1}, {1, 2}, {0, 1}, {1, 0}, {2, 2}, {1.49f, 0}, {1.51f, 0}},
                  keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 1}));
}

TEST(OutputFlags, FromAMaskKeepWhatLiesOutsideOfIt) {
  const cv::Mat mask(6, 8, CV_8UC1, cv::Scalar(0));  // drops everything it covers
  std::vector<std::uint8_t> keep;
  flags_from_mask(mask, std::vector<Vector2f>{{0, 0}, {7.4f, 5.4f}, {7.6f, 0}, {-0.6f, 0}, {kNaN, 0}, {1e30f, 0}},
                  keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 1}));
  flags_from_mask(ImageView(), std::vector<Vector2f>{{0, 0}}, keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{1}));
}

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
}  // namespace stillpoint::output_modes_test
