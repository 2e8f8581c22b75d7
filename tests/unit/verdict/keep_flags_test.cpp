// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/verdict/keep_flags.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "unit/error_of.hpp"
#include "unit/verdict/told_result.hpp"

namespace stillpoint::keep_flags_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

using told_result::label;
class KeepFlags : public told_result::ToldResult {};

TEST_F(KeepFlags, FromWeightsKeepAtTheLimitAndDropNaN) {
  const std::vector<float> given = {0.5f, 0.499f, 1.0f, 0.0f, kNaN};
  std::vector<std::uint8_t> keep;
  flags_from_weights(given, keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{1, 0, 1, 0, 0}));
  flags_from_weights(given, keep, 0.75f);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 0, 1, 0, 0}));
}

TEST_F(KeepFlags, TheMaskDropsWithinItsMarginAndLeadsBackToTheFlags) {
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

TEST_F(KeepFlags, AMaskOfFloatsIsAnError) {
  std::vector<std::uint8_t> keep;
  EXPECT_EQ(error_of([&] {
              flags_from_mask(cv::Mat(6, 8, CV_32FC1, 1.0), std::vector<Vector2f>{{0, 0}}, keep);
            }),
            "flags_from_mask: the mask is no gray8 image, expected gray8, one byte per pixel");
}

TEST_F(KeepFlags, FromAMaskKeepWhatLiesOutsideOfIt) {
  const cv::Mat mask(6, 8, CV_8UC1, cv::Scalar(0));  // drops everything it covers
  std::vector<std::uint8_t> keep;
  flags_from_mask(mask, std::vector<Vector2f>{{0, 0}, {7.4f, 5.4f}, {7.6f, 0}, {-0.6f, 0}, {kNaN, 0}, {1e30f, 0}},
                  keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 1}));
  flags_from_mask(ImageView(), std::vector<Vector2f>{{0, 0}}, keep);
  EXPECT_EQ(keep, (std::vector<std::uint8_t>{1}));
}

}  // namespace
}  // namespace stillpoint::keep_flags_test
