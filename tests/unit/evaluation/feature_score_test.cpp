// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/evaluation/feature_score.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "unit/error_of.hpp"

namespace stillpoint {
namespace {

/// One row of pixels: background, ignore, parked, moving.
const std::vector<std::uint8_t> kRow = {0, 64, 128, 255};
const ImageView kLabels(kRow.data(), 4, 1, 4, PixelFormat::gray8);

std::string message(const ImageView& labels, const std::vector<Vector2f>& pixels,
                    const std::vector<std::uint8_t>& keep) {
  FilterScore score;
  return error_of([&] {
    for (int frame = 0; frame < 2; ++frame) score.add_frame(labels, pixels, keep);
  });
}

TEST(FilterScore, HandComputed) {
  // Frame 2: moving dropped, moving kept, moving dropped, background kept, ignore dropped. Frame 3: background dropped,
  // background kept, background kept, parked dropped.
  FilterScore score;
  score.add_frame(kLabels, std::vector<Vector2f>{{3, 0}}, std::vector<std::uint8_t>{0});
  score.add_frame(kLabels, std::vector<Vector2f>{{3, 0}, {3, 0}, {3, 0}, {0, 0}, {1, 0}},
                  std::vector<std::uint8_t>{0, 1, 0, 1, 0});
  score.add_frame(kLabels, std::vector<Vector2f>{{0, 0}, {0, 0}, {0, 0}, {2, 0}},
                  std::vector<std::uint8_t>{0, 255, 1, 0});
  EXPECT_EQ(score.frames(), 3u);
  EXPECT_EQ(score.moving().features, 3u);
  EXPECT_EQ(score.background().features, 4u);
  EXPECT_EQ(score.parked().features, 1u);
  EXPECT_DOUBLE_EQ(score.recall().value(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(score.false_positive_rate().value(), 0.25);
  EXPECT_DOUBLE_EQ(score.parked_dropped().value(), 1.0);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
TEST(FilterScore, FalseAlarmsIsTheNameOfBefore) {
  FilterScore score;
  for (int frame = 0; frame < 2; ++frame)
    score.add_frame(kLabels, std::vector<Vector2f>{{0, 0}, {2, 0}}, std::vector<std::uint8_t>{0, 1});
  EXPECT_EQ(score.false_alarms(), score.false_positive_rate());
  EXPECT_TRUE(score.false_alarms());
}
#pragma GCC diagnostic pop

TEST(FilterScore, FirstFrameIsLeftOut) {
  FilterScore score;
  score.add_frame(kLabels, std::vector<Vector2f>{{3, 0}, {0, 0}}, std::vector<std::uint8_t>{0, 0});
  EXPECT_FALSE(score.recall());
  EXPECT_FALSE(score.false_positive_rate());
  EXPECT_FALSE(score.parked_dropped());
}

TEST(FilterScore, KindWithoutAFeatureHasNoNumber) {
  FilterScore score;
  for (int frame = 0; frame < 2; ++frame)
    score.add_frame(kLabels, std::vector<Vector2f>{{0, 0}}, std::vector<std::uint8_t>{1});
  EXPECT_FALSE(score.recall());
  EXPECT_DOUBLE_EQ(score.false_positive_rate().value(), 0.0);
  EXPECT_FALSE(score.parked_dropped());
}

TEST(FilterScore, PixelIsRoundedAndOutsideIsNotCounted) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  FilterScore score;
  const std::vector<Vector2f> pixels = {{2.6f, 0.4f},  {3.4f, -0.4f},                   // both (3, 0)
                                        {-0.6f, 0.0f}, {3.6f, 0.0f},  {0.0f, 0.6f},     // outside
                                        {kNaN, 0.0f},  {0.0f, 1e30f}, {-1e30f, 0.0f}};  // nowhere
  const std::vector<std::uint8_t> keep(pixels.size(), 0);
  for (int frame = 0; frame < 2; ++frame) score.add_frame(kLabels, pixels, keep);
  EXPECT_EQ(score.moving().features, 2u);
  EXPECT_EQ(score.background().features, 0u);
  EXPECT_EQ(score.parked().features, 0u);
}

TEST(FilterScore, RowsMayHaveGaps) {
  const std::vector<std::uint8_t> padded = {0, 99, 255, 99};
  const ImageView labels(padded.data(), 1, 2, 2, PixelFormat::gray8);
  FilterScore score;
  for (int frame = 0; frame < 2; ++frame)
    score.add_frame(labels, std::vector<Vector2f>{{0, 1}}, std::vector<std::uint8_t>{0});
  EXPECT_DOUBLE_EQ(score.recall().value(), 1.0);
}

TEST(FilterScore, WrongInputIsNamed) {
  EXPECT_EQ(message(kLabels, {{0, 0}, {1, 0}}, {1}),
            "filter score: 2 features and 1 verdicts, expected as many of each");
  EXPECT_EQ(message({}, {}, {}),
            "filter score: the label image is empty or not 8 bit with one channel, expected gray8");
  const std::vector<std::uint8_t> wrong = {7};
  EXPECT_EQ(message(ImageView(wrong.data(), 1, 1, 1, PixelFormat::gray8), {{0, 0}}, {1}),
            "filter score: label 7, expected 0, 64, 128 or 255");
}

}  // namespace
}  // namespace stillpoint
