// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What is around a feature without depth, and what a missing depth says.

#include "stillpoint/cluster/depthless_features.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "stillpoint/core/workspace.hpp"

namespace stillpoint {
namespace {

// Weights (1 − d² / 25²)²: 1 at 0 px, 0.64² = 0.4096 at 15 px, none at 30 px.
TEST(Surroundings, NearOnesWeighMore) {
  const std::array<Vector2f, 3> pixels{{{100, 100}, {115, 100}, {130, 100}}};
  const std::array<float, 3> evidence{7.0f, -1.0f, 1000.0f};
  std::array<Label, 3> labels;
  labels[0].log_odds = 0.1f;
  labels[1].log_odds = 0.0f;
  labels[2].log_odds = 1.0f;
  Workspace workspace;
  const PixelGrid grid(pixels, 12.5f, workspace, [](std::size_t) { return true; });
  const Surroundings around = Surroundings::of({100, 100}, 25.0f, grid, evidence, labels);
  EXPECT_TRUE(around.any);
  EXPECT_NEAR(around.evidence, (7.0f - 0.4096f) / 1.4096f, 1e-5f);
  EXPECT_NEAR(around.dynamic_share, 1.0f / 1.4096f, 1e-5f) << "even odds do not move";
  const Surroundings none = Surroundings::of({300, 100}, 25.0f, grid, evidence, labels);
  EXPECT_FALSE(none.any);
  EXPECT_EQ(none.evidence, 0.0f);
  EXPECT_FALSE(Surroundings::of({std::numeric_limits<float>::quiet_NaN(), 0}, 25.0f, grid, evidence, labels).any);
}

DepthlessPrior counted(int static_with, int static_without, int dynamic_with, int dynamic_without) {
  DepthlessPrior prior;
  for (int i = 0; i < static_with; ++i) prior.add_with_depth(false);
  for (int i = 0; i < static_without; ++i) prior.add_without_depth({true, 0.0f, 0.0f});
  for (int i = 0; i < dynamic_with; ++i) prior.add_with_depth(true);
  for (int i = 0; i < dynamic_without; ++i) prior.add_without_depth({true, 0.0f, 1.0f});
  return prior;
}

TEST(DepthlessPrior, NothingCountedIsTheUsualRatio) {
  EXPECT_NEAR(DepthlessPrior().log_ratio(), -1.5f, 1e-5f);
  EXPECT_NEAR(counted(500, 100, 0, 0).log_ratio(), -1.5f, 1e-5f) << "nothing moves";
}

// Static: 98 of 196 without depth, with the one and two that are added 99 / 198 = ½. Dynamic: 20 of 80, and 20 features
// of the usual ratio, ½ e^−1 each: (20 + 20 · 0.18394) / (80 + 20) = 0.23679. 1.5 · log(0.23679 / 0.5) = −1.1211.
TEST(DepthlessPrior, IsTheRatioOfBothSharesToThePowerOfOneAndAHalf) {
  EXPECT_NEAR(counted(98, 98, 60, 20).log_ratio(), -1.1211f, 1e-3f);
}

TEST(DepthlessPrior, NeverSpeaksForMovingAndHasALeastValue) {
  EXPECT_EQ(counted(1000, 10, 100, 300).log_ratio(), 0.0f);
  EXPECT_EQ(counted(100, 900, 100000, 0).log_ratio(), -4.0f);
}

TEST(DepthlessPrior, WhatLiesBetweenBothOrAloneIsNotCounted) {
  DepthlessPrior prior = counted(98, 98, 60, 20);
  const float before = prior.log_ratio();
  for (int i = 0; i < 1000; ++i) prior.add_without_depth({true, 0.0f, 0.5f});
  for (int i = 0; i < 1000; ++i) prior.add_without_depth({});
  EXPECT_EQ(prior.log_ratio(), before);
}

}  // namespace
}  // namespace stillpoint
