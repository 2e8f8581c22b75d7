// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/patch_pixels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

std::uint8_t gray(Random& random) { return static_cast<std::uint8_t>(random.index(256)); }

// A quarter to the right, half down: (3 · 10 + 20 + 3 · 30 + 80) / 8 = 27.5 gray levels, 440 sixteenths.
TEST(BilinearWeights, AreSharesOfFourPixels) {
  const BilinearWeights weights(0.25f, 0.5f);
  EXPECT_EQ(weights.right, 32);
  EXPECT_EQ(weights.below, 16384);
  const std::uint8_t upper[2] = {10, 20}, lower[2] = {30, 80};
  EXPECT_EQ(sample_pixel(upper, lower, weights), 440);
}

// The place along the line is off by half of 2⁻⁷ at the most, that between the lines by 2⁻¹⁵, the upper half of a
// product by 1 of 2⁷ to either side, and the result is rounded to sixteenths.
TEST(BilinearWeights, SampleWhatFloatsDo) {
  Random random(1);
  constexpr double kTolerance = 255.0 / 256 + 255.0 / 32768 + 1.0 / 128 + 1.0 / 32;
  double bias = 0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto a = static_cast<float>(random.uniform()), b = static_cast<float>(random.uniform());
    const BilinearWeights weights(a, b);
    const std::uint8_t upper[2] = {gray(random), gray(random)}, lower[2] = {gray(random), gray(random)};
    const double expected =
        (1.0 - b) * ((1.0 - a) * upper[0] + a * upper[1]) + b * ((1.0 - a) * lower[0] + a * lower[1]);
    const double difference = sample_pixel(upper, lower, weights) / 16.0 - expected;
    ASSERT_LT(std::abs(difference), kTolerance);
    bias += difference / kTrials;
  }
  EXPECT_LT(std::abs(bias), 0.004);  // six standard deviations of 20000 differences of 0.1 on average
}

// Between the lines 2¹⁵ − 1 of 2¹⁵ are the whole way: less than a sixteenth is missing from the steepest edge.
TEST(BilinearWeights, AWholePixelIsItself) {
  const std::uint8_t upper[2] = {255, 3}, lower[2] = {7, 11};
  EXPECT_EQ(sample_pixel(upper, lower, BilinearWeights(0, 0)), 255 * 16);
  EXPECT_EQ(sample_pixel(upper, lower, BilinearWeights(1, 0)), 3 * 16);
  EXPECT_EQ(sample_pixel(upper, lower, BilinearWeights(0, 1)), 7 * 16);
  EXPECT_EQ(sample_pixel(upper, lower, BilinearWeights(1, 1)), 11 * 16);
}

// The kernel of all pixels against the one of one pixel, bit for bit: white, black, edges between them and anything
// else, in places where a weight is 0.
TEST(SampleSquare, IsSamplePixelOfEachPlace) {
  Random random(2);
  constexpr std::size_t kWidth = 13;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<std::uint8_t, 10 * kWidth> image;
    for (std::uint8_t& pixel : image) {
      const int contrast = trial % 4;
      pixel = contrast == 0 ? 255 : contrast == 1 ? 0 : contrast == 2 ? gray(random) : random.uniform() < 0.5 ? 0 : 255;
    }
    const double small = trial % 5 == 0 ? 1e-4 : 1.0;
    const BilinearWeights weights(static_cast<float>(small * random.uniform()),
                                  trial % 10 == 0 ? 0.5f : static_cast<float>(random.uniform()));
    PatchPixels square;
    sample_square(&image[1], kWidth, weights, square);
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 8; ++i) {
        const std::uint8_t* const pixel = &image[1 + j * kWidth + i];
        ASSERT_EQ(square[8 * j + i], sample_pixel(pixel, pixel + kWidth, weights)) << trial << ": " << i << ", " << j;
      }
  }
}

// The largest that can be: 64 samples of 255 levels in sixteenths, 64 · 4080² = 1065369600 < 2³¹.
TEST(PatchPixels, SumsDoNotOverflow) {
  PatchPixels white;
  white.pixel.fill(4080);
  EXPECT_EQ(sum(white), 64 * 4080);
  EXPECT_EQ(product(white, white), 1065369600);
}

TEST(PatchPixels, AreMaskedPixelByPixel) {
  Random random(3);
  PatchPixels mask, pixels;
  std::int32_t expected = 0, expected_product = 0;
  for (std::size_t k = 0; k < PatchPixels::kCount; ++k) {
    mask.pixel[k] = random.uniform() < 0.5 ? 0 : -1;
    pixels.pixel[k] = static_cast<std::int16_t>(static_cast<int>(random.index(511)) - 255);
    if (mask[k] == 0) continue;
    expected += pixels[k];
    expected_product += pixels[k] * pixels[k];
  }
  apply_mask(mask, pixels);
  EXPECT_EQ(sum(pixels), expected);
  EXPECT_EQ(product(pixels, pixels), expected_product);
}

}  // namespace
}  // namespace stillpoint
