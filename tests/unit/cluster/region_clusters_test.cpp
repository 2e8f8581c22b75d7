// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/cluster/region_clusters.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::region_clusters_test {
namespace {

static_assert(is_classifier<RegionClusters>::value);
struct Mute {};
static_assert(!is_classifier<Mute>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Features with 3D points, scores and a place inside or outside dynamic boxes, and the classifier's labels of them.
struct Scene {
  Matches matches;
  std::vector<FeatureScore> scores;
  Regions regions;
  RegionClusters classifier;
  std::vector<Label> labels;

  std::size_t add(const Vector3d& point, float score, bool inside, MatchState state = MatchState::matched) {
    const std::size_t i = matches.size();
    matches.resize(i + 1);
    matches.state[i] = state;
    matches.current.point[i] = point;
    scores.emplace_back();
    scores[i].value = score;
    regions.of_feature.emplace_back();
    regions.of_feature[i].in_dynamic = inside;
    return i;
  }

  const std::vector<Label>& classify(double level) {
    labels.assign(matches.size(), Label{});
    Workspace workspace;
    classifier.classify(test::observations_of(matches, regions), {scores, {level}}, span<Label>(labels), workspace);
    return labels;
  }

  std::size_t cluster_count() const {
    std::set<std::int32_t> clusters;
    for (const Label& label : labels)
      if (label.cluster != Label::kNoCluster) clusters.insert(label.cluster);
    return clusters.size();
  }
};

// Eq. 12: k = ⌊m / 10⌋, and fewer than 10 points are each their own cluster.
TEST(RegionClusters, NumberOfClustersIsThePapers) {
  struct Case {
    int m;
    std::size_t k;
  };
  for (const Case c : {Case{1, 1}, {2, 2}, {9, 9}, {10, 1}, {11, 1}, {19, 1}, {20, 2}, {29, 2}, {30, 3}, {105, 10}}) {
    Scene scene;
    for (int i = 0; i < c.m; ++i) scene.add({0.1 * i, 0.01 * i * i, 2.0}, 0.1f, true);
    scene.classify(1.0);
    EXPECT_EQ(scene.cluster_count(), c.k) << "m = " << c.m;
  }
}

TEST(RegionClusters, BelowTenEachIsJudgedByItsOwnScore) {
  Scene scene;
  for (int i = 0; i < 9; ++i) scene.add({0.1 * i, 0, 2}, i == 4 ? 0.6f : 0.1f, true);
  const std::vector<Label>& labels = scene.classify(0.5);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(labels[i].keep, i != 4);
    EXPECT_EQ(labels[i].verdict, i != 4 ? Verdict::kept : Verdict::dynamic);
    EXPECT_EQ(labels[i].reason, i != 4 ? Reason::static_cluster : Reason::moving_cluster);
  }
}

// Two objects, 10 features each. Left: τ = (9 · 0.1 + 1.3) / 10 = 0.22; right: τ = (5 · 0.1 + 5 · 0.4) / 10 = 0.25
// (Eq. 13). With φ = 0.235 all of the right one is dynamic, even its features with a low score, and all of the left one
// is kept, even its feature with the highest score of all (Eq. 14).
TEST(RegionClusters, TheMeanOfAClusterJudgesAllOfIt) {
  Scene scene;
  for (int i = 0; i < 10; ++i) {
    scene.add({-1.0 + 0.01 * i, 0, 2}, i == 0 ? 1.3f : 0.1f, true);
    scene.add({1.0 + 0.01 * i, 0, 2}, i % 2 == 0 ? 0.1f : 0.4f, true);
  }
  const std::vector<Label>& labels = scene.classify(0.235);
  ASSERT_EQ(scene.cluster_count(), 2u);
  for (std::size_t i = 0; i < 20; ++i) {
    const bool right = i % 2 == 1;
    EXPECT_EQ(labels[i].keep, !right) << i;
    EXPECT_EQ(labels[i].verdict, right ? Verdict::dynamic : Verdict::kept);
    EXPECT_EQ(labels[i].cluster, labels[right ? 1 : 0].cluster);
  }
  for (const Label& label : scene.classify(0.26)) EXPECT_TRUE(label.keep) << "both means are below 0.26";
  for (const Label& label : scene.classify(0.21)) EXPECT_FALSE(label.keep) << "both means are above 0.21";
}

TEST(RegionClusters, AMeanEqualToTheThresholdIsStatic) {
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.add({0.1 * i, 0, 2}, 0.5f, true);
  for (const Label& label : scene.classify(0.5)) EXPECT_TRUE(label.keep);
}

TEST(RegionClusters, WithoutAThresholdNothingIsDynamic) {
  Scene scene;
  for (int i = 0; i < 30; ++i) scene.add({0.1 * i, 0, 2}, 1e6f, true);
  for (const Label& label : scene.classify(Threshold{}.level)) EXPECT_TRUE(label.keep);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Label& label : scene.classify(nan)) EXPECT_TRUE(label.keep) << "fail open";
}

TEST(RegionClusters, OutsideDynamicBoxesEverythingIsKept) {
  Scene scene;
  const std::size_t scored = scene.add({0, 0, 2}, 1e6f, false);
  const std::size_t lost = scene.add({0, 0, 2}, kNaN, false, MatchState::lost);
  const std::vector<Label>& labels = scene.classify(0.1);
  EXPECT_TRUE(labels[scored].keep && labels[lost].keep);
  EXPECT_EQ(labels[scored].verdict, Verdict::kept);
  EXPECT_EQ(labels[scored].reason, Reason::outside_regions);
  EXPECT_EQ(labels[scored].cluster, Label::kNoCluster);
  EXPECT_EQ(labels[lost].verdict, Verdict::unknown);
}

// A feature without a score is unknown: kept outside dynamic boxes, dropped inside, and it says why.
TEST(RegionClusters, UnknownFeaturesFollowTheirPlace) {
  struct Case {
    MatchState state;
    Reason reason;
  };
  for (const Case c :
       {Case{MatchState::lost, Reason::no_match}, Case{MatchState::matched, Reason::no_depth},
        Case{MatchState::near_edge, Reason::no_depth}, Case{MatchState::outside, Reason::outside_image}}) {
    for (const bool inside : {false, true}) {
      Scene scene;
      const std::size_t i =
          scene.add(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), kNaN, inside, c.state);
      const Label& label = scene.classify(0.1)[i];
      EXPECT_EQ(label.verdict, Verdict::unknown);
      EXPECT_EQ(label.reason, c.reason);
      EXPECT_EQ(label.keep, !inside);
      EXPECT_EQ(label.cluster, Label::kNoCluster);
    }
  }
}

TEST(RegionClusters, UnknownFeaturesTakeNoPartInClusters) {
  Scene scene;
  for (int i = 0; i < 19; ++i) {
    scene.add({0.1 * i, 0, 2}, 0.1f, true);
    scene.add({5.0, 0, 2}, kNaN, true, MatchState::lost);  // would make m = 38, k = 3
    scene.add({9.0, 0, 2}, 0.1f, false);
  }
  scene.classify(1.0);
  EXPECT_EQ(scene.cluster_count(), 1u);
}

TEST(RegionClusters, EqualSeedsGiveEqualLabels) {
  Scene scene;
  Random random(3);
  for (int i = 0; i < 200; ++i)
    scene.add({random.gaussian(), random.gaussian(), 3 + random.gaussian()}, static_cast<float>(random.uniform()),
              true);
  const std::vector<Label> first = scene.classify(0.5);
  const std::vector<Label>& second = scene.classify(0.5);
  bool another_seed_differs = false;
  std::vector<std::int32_t> clusters;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].cluster, second[i].cluster);
    EXPECT_EQ(first[i].keep, second[i].keep);
    clusters.push_back(first[i].cluster);
  }
  scene.classifier.options.seed = 1;
  scene.classify(0.5);
  for (std::size_t i = 0; i < first.size(); ++i)
    another_seed_differs = another_seed_differs || scene.labels[i].cluster != clusters[i];
  EXPECT_TRUE(another_seed_differs) << "the seed is an option";
}

TEST(RegionClusters, SillyOptionsDoNotCrash) {
  Scene scene;
  for (int i = 0; i < 25; ++i) scene.add({0.1 * i, 0, 2}, i < 5 ? 0.9f : 0.1f, true);
  scene.classifier.options.features_per_cluster = 0;  // as 1: each feature by itself
  scene.classify(0.5);
  EXPECT_EQ(scene.cluster_count(), 25u);
  for (std::size_t i = 0; i < 25; ++i) EXPECT_EQ(scene.labels[i].keep, i >= 5);
  scene.classifier.options = {};
  scene.classifier.options.max_iterations = 0;
  scene.classify(0.5);
  EXPECT_EQ(scene.cluster_count(), 2u);
}

TEST(RegionClusters, NoFeaturesAreFine) {
  Scene scene;
  EXPECT_TRUE(scene.classify(0.5).empty());
}

}  // namespace
}  // namespace stillpoint::region_clusters_test
