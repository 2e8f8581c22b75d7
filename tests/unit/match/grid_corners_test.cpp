// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/grid_corners.hpp"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "stillpoint/core/random.hpp"
#include "stillpoint/opencv.hpp"
#include "wave_texture.hpp"

namespace stillpoint {
namespace {

std::vector<Vector2f> corners_of(const cv::Mat& image, int cell_px, float weakest) {
  std::vector<Vector2f> corners;
  Workspace workspace;
  grid_corners(image, cell_px, weakest, corners, workspace);
  return corners;
}

// White from (24, 24) on. Central differences are 255 at the columns 23 and 24 (rows from 24 on), and the other way
// round; both at (24, 24) only. The window of 5 × 5 round (25, 25) holds 2 × 4 of each: the tensor is 255² (8 1; 1 8),
// its smaller eigenvalue 7 · 255² = 455175. One pixel on or back it is 5 · 255² at most, 5.6 · 255² to the side.
TEST(GridCorners, FindsAKnownCornerAtItsStrength) {
  cv::Mat image(48, 48, CV_8UC1, cv::Scalar(0));
  image(cv::Rect(24, 24, 24, 24)).setTo(255);
  EXPECT_EQ(corners_of(image, 16, 0.0f), std::vector<Vector2f>{Vector2f(25, 25)});
  EXPECT_EQ(corners_of(image, 16, 455174.0f).size(), 1u);
  EXPECT_TRUE(corners_of(image, 16, 455175.0f).empty()) << "a corner must be stronger than the weakest";
}

TEST(GridCorners, FlatImagesAndEdgesHaveNone) {
  EXPECT_TRUE(corners_of(cv::Mat(48, 64, CV_8UC1, cv::Scalar(200)), 8, 0.0f).empty());
  cv::Mat edge(48, 64, CV_8UC1, cv::Scalar(0));
  edge.colRange(30, 64).setTo(255);
  EXPECT_TRUE(corners_of(edge, 8, 0.0f).empty());
}

// Sliding sums against the definition, pixel for pixel: all sums are integers below 2²⁴, so that floats are exact.
TEST(GridCorners, AreTheStrongestOfEachCell) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const int width = 30 + static_cast<int>(random.index(50)), height = 30 + static_cast<int>(random.index(50));
    const int cell_px = 5 + static_cast<int>(random.index(12));
    const cv::Mat image = test::WaveTexture(seed).shifted(width, height, {0, 0});
    const auto gray = [&](int u, int v) { return static_cast<float>(image.at<std::uint8_t>(v, u)); };
    std::map<std::pair<int, int>, std::pair<float, Vector2f>> best;
    for (int v = 6; v < height - 6; ++v) {
      for (int u = 6; u < width - 6; ++u) {
        float a = 0, b = 0, c = 0;
        for (int j = v - 2; j <= v + 2; ++j) {
          for (int i = u - 2; i <= u + 2; ++i) {
            const float gx = gray(i + 1, j) - gray(i - 1, j), gy = gray(i, j + 1) - gray(i, j - 1);
            a += gx * gx;
            b += gx * gy;
            c += gy * gy;
          }
        }
        const float strength = 0.5f * (a + c) - std::sqrt(0.25f * (a - c) * (a - c) + b * b);
        auto& cell = best[{v / cell_px, u / cell_px}];
        if (strength > cell.first) cell = {strength, Vector2f(static_cast<float>(u), static_cast<float>(v))};
      }
    }
    constexpr float kWeakest = 300.0f;
    std::vector<Vector2f> expected;
    for (const auto& [cell, corner] : best)
      if (corner.first > kWeakest) expected.push_back(corner.second);
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(corners_of(image, cell_px, kWeakest), expected) << "seed " << seed;
  }
}

// 6 pixels of border on each side: nothing is left below 13.
TEST(GridCorners, TinyImagesHaveNone) {
  Random random(1);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 100}, {100, 2}, {12, 100}, {100, 12}, {13, 13}}) {
    cv::Mat image(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random.index(256));
    EXPECT_EQ(corners_of(image, 8, 0.0f).size(), width == 13 ? 1u : 0u) << width << " x " << height;
  }
  EXPECT_TRUE(corners_of(cv::Mat(), 8, 0.0f).empty());
}

TEST(GridCorners, AreAppended) {
  std::vector<Vector2f> corners = {{1, 2}};
  Workspace workspace;
  grid_corners(test::WaveTexture(1).shifted(60, 60, {0, 0}), 20, 0.0f, corners, workspace);
  EXPECT_GT(corners.size(), 5u);
  EXPECT_EQ(corners.front(), Vector2f(1, 2));
}

}  // namespace
}  // namespace stillpoint
