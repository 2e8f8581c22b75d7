// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_segmentation.hpp"

#include <cmath>
#include <limits>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_segmentation_test {
namespace {

// A raster of 20x10 for an input of 200x100: ten pixels a cell.
const DecodeSettings kSettings{{200, 100}, 3, 0.4f};

void fill(MadeTensor& output, int channel, int left, int top, int right, int bottom, float value) {
  for (int v = top; v < bottom; ++v)
    for (int u = left; u < right; ++u) output.at({0, channel, v, u}) = value;
}

std::vector<RawDetection> parts(const MadeTensor& output, float smallest_share = 0.0f) {
  std::vector<RawDetection> found;
  append_parts(label_map_from_scores(output.view(), kSettings), kSettings, smallest_share, found);
  return found;
}

TEST(DecodeSegmentation, OneChannelIsAProbability) {
  MadeTensor output({1, 1, 10, 20});
  fill(output, 0, 2, 3, 6, 9, 0.8f);
  fill(output, 0, 4, 3, 6, 6, 0.45f);  // a corner is missing
  const std::vector<RawDetection> found = parts(output);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 20, 30, 60, 90);
  EXPECT_NEAR(found[0].score, 0.8f, 1e-5f);
  EXPECT_EQ(found[0].label, 0);
  ASSERT_TRUE(found[0].mask);
  EXPECT_EQ(found[0].mask->columns, 4);
  EXPECT_EQ(found[0].mask->rows, 6);
  EXPECT_TRUE(found[0].mask->at(0.2f, 0.2f));
  EXPECT_FALSE(found[0].mask->at(0.8f, 0.2f));
  EXPECT_TRUE(found[0].mask->at(0.8f, 0.8f));
}

TEST(DecodeSegmentation, OneChannelOutsideZeroToOneIsALogit) {
  MadeTensor output({1, 1, 10, 20}, -5);
  fill(output, 0, 2, 3, 6, 9, std::log(3.0f));
  const std::vector<RawDetection> found = parts(output);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].score, 0.75f, 1e-5f);
}

// A linear enlargement in floats leaves 0 to 1 by one rounding, a cubic one by up to a seventh; a broken cell is NaN.
TEST(DecodeSegmentation, OneCellBesideZeroToOneLeavesTheOthersProbabilities) {
  for (const float odd : {1.0f + 1.2e-7f, -1e-7f, 1.14f, -0.14f, std::numeric_limits<float>::quiet_NaN()}) {
    MadeTensor one({1, 1, 10, 20});
    fill(one, 0, 2, 3, 6, 9, 0.8f);
    one.at({0, 0, 0, 0}) = odd > 1 ? 0.0f : odd;
    one.at({0, 0, 4, 4}) = odd > 1 ? odd : 0.8f;
    std::vector<RawDetection> found = parts(one);
    ASSERT_EQ(found.size(), 1u) << odd;
    expect_box(found[0], 20, 30, 60, 90);
    EXPECT_NEAR(found[0].score, 0.8f, 0.01f) << odd;
    EXPECT_LE(found[0].score, 1.0f) << odd;

    MadeTensor three({1, 3, 10, 20});
    fill(three, 0, 0, 0, 20, 10, 1.0f);
    fill(three, 0, 2, 3, 6, 9, 0.1f);
    fill(three, 2, 2, 3, 6, 9, 0.9f);
    three.at({0, 0, 0, 0}) = odd;
    found = parts(three);
    ASSERT_EQ(found.size(), 2u) << odd;
    EXPECT_EQ(found[1].label, 2) << odd;
    EXPECT_NEAR(found[0].score, 1.0f, 1e-6f) << odd;
    EXPECT_LE(found[0].score, 1.0f) << odd;
    EXPECT_NEAR(found[1].score, 0.9f, 1e-5f) << odd;
  }
}

TEST(DecodeSegmentation, TwoChannelsAreBackgroundAndOneClass) {
  MadeTensor output({1, 2, 10, 20});
  fill(output, 0, 0, 0, 20, 10, 2);
  fill(output, 1, 2, 3, 6, 9, 2 + std::log(3.0f));  // softmax of two: 0.75
  const std::vector<RawDetection> found = parts(output);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 0);
  EXPECT_NEAR(found[0].score, 0.75f, 1e-5f);
  MadeTensor probabilities({1, 2, 10, 20}, 0.1f);
  fill(probabilities, 1, 2, 3, 6, 9, 0.9f);
  ASSERT_EQ(parts(probabilities).size(), 1u);
  EXPECT_NEAR(parts(probabilities)[0].score, 0.9f, 1e-5f);
}

TEST(DecodeSegmentation, ManyChannelsCompete) {
  MadeTensor three({1, 3, 10, 20});
  fill(three, 0, 0, 0, 20, 10, 5);
  fill(three, 2, 2, 3, 6, 9, 5 + std::log(2.0f));  // e^5 : 1 : 2e^5, about two thirds
  std::vector<RawDetection> found = parts(three);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].label, 0);
  EXPECT_EQ(found[1].label, 2);
  EXPECT_NEAR(found[1].score, 2.0f / 3, 0.01f);
  expect_box(found[1], 20, 30, 60, 90);
  EXPECT_FALSE(found[0].mask->at(0.2f, 0.5f));  // where the other is

  MadeTensor four({1, 4, 10, 20});  // one more than classes: the first is the background
  fill(four, 0, 0, 0, 20, 10, 5);
  fill(four, 2, 2, 3, 6, 9, 10);
  found = parts(four);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_THROW(parts(MadeTensor({1, 5, 10, 20})), Error);
}

TEST(DecodeSegmentation, PartsTouchAtEdgesNotAtCorners) {
  MadeTensor output({1, 1, 10, 20});
  fill(output, 0, 0, 0, 5, 5, 1);
  fill(output, 0, 5, 5, 10, 10, 1);  // touches at a corner
  fill(output, 0, 12, 0, 13, 8, 1);  // a U: one part, though its arms are met one after the other
  fill(output, 0, 15, 0, 16, 8, 1);
  fill(output, 0, 12, 7, 16, 8, 1);
  std::vector<RawDetection> found = parts(output);
  ASSERT_EQ(found.size(), 3u);
  expect_box(found[0], 0, 0, 50, 50);
  expect_box(found[1], 120, 0, 160, 80);
  expect_box(found[2], 50, 50, 100, 100);
  EXPECT_EQ(parts(output, 0.1f).size(), 2u);  // 20 of 200 cells at least: the U has 18
}

TEST(DecodeSegmentation, NanIsNothing) {
  EXPECT_TRUE(parts(MadeTensor({1, 1, 10, 20}, std::numeric_limits<float>::quiet_NaN())).empty());
  EXPECT_TRUE(parts(MadeTensor({1, 3, 10, 20}, std::numeric_limits<float>::quiet_NaN())).empty());
}

TEST(DecodeSegmentation, LabelMapsAreCertain) {
  for (const TensorShape& shape : {TensorShape{1, 10, 20}, TensorShape{1, 10, 20, 1}}) {
    MadeTensor output(shape);
    for (int v = 3; v < 9; ++v)
      for (int u = 2; u < 6; ++u) output.values[static_cast<std::size_t>(v * 20 + u)] = 15;
    std::vector<RawDetection> found;
    append_parts(label_map_from_labels(output.view()), kSettings, 0.0f, found);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].label, 15);
    EXPECT_EQ(found[1].score, 1.0f);
    expect_box(found[1], 20, 30, 60, 90);
  }
  EXPECT_THROW(label_map_from_labels(MadeTensor({1, 3, 10, 20}).view()), Error);
}

}  // namespace
}  // namespace stillpoint::decode_segmentation_test
