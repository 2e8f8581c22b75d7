// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/verdict/keep_floor.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint {
namespace {

static_assert(is_keep_floor<KeepFloor>::value);

/// An image of 80 × 60 pixels in cells of 20 × 20.
class KeepFloorTest : public testing::Test {
 protected:
  KeepFloorTest() {
    floor_.options.fewest_features = 0;
    floor_.options.fewest_cells = 0;
  }

  void add(const Vector2f& pixel, bool keep, float log_odds = 0) {
    pixels_.push_back(pixel);
    Label label;
    label.keep = keep;
    label.verdict = keep ? Verdict::kept : Verdict::dynamic;
    label.reason = keep ? Reason::consistent : Reason::inconsistent;
    label.log_odds = log_odds;
    labels_.push_back(label);
  }

  std::size_t apply() {
    Workspace workspace;
    const ImageView image(&pixel_, 80, 60, 80, PixelFormat::gray8);  // only its size is looked at
    return floor_.apply(pixels_, image, labels_, workspace);
  }

  std::set<std::size_t> rescued() const {
    std::set<std::size_t> result;
    for (std::size_t i = 0; i < labels_.size(); ++i)
      if (labels_[i].reason == Reason::keep_floor) result.insert(i);
    return result;
  }

  KeepFloor floor_;
  std::vector<Vector2f> pixels_;
  std::vector<Label> labels_;
  std::uint8_t pixel_ = 0;
};

// A host whose arrays have a fixed length fills them up with NaN.
TEST_F(KeepFloorTest, WhatIsNotInTheImageIsNoFeatureThatIsLeft) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vector2f& nowhere : {Vector2f(nan, nan), Vector2f(-1, 5), Vector2f(200, 5)}) {
    add(nowhere, true);
    add(nowhere, false, -1.0f);
  }
  add({30, 5}, false, 1.0f);
  add({50, 5}, false, 2.0f);
  floor_.options.fewest_features = 1;
  EXPECT_EQ(apply(), 1u);
  EXPECT_EQ(rescued(), std::set<std::size_t>{6});
}

TEST_F(KeepFloorTest, DoesNothingWhereEnoughIsKept) {
  for (int i = 0; i < 3; ++i) add({5, 5}, true);
  for (int i = 0; i < 5; ++i) add({70, 50}, false, 1.0f);
  floor_.options.fewest_features = 3;
  floor_.options.fewest_cells = 1;
  EXPECT_EQ(apply(), 0u);
  EXPECT_TRUE(rescued().empty());
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(labels_[i].keep, i < 3);
}

TEST_F(KeepFloorTest, KeepsTheLeastDynamicUntilEnoughAreKept) {
  add({5, 5}, true);
  for (const float log_odds : {5.0f, 1.0f, 3.0f, 0.5f, 4.0f}) add({5, 5}, false, log_odds);
  floor_.options.fewest_features = 4;
  EXPECT_EQ(apply(), 3u);
  EXPECT_EQ(rescued(), (std::set<std::size_t>{2, 3, 4})) << "0.5, 1 and 3";
  EXPECT_TRUE(labels_[4].keep);
  EXPECT_EQ(labels_[4].verdict, Verdict::dynamic) << "what was found stays found";
  EXPECT_EQ(labels_[4].reason, Reason::keep_floor);
  EXPECT_FALSE(labels_[1].keep);
  EXPECT_EQ(labels_[1].reason, Reason::inconsistent);
  EXPECT_EQ(labels_[0].reason, Reason::consistent);
}

TEST_F(KeepFloorTest, OfEquallyDynamicOnesTheFirstAreKept) {
  for (int i = 0; i < 6; ++i) add({5, 5}, false, 2.0f);
  floor_.options.fewest_features = 2;
  EXPECT_EQ(apply(), 2u);
  EXPECT_EQ(rescued(), (std::set<std::size_t>{0, 1}));
}

// Kept: cell (0, 0) only. Dropped: more of it, and one feature in each of three other cells. Two more cells are wanted:
// those of the least dynamic features there, although features of cell (0, 0) are less dynamic.
TEST_F(KeepFloorTest, SpreadsOverTheImageBeforeItCounts) {
  add({5, 5}, true);
  add({6, 6}, false, 0.1f);
  add({7, 7}, false, 0.2f);
  add({25, 5}, false, 3.0f);
  add({45, 25}, false, 1.0f);
  add({65, 45}, false, 2.0f);
  floor_.options.fewest_cells = 3;
  EXPECT_EQ(apply(), 2u);
  EXPECT_EQ(rescued(), (std::set<std::size_t>{4, 5}));
}

TEST_F(KeepFloorTest, CountAndSpreadTogether) {
  add({5, 5}, false, 0.1f);
  add({6, 6}, false, 0.2f);
  add({7, 7}, false, 0.3f);
  add({25, 5}, false, 3.0f);
  floor_.options.fewest_cells = 2;
  floor_.options.fewest_features = 3;
  EXPECT_EQ(apply(), 3u);
  EXPECT_EQ(rescued(), (std::set<std::size_t>{0, 1, 3})) << "two cells, then the least dynamic";
}

// Cells end at 20, 40, 60 across and 20, 40 down; what is outside is of no use to a tracker.
TEST_F(KeepFloorTest, CellsCoverTheImage) {
  add({19.9f, 19.9f}, true);
  add({20.0f, 19.9f}, false, 1.0f);    // another cell
  add({0.0f, 0.0f}, false, 0.5f);      // the same one
  add({-500.0f, -3.0f}, false, 0.1f);  // the least dynamic, outside
  floor_.options.fewest_cells = 2;
  EXPECT_EQ(apply(), 1u);
  EXPECT_EQ(rescued(), std::set<std::size_t>{1});
}

TEST_F(KeepFloorTest, ThereMayBeFewerThanWanted) {
  floor_.options.fewest_features = 30;
  floor_.options.fewest_cells = 3;
  EXPECT_EQ(apply(), 0u) << "no feature at all";
  add({5, 5}, false, 1.0f);
  add({6, 6}, false, 100.0f);
  EXPECT_EQ(apply(), 2u);
  EXPECT_EQ(rescued().size(), 2u);
}

TEST_F(KeepFloorTest, PixelsThatAreNoneAreNotRescued) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  add({kNaN, kNaN}, false, 1.0f);
  add({1e30f, -1e30f}, false, 2.0f);
  add({std::numeric_limits<float>::infinity(), 5}, true);
  floor_.options.fewest_features = 3;
  floor_.options.fewest_cells = 3;
  EXPECT_EQ(apply(), 0u);
}

// Over random cases: exactly as many as are needed, and no rescued feature more dynamic than one that was left out
// when only the count was short.
TEST_F(KeepFloorTest, KeepsNoMoreThanNeeded) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    pixels_.clear();
    labels_.clear();
    std::size_t kept = 0;
    for (std::size_t i = 0, count = random.index(60); i < count; ++i) {
      const bool keep = random.uniform() < 0.3;
      kept += keep;
      add({static_cast<float>(random.uniform(0, 79)), static_cast<float>(random.uniform(0, 59))}, keep,
          static_cast<float>(random.uniform(0, 6)));
    }
    floor_.options.fewest_features = random.index(40);
    const std::size_t possible = std::min(floor_.options.fewest_features, labels_.size());
    EXPECT_EQ(apply(), possible > kept ? possible - kept : 0u);
    float worst_rescued = -1e9f, best_dropped = 1e9f;
    for (const Label& label : labels_) {
      if (label.reason == Reason::keep_floor) worst_rescued = std::max(worst_rescued, label.log_odds);
      if (!label.keep) best_dropped = std::min(best_dropped, label.log_odds);
    }
    EXPECT_LE(worst_rescued, best_dropped);
  }
}

}  // namespace
}  // namespace stillpoint
