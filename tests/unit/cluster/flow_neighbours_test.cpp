// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/cluster/flow_neighbours.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint {
namespace {

static_assert(is_classifier<FlowNeighbours>::value);

/// Features with a step and a score, judged at a level of 1 nat with half of what counts their own.
class FlowNeighboursTest : public testing::Test {
 protected:
  FlowNeighboursTest() {
    FlowNeighbours::Options& options = classifier.options;
    options.reach_px = 30.0f;
    options.same_flow_px = 1.5f;
    options.same_flow_share = 0.1f;
    options.own_share = 0.5f;
    options.lowest = -0.5f;
    options.alone = -1.0f;
    options.dynamic_shift = 2.0f;
    options.movable_shift = 0.25f;
    options.fixed_shift = -0.75f;
    options.outside_shift = -4.0f;
  }

  std::size_t add(const Vector2f& at, const Vector2f& step, float score) {
    const std::size_t i = matches.size();
    matches.resize(i + 1);
    matches.state[i] = MatchState::matched;
    matches.current.pixel[i] = at;
    matches.reference.pixel[i] = at - step;
    scores.push_back({score});
    regions.of_feature.emplace_back();
    regions.of_feature.back().in_dynamic = true;
    return i;
  }
  Label label_of(std::size_t i) {
    std::vector<Label> labels(matches.size());
    classifier.classify(test::observations_of(matches, regions), {scores, {1.0}}, labels, workspace);
    return labels[i];
  }

  FlowNeighbours classifier;
  Matches matches;
  std::vector<FeatureScore> scores;
  Regions regions;
  Workspace workspace;
};

// Alone: its score 3, less 1, and 2 for the region.
TEST_F(FlowNeighboursTest, FeatureAloneSpeaksForItself) {
  const Label label = label_of(add({100, 100}, {5, 0}, 3.0f));
  EXPECT_FLOAT_EQ(label.log_odds, 4.0f);
  EXPECT_EQ(label.reason, Reason::consistent);
}

// Neighbours at 10 and 20 px weigh 1 − 1/9 and 1 − 4/9: (8/9 · 6 + 5/9 · 2) / (13/9) = 58/13. Half of 3 and of that,
// less 1, and 2.
TEST_F(FlowNeighboursTest, NeighboursThatGoTheSameWayShareTheirEvidence) {
  const std::size_t i = add({100, 100}, {5, 0}, 3.0f);
  add({110, 100}, {5, 1}, 6.0f);
  add({100, 120}, {6, 0}, 2.0f);
  EXPECT_NEAR(label_of(i).log_odds, 0.5 * 3 + 0.5 * 58.0 / 13.0 + 1, 1e-5);
}

// 1.5 px and a tenth of 5: a step that is 2 px off is the same, one of 2.1 px is not.
TEST_F(FlowNeighboursTest, WhatGoesAnotherWayOrIsFarSaysNothing) {
  const std::size_t i = add({100, 100}, {5, 0}, 3.0f);
  add({105, 100}, {5, 2.1f}, 8.0f);
  add({100, 131}, {5, 0}, 8.0f);
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 4.0f);
  add({105, 100}, {5, 2.0f}, 7.0f);
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 0.5f * 3 + 0.5f * 7 + 1);
}

TEST_F(FlowNeighboursTest, SingleScoreIsHeldFromBelow) {
  EXPECT_FLOAT_EQ(label_of(add({100, 100}, {5, 0}, -7.0f)).log_odds, -0.5f - 1 + 2);
}

TEST_F(FlowNeighboursTest, FeatureWithoutAMatchTakesItsNeighbours) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::size_t i = add({100, 100}, {kNaN, kNaN}, kNaN);
  matches.state[i] = MatchState::lost;
  EXPECT_FLOAT_EQ(label_of(i).log_odds, -1.0f);
  EXPECT_EQ(label_of(i).reason, Reason::no_match);
  add({110, 100}, {50, 0}, 6.0f);
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 6.0f - 1 + 2);
  EXPECT_EQ(label_of(i).reason, Reason::neighbours);
}

TEST_F(FlowNeighboursTest, RegionsShiftTheOdds) {
  const std::size_t i = add({100, 100}, {5, 0}, 3.0f);
  Membership& region = regions.of_feature[i];
  region.in_movable = true;
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 4.0f) << "dynamic goes first";
  region.in_dynamic = false;
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 2.25f);
  region.in_movable = false;
  region.in_fixed = true;
  EXPECT_FLOAT_EQ(label_of(i).log_odds, 1.25f);
  region.in_fixed = false;
  EXPECT_FLOAT_EQ(label_of(i).log_odds, -2.0f) << "in none";
}

}  // namespace
}  // namespace stillpoint
