// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/cluster/surface_clusters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::surface_clusters_test {
namespace {

static_assert(is_classifier<SurfaceClusters>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kRounding = 1e-4f;

/// Log-odds are 0.4 of a feature's own score and 0.6 of its population's mean, less the threshold of 1.
class SurfaceClustersTest : public testing::Test {
 protected:
  SurfaceClustersTest() {
    clusters_.options.features_per_cluster = 1000;
    clusters_.options.own_share = 0.4f;
    clusters_.options.dynamic_shift = 0.6f;
    clusters_.fewest_clusters = 1;
    clusters_.split_variance = 4.0f;
  }

  void add(const Vector2f& pixel, double depth_m, float score) {
    const std::size_t i = matches_.size();
    matches_.resize(i + 1);
    matches_.current.pixel[i] = pixel;
    matches_.current.depth_m[i] = depth_m;
    if (depth_m > 0) matches_.current.depth_sigma_m[i] = 0.004;
    scores_.emplace_back();
    scores_.back().value = score;
  }

  void classify() {
    Workspace workspace;
    regions_.locate(matches_.current.pixel);
    labels_.assign(matches_.size(), Label{});
    clusters_.classify(test::observations_of(matches_, regions_), {scores_, {1.0}}, labels_, workspace);
  }

  SurfaceClusters clusters_;
  Matches matches_;
  std::vector<FeatureScore> scores_;
  Regions regions_;
  std::vector<Label> labels_;
};

// Scores 0, 1 and 2 have the mean 1 and the variance ⅔, one population: 0.4 · own + 0.6 · 1 − 1.
TEST_F(SurfaceClustersTest, NeighboursShareTheirEvidence) {
  for (int i = 0; i < 9; ++i) add({100 + 5.0f * static_cast<float>(i), 100}, 2.0, static_cast<float>(i % 3));
  classify();
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(labels_[i].log_odds, 0.4f * static_cast<float>(i % 3) - 0.4f, kRounding);
    EXPECT_EQ(labels_[i].reason, Reason::consistent);
    EXPECT_EQ(labels_[i].cluster, 0);
  }
}

// A single score is held at 10 nats, a cluster hands on no more than 4.
TEST_F(SurfaceClustersTest, SingleScoresAreHeld) {
  for (const float score : {1000.0f, 1000.0f, 1000.0f}) add({100, 100}, 2.0, score);
  classify();
  for (const Label& label : labels_) EXPECT_NEAR(label.log_odds, 0.4f * 10.0f + 0.6f * 4.0f - 1.0f, kRounding);
}

// Six features score 0 and four score 8, mixed in one cluster: variance 0.24 · 64 = 15.4, all of it between the two.
// Each has the mean of its own population, 0 and 8, of which 4 are handed on: 0 − 1 and 0.4 · 8 + 0.6 · 4 − 1. A
// feature without a score gets the mean of both, 3.2.
TEST_F(SurfaceClustersTest, AClusterWithTwoPopulationsIsSplit) {
  for (int i = 0; i < 10; ++i) add({100 + 3.0f * static_cast<float>(i), 100}, 2.0, i % 5 < 3 ? 0.0f : 8.0f);
  add({115, 104}, 2.0, kNaN);
  classify();
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(labels_[i].log_odds, i % 5 < 3 ? -1.0f : 4.6f, kRounding) << i;
  EXPECT_NEAR(labels_[10].log_odds, 3.2f - 1.0f, kRounding);
  EXPECT_EQ(labels_[10].reason, Reason::neighbours);
}

// Two high ones among eight are no population of three: all share the mean, (8 · 0 + 2 · 8) / 10 = 1.6.
TEST_F(SurfaceClustersTest, AFewOutliersAreNoPopulation) {
  for (int i = 0; i < 10; ++i) add({100 + 3.0f * static_cast<float>(i), 100}, 2.0, i % 5 == 0 ? 8.0f : 0.0f);
  classify();
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(labels_[i].log_odds, 0.4f * (i % 5 == 0 ? 8.0f : 0.0f) + 0.6f * 1.6f - 1.0f, kRounding);
}

// 0, 1, …, 10 is spread evenly: the best cut explains 3/4 of its variance, less than the 0.8 that are asked for.
TEST_F(SurfaceClustersTest, AnEvenSpreadIsOnePopulation) {
  for (int i = 0; i <= 10; ++i) add({100 + 3.0f * static_cast<float>(i), 100}, 2.0, static_cast<float>(i));
  classify();
  for (std::size_t i = 0; i <= 10; ++i)
    EXPECT_NEAR(labels_[i].log_odds, 0.4f * static_cast<float>(i) + 0.6f * 4.0f - 1.0f, kRounding) << "of 5, 4 at most";
}

// A person at 1 m before a wall at 4 m: pixels interlock, depths do not.
TEST_F(SurfaceClustersTest, SurfacesAtDifferentDepthsAreDifferentClusters) {
  clusters_.fewest_clusters = 2;
  for (int i = 0; i < 20; ++i)
    add({100 + 2.0f * static_cast<float>(i), 100}, i % 2 == 0 ? 1.0 : 4.0, i % 2 == 0 ? 1.5f : 0.0f);
  classify();
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(labels_[i].cluster, labels_[i % 2].cluster);
    EXPECT_NEAR(labels_[i].log_odds, i % 2 == 0 ? 0.5f : -1.0f, kRounding);
  }
  EXPECT_NE(labels_[0].cluster, labels_[1].cluster);
}

// Two surfaces of depth 2 and 2.5 m side by side: for a sensor of 4 mm they are two clusters, 0.5 / (0.04 + 3 · 0.004)
// = 9.6 units apart and 20 px / 40 px wide; for one of 0.4 m all noise is 0.5 / 1.24 = 0.4 units, less than the width.
TEST_F(SurfaceClustersTest, DepthSeparatesInUnitsOfItsNoise) {
  clusters_.fewest_clusters = 2;
  for (int i = 0; i < 40; ++i) add({100 + 2.0f * static_cast<float>(i), 100}, i % 2 == 0 ? 2.0 : 2.5, 0.0f);
  const auto split_by_depth = [this](double sigma_m) {
    for (double& sigma : matches_.current.depth_sigma_m) sigma = sigma_m;
    classify();
    for (std::size_t i = 2; i < 40; ++i)
      if (labels_[i].cluster != labels_[i % 2].cluster) return false;
    return labels_[0].cluster != labels_[1].cluster;
  };
  EXPECT_TRUE(split_by_depth(0.004));
  EXPECT_FALSE(split_by_depth(0.4));
}

// Between 2 and 71 m lie a thousand units of a laser's noise: a person in a box and a wall far behind are two clusters.
TEST_F(SurfaceClustersTest, RegionsShareNoClusterHoweverFarTheDepthReaches) {
  clusters_.fewest_clusters = 4;
  for (int i = 0; i < 200; ++i) add({100, 100}, i % 2 == 0 ? 2.0 : 40.0 + 0.4 * i, i % 2 == 0 ? 3.0f : 0.0f);
  regions_.detections = {{{90, 90, 20, 20}, Mobility::dynamic, 1.0f, 1.5, 2.5}};
  Workspace workspace;
  regions_.locate(matches_.current.pixel, matches_.current.depth_m);
  labels_.assign(matches_.size(), Label{});
  clusters_.classify(test::observations_of(matches_, regions_), {scores_, {1.0}}, labels_, workspace);
  for (std::size_t i = 1; i < 200; i += 2) EXPECT_NE(labels_[i].cluster, labels_[0].cluster) << i;
}

TEST_F(SurfaceClustersTest, ThereAreAtLeastTheFewestClusters) {
  clusters_.fewest_clusters = 4;
  for (int i = 0; i < 40; ++i) add({8.0f * static_cast<float>(i), 100}, 2.0, 0.0f);
  classify();
  std::set<int> found;
  for (const Label& label : labels_) found.insert(label.cluster);
  EXPECT_EQ(found, (std::set<int>{0, 1, 2, 3}));
  clusters_.options.features_per_cluster = 5;
  classify();
  found.clear();
  for (const Label& label : labels_) found.insert(label.cluster);
  EXPECT_EQ(found.size(), 8u) << "40 / 5";
}

TEST_F(SurfaceClustersTest, FewerFeaturesThanClustersAreOneCluster) {
  clusters_.fewest_clusters = 5;
  add({100, 100}, 2.0, 3.0f);
  classify();
  EXPECT_NEAR(labels_[0].log_odds, 3.0f - 1.0f, kRounding);
}

TEST_F(SurfaceClustersTest, ThePriorShiftsTheOddsOnce) {
  regions_.detections = {{{0, 0, 50, 50}, Mobility::dynamic, 1.0f},
                         {{100, 0, 50, 50}, Mobility::movable, 1.0f},
                         {{200, 0, 50, 50}, Mobility::fixed, 1.0f},
                         {{300, 0, 50, 50}, Mobility::unknown, 1.0f}};
  for (const float u : {25.0f, 125.0f, 225.0f, 325.0f}) add({u, 25}, 2.0, 0.0f);
  for (const float u : {25.0f, 125.0f, 225.0f, 325.0f}) add({u, 30}, 0.0, kNaN);
  classify();
  const float shift[] = {0.6f, 0.2f, -0.3f, -0.6f};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(labels_[i].log_odds, -1.0f + shift[i], kRounding) << i;
    EXPECT_NEAR(labels_[4 + i].log_odds, i < 3 ? -0.7f : -1.3f, kRounding)
        << "without a depth it may lie beside the thing in the box; in none of the kinds it is outside";
  }
}

// Where a detector has found a person, the rest is rather static; where it has found chairs only, that says nothing.
TEST_F(SurfaceClustersTest, OutsideOfDynamicRegionsThingsRatherStand) {
  for (int i = 0; i < 4; ++i) add({300 + 5.0f * static_cast<float>(i), 100}, 2.0, 0.0f);
  add({300, 100}, 0.0, kNaN);  // its neighbours say (0 − 1) · 0.7
  regions_.detections = {{{0, 0, 50, 50}, Mobility::movable, 1.0f}};
  classify();
  EXPECT_NEAR(labels_[0].log_odds, -1.0f, kRounding);
  EXPECT_NEAR(labels_[4].log_odds, -0.7f, kRounding);
  regions_.detections.push_back({{100, 0, 50, 50}, Mobility::dynamic, 1.0f});
  classify();
  EXPECT_NEAR(labels_[0].log_odds, -1.6f, kRounding);
  EXPECT_NEAR(labels_[4].log_odds, -1.3f, kRounding) << "outside of every box it is outside, whatever its depth";
}

// Neighbours say (0 − 1) · 0.7 = −0.7. With a score of 5 of its own: 0.4 · (5 − 1) + 0.4 · (−1) = 1.2, and 1.5 less,
// since nobody has seen yet that depth is missing on what moves (DepthlessPrior).
TEST_F(SurfaceClustersTest, AFeatureWithoutAnyDepthAnswersForItselfToo) {
  for (int i = 0; i < 6; ++i) add({100, 100}, 2.0, 0.0f);
  add({100, 100}, 0.0, kNaN);
  add({100, 100}, 0.0, 5.0f);
  classify();
  EXPECT_NEAR(labels_[6].log_odds, -0.7f, kRounding);
  EXPECT_EQ(labels_[6].reason, Reason::no_depth);
  EXPECT_NEAR(labels_[7].log_odds, -0.3f, kRounding);
  EXPECT_EQ(labels_[7].reason, Reason::consistent);
}

// A depth that an older frame measured makes a feature a member of its surface's cluster: scores 0, 0, 1.5 have the
// mean 0.5, 0.4 · 1.5 + 0.6 · 0.5 − 1 = −0.1. A guess between two surfaces asks what is around it: 0.4 · (1.5 − 1) +
// 0.4 · (0.5 − 1) = 0. Both are 1.5 less, as depth is seldom missing on what moves.
TEST_F(SurfaceClustersTest, AFeatureWithABorrowedDepthIsOneOfItsSurface) {
  for (int i = 0; i < 2; ++i) add({100, 100}, 2.0, 0.0f);
  add({100, 100}, 0.0, 1.5f);
  matches_.past_observations.add(matches_.size());
  matches_.past_observations.point[2] = {0, 0, 2};
  for (const auto& [spread, log_odds] : {std::pair(0.01, -0.1f), std::pair(0.1, 0.0f)}) {
    matches_.past_observations.inverse_depth_sigma[2] = spread / 2.0;
    classify();
    EXPECT_NEAR(labels_[2].log_odds, log_odds - 1.5f, kRounding) << spread;
    EXPECT_EQ(labels_[2].cluster, labels_[0].cluster);
  }
}

// The same feature beside 60 others that move, half of them without depth, as in depth images with holes: nobody is
// less dynamic for a depth that is missing everywhere.
TEST_F(SurfaceClustersTest, MissingDepthSaysNothingWhereMoversMissItToo) {
  for (int i = 0; i < 30; ++i) add({100, 100}, 2.0, 8.0f);
  for (int i = 0; i < 30; ++i) add({100, 100}, 0.0, kNaN);
  for (int i = 0; i < 30; ++i) add({400, 100}, 2.0, 0.0f);
  for (int i = 0; i < 30; ++i) add({400, 100}, 0.0, kNaN);
  clusters_.options.features_per_cluster = 30;
  add({100, 100}, 0.0, 6.0f);
  classify();
  EXPECT_GT(labels_[120].log_odds, 0.4f * 5.0f + 0.4f * 7.0f - 0.5f);
  for (std::size_t i = 30; i < 60; ++i) matches_.state[i] = MatchState::outside;  // its depth is complete now
  classify();
  EXPECT_LT(labels_[120].log_odds, 0.4f * 5.0f + 0.4f * 7.0f - 1.5f);
}

// Weights (1 − d² / 25²)²: neighbours at 0 and at 15 px (0.64² = 0.4096) with log-odds of their clusters 7 and −1.
TEST_F(SurfaceClustersTest, FeaturesWithoutDepthAskTheirNeighbours) {
  for (int i = 0; i < 3; ++i) add({100, 100}, 1.0, 8.0f);
  for (int i = 0; i < 3; ++i) add({115, 100}, 1.0, 0.0f);
  add({100, 100}, 0.0, kNaN);
  add({300, 100}, 0.0, kNaN);
  classify();
  EXPECT_NEAR(labels_[6].log_odds, 0.7f * (7.0f - 0.4096f) / 1.4096f, kRounding);
  EXPECT_EQ(labels_[6].reason, Reason::no_depth);
  EXPECT_EQ(labels_[6].cluster, Label::kNoCluster);
  EXPECT_EQ(labels_[7].log_odds, -1.0f) << "nobody there";
}

// 25 px of 640 are 50 of 1280: one at 40 px is a neighbour there, and none here.
TEST_F(SurfaceClustersTest, ItsReachIsThatOfAWideImage) {
  for (int i = 0; i < 3; ++i) add({140, 100}, 1.0, 8.0f);
  add({100, 100}, 0.0, kNaN);
  classify();
  EXPECT_EQ(labels_[3].log_odds, -1.0f) << "nobody there";
  matches_.pixel_scale = 2.0f;
  classify();
  EXPECT_NEAR(labels_[3].log_odds, 0.7f * 7.0f, kRounding);
}

TEST_F(SurfaceClustersTest, WhatIsOutsideOrNowhereIsAnsweredToo) {
  add({kNaN, kNaN}, 0.0, kNaN);
  add({1e30f, -1e30f}, 0.0, kNaN);
  matches_.state[0] = matches_.state[1] = MatchState::outside;
  classify();
  for (const Label& label : labels_) {
    EXPECT_EQ(label.log_odds, -1.0f);
    EXPECT_EQ(label.reason, Reason::outside_image);
  }
  for (int i = 0; i < 5; ++i) add({100, 100}, 2.0, kNaN);
  classify();
  EXPECT_EQ(labels_[4].log_odds, -1.0f) << "a cluster without a single score knows nothing";
  matches_.resize(0);
  scores_.clear();
  classify();
}

TEST_F(SurfaceClustersTest, EqualFramesGiveEqualClusters) {
  clusters_.options.features_per_cluster = 10;
  Random random(1);
  for (int i = 0; i < 200; ++i)
    add({static_cast<float>(random.uniform(0, 640)), static_cast<float>(random.uniform(0, 480))},
        random.uniform(0.5, 5.0), static_cast<float>(random.uniform(-3, 12)));
  classify();
  const std::vector<Label> first = labels_;
  classify();
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].cluster, labels_[i].cluster);
    EXPECT_EQ(first[i].log_odds, labels_[i].log_odds);
  }
}

}  // namespace
}  // namespace stillpoint::surface_clusters_test
