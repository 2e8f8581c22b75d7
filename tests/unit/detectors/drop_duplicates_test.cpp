// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/drop_duplicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/dnn.hpp>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

RawDetection box(float left, float top, float right, float bottom, float score = 0.5f, int label = 0) {
  return {left, top, right, bottom, score, label};
}
std::vector<float> scores(const std::vector<RawDetection>& found) {
  std::vector<float> result;
  for (const RawDetection& detection : found) result.push_back(detection.score);
  return result;
}
using Scores = std::vector<float>;

TEST(BoxOverlap, IsIntersectionOverUnion) {
  const RawDetection a = box(0, 0, 10, 10);
  EXPECT_FLOAT_EQ(box_overlap(a, a), 1);
  EXPECT_FLOAT_EQ(box_overlap(a, box(5, 0, 15, 10)), 1 / 3.0f);  // 50 / (100 + 100 - 50)
  EXPECT_FLOAT_EQ(box_overlap(a, box(0, 0, 10, 5)), 0.5f);       // 50 / (100 + 50 - 50)
  EXPECT_FLOAT_EQ(box_overlap(a, box(5, 5, 15, 15)), 1 / 7.0f);  // 25 / (200 - 25)
  EXPECT_FLOAT_EQ(box_overlap(a, box(2, 3, 6, 5)), 0.08f);       // 8 / 100: inside
  EXPECT_FLOAT_EQ(box_overlap(box(2, 3, 6, 5), a), 0.08f);
  EXPECT_FLOAT_EQ(box_overlap(box(-30, -30, -20, -20), box(-25, -30, -15, -20)), 1 / 3.0f);
}

TEST(BoxOverlap, OfBoxesThatTouchOrLackAnAreaIsNone) {
  const RawDetection a = box(0, 0, 10, 10);
  EXPECT_EQ(box_overlap(a, box(10, 0, 20, 10)), 0);
  EXPECT_EQ(box_overlap(a, box(0, 10, 10, 20)), 0);
  EXPECT_EQ(box_overlap(a, box(20, 20, 30, 30)), 0);
  EXPECT_EQ(box_overlap(a, box(5, 5, 5, 8)), 0);
  EXPECT_EQ(box_overlap(box(5, 5, 5, 5), box(5, 5, 5, 5)), 0);
}

TEST(DropDuplicates, TheBestOfAClassIsLeft) {
  // With the first, the second has 90/110 in common and the third 80/120; the last is elsewhere.
  std::vector<RawDetection> found = {box(0, 0, 10, 10, 0.6f), box(1, 0, 11, 10, 0.9f), box(2, 0, 12, 10, 0.7f),
                                     box(50, 0, 60, 10, 0.5f)};
  drop_duplicates(found, 0.45f);
  EXPECT_EQ(scores(found), (Scores{0.9f, 0.5f}));
  EXPECT_EQ(found[0].left, 1);
}

TEST(DropDuplicates, OtherClassesAreNoDuplicates) {
  std::vector<RawDetection> found = {box(0, 0, 10, 10, 0.6f, 3), box(0, 0, 10, 10, 0.9f, 7), box(0, 0, 10, 10, 0.7f, 3),
                                     box(0, 0, 10, 10, 0.8f, 0)};
  drop_duplicates(found, 0.45f);
  EXPECT_EQ(scores(found), (Scores{0.8f, 0.7f, 0.9f}));  // in the order of labels 0, 3, 7
}

TEST(DropDuplicates, WhatWasDroppedDropsNothing) {
  // In a row, each a third of the next: the first drops the second, and the third has nothing in common with the first.
  std::vector<RawDetection> found = {box(0, 0, 10, 10, 0.9f), box(5, 0, 15, 10, 0.8f), box(10, 0, 20, 10, 0.7f)};
  drop_duplicates(found, 0.3f);
  EXPECT_EQ(scores(found), (Scores{0.9f, 0.7f}));
}

TEST(DropDuplicates, TheLimitItselfIsAllowed) {
  const std::vector<RawDetection> halves = {box(0, 0, 10, 10, 0.9f), box(0, 0, 10, 5, 0.8f)};  // exactly one half
  std::vector<RawDetection> found = halves;
  drop_duplicates(found, 0.5f);
  EXPECT_EQ(found.size(), 2u);
  found = halves;
  drop_duplicates(found, 0.499f);
  EXPECT_EQ(found.size(), 1u);
}

TEST(DropDuplicates, AmongEqualScoresTheFirstIsLeft) {
  std::vector<RawDetection> found = {box(1, 0, 11, 10), box(0, 0, 10, 10)};
  drop_duplicates(found, 0.45f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].left, 1);
}

TEST(DropDuplicates, OfNothingAndOfOneAllIsLeft) {
  std::vector<RawDetection> found;
  drop_duplicates(found, 0.45f);
  EXPECT_TRUE(found.empty());
  found = {box(0, 0, 1, 1)};
  drop_duplicates(found, 0);
  EXPECT_EQ(found.size(), 1u);
}

TEST(DropDuplicates, AgreesWithOpenCvClassByClass) {
  Random random(5);
  std::size_t dropped = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<RawDetection> found;
    const int count = static_cast<int>(random.uniform(0, 120));
    for (int i = 0; i < count; ++i) {
      const auto left = static_cast<float>(random.uniform(-20, 150)),
                 top = static_cast<float>(random.uniform(-20, 100));
      const auto width = static_cast<float>(random.uniform(5, 90)), height = static_cast<float>(random.uniform(5, 90));
      const auto score = static_cast<float>(std::ceil(random.uniform(0, 30)) / 30);  // some are equal
      found.push_back(box(left, top, left + width, top + height, score, static_cast<int>(random.uniform(0, 4)) * 20));
    }
    const auto highest_overlap = static_cast<float>(random.uniform(0.05, 0.95));
    std::vector<RawDetection> expected;
    for (int label = 0; label <= 80; label += 20) {
      std::vector<RawDetection> one_class;
      std::copy_if(found.begin(), found.end(), std::back_inserter(one_class),
                   [&](const RawDetection& b) { return b.label == label; });
      std::vector<cv::Rect2d> boxes;
      for (const RawDetection& b : one_class) boxes.emplace_back(b.left, b.top, b.right - b.left, b.bottom - b.top);
      std::vector<int> best;
      cv::dnn::NMSBoxes(boxes, scores(one_class), 0.0f, highest_overlap, best);
      for (const int index : best) expected.push_back(one_class[static_cast<std::size_t>(index)]);
    }
    dropped += found.size() - expected.size();
    drop_duplicates(found, highest_overlap);
    ASSERT_EQ(scores(found), scores(expected)) << "round " << round;
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i].left, expected[i].left) << "round " << round;
  }
  EXPECT_GT(dropped, 1000u);
}

}  // namespace
}  // namespace stillpoint
