// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/spread_orb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/opencv.hpp"

namespace spread_orb_test {
namespace {

constexpr int kWidth_px = 640, kMiddle_px = kWidth_px / 2;

std::size_t count_left(const std::vector<cv::KeyPoint>& corners) {
  return static_cast<std::size_t>(
      std::count_if(corners.begin(), corners.end(), [](const cv::KeyPoint& k) { return k.pt.x < kMiddle_px; }));
}

/// Squares of all gray values: corners everywhere.
cv::Mat chequered() {
  cv::RNG random(7);
  cv::Mat gray(480, kWidth_px, CV_8U);
  for (int v = 0; v < gray.rows; v += 8)
    for (int u = 0; u < gray.cols; u += 8) gray(cv::Rect(u, v, 8, 8)) = random.uniform(0, 256);
  return gray;
}

/// The same frame, extracted again and again.
class SpreadOrbTest : public testing::Test {
 protected:
  SpreadOrbTest() {
    frame_.gray = stillpoint::ImageView(gray_);
    first_ = extract();
  }

  std::vector<cv::KeyPoint> extract() { return orb_.extract(frame_).keypoints; }

  const cv::Mat gray_ = chequered();
  stillpoint::FrameView frame_;
  examples::SpreadOrb orb_{examples::SpreadOrb::Options{}};
  std::vector<cv::KeyPoint> first_;
};

/// The filter drops the corners in the left half: the next frame has as many, most of them in the right half.
TEST_F(SpreadOrbTest, LooksPastWhatWasDropped) {
  std::vector<cv::KeyPoint> kept;
  for (const cv::KeyPoint& corner : first_)
    if (corner.pt.x >= kMiddle_px) kept.push_back(corner);
  orb_.look_past(first_, kept);
  const std::vector<cv::KeyPoint> second = extract();
  EXPECT_EQ(second.size(), first_.size());
  EXPECT_LT(count_left(second), count_left(first_) / 2);
  EXPECT_GT(count_left(second), 0u) << "what covers it may go: the filter must be able to say so";
  orb_.look_past(second, second);
  EXPECT_EQ(count_left(extract()), count_left(first_));
}

/// A cluttered half is no reason to look past a single dropped corner.
TEST_F(SpreadOrbTest, KeepsLookingWhereMostWasKept) {
  orb_.look_past(first_, {first_.begin() + 1, first_.end()});
  EXPECT_EQ(count_left(extract()), count_left(first_));
}

}  // namespace
}  // namespace spread_orb_test
