// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/letterbox.hpp"

#include <gtest/gtest.h>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

constexpr float kTolerance = 1e-2f;  // float arithmetic on a few thousand pixels

TEST(Letterbox, StretchesAxisByAxis) {
  const Letterbox letterbox({640, 480}, {320, 320}, ImageFit::stretch);
  // 0.5 and 2/3 input pixels an image pixel; edges of pixels, half a pixel from their middles.
  const Box box = letterbox.to_image({100, 60, 200, 180});
  EXPECT_NEAR(box.x, 199.5f, kTolerance);
  EXPECT_NEAR(box.y, 89.5f, kTolerance);
  EXPECT_NEAR(box.width, 200, kTolerance);
  EXPECT_NEAR(box.height, 180, kTolerance);
}

TEST(Letterbox, BarsAreBelowOrOnBothSides) {
  const Letterbox centred({640, 480}, {416, 416}, ImageFit::letterbox_centred);  // scale 0.65: 416x312, bars of 52
  EXPECT_EQ(centred.width, 416);
  EXPECT_EQ(centred.height, 312);
  EXPECT_EQ(centred.left, 0);
  EXPECT_EQ(centred.top, 52);
  const Letterbox top_left({640, 480}, {416, 416}, ImageFit::letterbox_top_left);
  EXPECT_EQ(top_left.top, 0);
  EXPECT_NEAR(centred.to_image({65, 52 + 65, 130, 182}).y, 99.5f, kTolerance);
  EXPECT_NEAR(top_left.to_image({65, 65, 130, 130}).y, 99.5f, kTolerance);
  const Letterbox tall({480, 640}, {416, 416}, ImageFit::letterbox_centred);
  EXPECT_EQ(tall.left, 52);
  EXPECT_EQ(tall.top, 0);
}

TEST(Letterbox, ThereAndBackAgain) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const InputSize image{16 + static_cast<int>(random.uniform(0, 2000)),
                          16 + static_cast<int>(random.uniform(0, 2000))};
    const InputSize input{32 + static_cast<int>(random.uniform(0, 640)), 32 + static_cast<int>(random.uniform(0, 640))};
    const ImageFit fit = static_cast<ImageFit>(i % 3);
    const Letterbox letterbox(image, input, fit);
    ASSERT_GE(letterbox.left, 0);
    ASSERT_GE(letterbox.top, 0);
    ASSERT_LE(letterbox.left + letterbox.width, input.width);
    ASSERT_LE(letterbox.top + letterbox.height, input.height);
    // An image pixel's edge x lies at left + x·width/image.width.
    const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
    const auto x = static_cast<float>(random.uniform(0, 0.5)) * width,
               y = static_cast<float>(random.uniform(0, 0.5)) * height;
    const auto w = static_cast<float>(random.uniform(0.1, 0.5)) * width,
               h = static_cast<float>(random.uniform(0.1, 0.5)) * height;
    const auto u = [&](float edge) {
      return static_cast<float>(letterbox.left) + edge * static_cast<float>(letterbox.width) / width;
    };
    const auto v = [&](float edge) {
      return static_cast<float>(letterbox.top) + edge * static_cast<float>(letterbox.height) / height;
    };
    const Box box = letterbox.to_image({u(x), v(y), u(x + w), v(y + h)});
    ASSERT_NEAR(box.x, x - 0.5f, kTolerance);
    ASSERT_NEAR(box.y, y - 0.5f, kTolerance);
    ASSERT_NEAR(box.width, w, kTolerance);
    ASSERT_NEAR(box.height, h, kTolerance);
  }
}

TEST(Letterbox, WholeInputIsTheWholeImage) {
  const Letterbox letterbox({640, 480}, {416, 416}, ImageFit::letterbox_centred);
  RawDetection all{-50, -50, 500, 500};
  ASSERT_TRUE(letterbox.clip(all));
  const Box box = letterbox.to_image(all);
  EXPECT_NEAR(box.x, -0.5f, kTolerance);
  EXPECT_NEAR(box.y, -0.5f, kTolerance);
  EXPECT_TRUE(box.contains({0, 0}));
  EXPECT_TRUE(box.contains({639, 479}));
  EXPECT_FALSE(box.contains({640, 479}));
}

TEST(Letterbox, WhatLiesInTheBarsIsDropped) {
  const Letterbox letterbox({640, 480}, {416, 416}, ImageFit::letterbox_centred);
  RawDetection in_bar{10, 10, 60, 52};
  EXPECT_FALSE(letterbox.clip(in_bar));
  RawDetection outside{420, 100, 460, 152};
  EXPECT_FALSE(letterbox.clip(outside));
}

// Scaled to an image that is smaller than the input, a height of 1e-44 is 0.
TEST(Letterbox, ABoxOfNoHeightIsDropped) {
  const Letterbox letterbox({1, 1}, {32, 32}, ImageFit::stretch);
  RawDetection flat{0, 0, 28, 1e-44f}, narrow{5, 0, 5.0005f, 28}, small{0, 0, 0.002f, 0.002f};
  EXPECT_FALSE(letterbox.clip(flat));
  EXPECT_FALSE(letterbox.clip(narrow));
  ASSERT_TRUE(letterbox.clip(small));
  EXPECT_GT(letterbox.to_image(small).width, 0.0f);
}

TEST(Letterbox, AMaskIsCutWithItsBox) {
  const Letterbox letterbox({100, 100}, {100, 100}, ImageFit::stretch);
  RawDetection detection{-40, 0, 40, 80};
  auto mask = std::make_shared<BoxMask>();
  *mask = {8, 4, std::vector<std::uint8_t>(32, 0)};
  for (int v = 0; v < 4; ++v) mask->inside[static_cast<std::size_t>(v * 8 + 4)] = 1;  // from x = 0 to 10
  detection.mask = mask;
  ASSERT_TRUE(letterbox.clip(detection));
  EXPECT_EQ(detection.left, 0);
  EXPECT_EQ(detection.mask->columns, 4);
  EXPECT_EQ(detection.mask->rows, 4);
  EXPECT_TRUE(detection.mask->at(0.1f, 0.5f));
  EXPECT_FALSE(detection.mask->at(0.3f, 0.5f));
  EXPECT_EQ(mask->columns, 8);  // that of others is left alone
}

TEST(Letterbox, ExtremeProportionsKeepAPixel) {
  const Letterbox letterbox({5000, 2}, {100, 100}, ImageFit::letterbox_centred);
  EXPECT_EQ(letterbox.height, 1);
  EXPECT_EQ(letterbox.width, 100);
}

}  // namespace
}  // namespace stillpoint
