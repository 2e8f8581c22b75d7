// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/pyramid.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "stillpoint/core/random.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {
namespace {

std::vector<int> values(const ImageView& image) {
  std::vector<int> values;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) values.push_back(image.row<std::uint8_t>(v)[u]);
  return values;
}

// (10 + 20 + 30 + 41) / 4 = 25.25 → 25; (1 + 2 + 3 + 4) / 4 = 2.5 → 3; the fifth column and the third row have no pair.
TEST(Pyramid, EachPixelIsTheRoundedMeanOfFour) {
  const cv::Mat image = (cv::Mat_<std::uint8_t>(3, 5) << 10, 20, 1, 2, 99,  //
                         30, 41, 3, 4, 99,                                  //
                         99, 99, 99, 99, 99);
  Pyramid pyramid;
  pyramid.build(image, 3);
  ASSERT_EQ(pyramid.size(), 3u);
  EXPECT_EQ(values(pyramid[0]), values(ImageView(image)));
  EXPECT_EQ(values(pyramid[1]), (std::vector<int>{25, 3}));
  EXPECT_TRUE(pyramid[2].empty()) << "one row has no half";
}

TEST(Pyramid, MayBeBuiltAgainFromAnImageOfAnotherSize) {
  Pyramid pyramid;
  pyramid.build(cv::Mat(64, 64, CV_8UC1, cv::Scalar(255)), 4);
  EXPECT_EQ(values(pyramid[3]), std::vector<int>(64, 255)) << "no overflow";
  pyramid.build(cv::Mat(1, 1, CV_8UC1, cv::Scalar(7)), 4);
  EXPECT_EQ(values(pyramid[0]), std::vector<int>{7});
  for (std::size_t level = 1; level < 4; ++level) EXPECT_TRUE(pyramid[level].empty());
}

// A pixel of level 1 covers two of level 0: the centre of 0 and 1, which is 0.5, is its 0. On level 2: 1.5 is 0, 5.5 is
// 1.
TEST(Pyramid, PixelCentresAreIntegersOnEveryLevel) {
  EXPECT_EQ(Pyramid::to_level({0.5f, 2.5f}, 1), Vector2f(0, 1));
  EXPECT_EQ(Pyramid::to_level({1.5f, 5.5f}, 2), Vector2f(0, 1));
  EXPECT_EQ(Pyramid::from_level({0, 1}, 2), Vector2f(1.5f, 5.5f));
  EXPECT_EQ(Pyramid::to_level({3, 4}, 0), Vector2f(3, 4));
}

TEST(Pyramid, FromLevelUndoesToLevel) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector2f pixel(static_cast<float>(random.uniform(-10, 700)), static_cast<float>(random.uniform(-10, 500)));
    for (std::size_t level = 0; level < 5; ++level)
      EXPECT_LT((Pyramid::from_level(Pyramid::to_level(pixel, level), level) - pixel).norm(), 1e-3f);  // float rounding
  }
}

}  // namespace
}  // namespace stillpoint
