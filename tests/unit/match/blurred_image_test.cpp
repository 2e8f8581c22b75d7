// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/blurred_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "stillpoint/core/random.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint::blurred_image_test {
namespace {

constexpr float kBlur_px = 1.0f;

/// Blocks of 4 × 4 pixels of random gray values around 100; those of the right half spread `right_spread` times as far.
cv::Mat blocks(int width, int height, double right_spread, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int top = 0; top < height; top += 4)
    for (int left = 0; left < width; left += 4) {
      const double spread = 10.0 * (left < width / 2 ? 1.0 : right_spread);
      const cv::Rect block(left, top, std::min(4, width - left), std::min(4, height - top));
      image(block) = cv::saturate_cast<std::uint8_t>(100.0 + spread * random.uniform(-1.0, 1.0));
    }
  return image;
}

BlurredImage blurred(const cv::Mat& gray) {
  BlurredImage image;
  image.assign(ImageView(gray), 1, kBlur_px);
  return image;
}

// (value − mean) / sqrt(variance + 0.15²), mean and variance over what lies within the reach: summed here pixel by
// pixel.
TEST(BlurredImage, EqualContrastIsThatOfTheSurroundings) {
  for (const auto& [width, height, reach_px] : {std::array{40, 30, 8}, {12, 9, 3}, {5, 40, 8}, {1, 1, 2}, {7, 3, 0}}) {
    const BlurredImage before = blurred(blocks(width, height, 6.0, 3));
    BlurredImage after = before;
    after.equalize_contrast(reach_px);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        double sum = 0, squares = 0;
        int count = 0;
        for (int y = std::max(v - reach_px, 0); y <= std::min(v + reach_px, height - 1); ++y)
          for (int x = std::max(u - reach_px, 0); x <= std::min(u + reach_px, width - 1); ++x) {
            const auto value = static_cast<double>(before.at(x, y));
            sum += value;
            squares += value * value;
            ++count;
          }
        const double mean = sum / count, variance = std::max(squares / count - mean * mean, 0.0);
        const double expected = (static_cast<double>(before.at(u, v)) - mean) / std::sqrt(variance + 0.15 * 0.15);
        ASSERT_NEAR(static_cast<double>(after.at(u, v)), expected, 2e-3) << u << " " << v << " reach " << reach_px;
      }
  }
}

// Six times the contrast on the right, so that the left has 1 / sqrt((1 + 6²) / 2) = 0.23 of the image's standard
// deviation, 0.16 after the blur. Of the full contrast that becomes 0.16 / sqrt(0.16² + 0.15²) = 0.7, and on the
// right 1.
TEST(BlurredImage, ADimHalfIsHeardAsMuchAsABrightOne) {
  const auto spread = [](const BlurredImage& image, int left) {
    double squares = 0;
    for (int v = 0; v < image.height(); ++v)
      for (int u = left; u < left + 20; ++u) squares += static_cast<double>(image.at(u, v) * image.at(u, v));
    return std::sqrt(squares / (20.0 * image.height()));
  };
  BlurredImage image = blurred(blocks(80, 60, 6.0, 4));
  EXPECT_GT(spread(image, 50), 4.0 * spread(image, 10)) << "else the test asks nothing";
  image.equalize_contrast(8);
  EXPECT_LT(spread(image, 50), 2.0 * spread(image, 10));
}

TEST(BlurredImage, ABlankImageStaysBlank) {
  BlurredImage image = blurred(cv::Mat(30, 40, CV_8UC1, cv::Scalar(90)));
  image.equalize_contrast(8);
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u) ASSERT_NEAR(image.at(u, v), 0.0f, 1e-5f);
  BlurredImage nothing;
  nothing.equalize_contrast(8);
  EXPECT_TRUE(nothing.empty());
}

}  // namespace
}  // namespace stillpoint::blurred_image_test
