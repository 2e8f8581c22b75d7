// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/gate/mean_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint::mean_gate_test {
namespace {

static_assert(is_gate<MeanGate>::value);
struct Mute {};
static_assert(!is_gate<Mute>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kRounding = 1e-6;  // scores are floats

double level(const std::vector<float>& values, const std::vector<bool>& in_dynamic = {}, const MeanGate& gate = {}) {
  std::vector<FeatureScore> scores(values.size());
  Regions regions;
  regions.of_feature.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    scores[i].value = values[i];
    regions.of_feature[i].in_dynamic = i < in_dynamic.size() && in_dynamic[i];
  }
  Workspace workspace;
  return gate.threshold(scores, regions, workspace).level;
}

TEST(MeanGate, IsTheMeanWhereNothingIsAnOutlier) {
  // Median 2, deviations 1 0 1, MAD 1, limit 2 + 3 · 1.4826: all three stay. φ = 2.
  EXPECT_NEAR(level({1, 2, 3}), 2.0, kRounding);
  // Lower median of 1 2 4 5: 2. Deviations 1 0 2 3, lower median 1, limit 6.4478. φ = 12 / 4.
  EXPECT_NEAR(level({5, 1, 4, 2}), 3.0, kRounding);
}

TEST(MeanGate, LeavesOutliersOutByHand) {
  // Median 3, deviations 2 1 0 1 97, MAD 1, limit 3 + 4.4478 = 7.4478: 100 is out. φ = 10 / 4.
  EXPECT_NEAR(level({1, 2, 3, 4, 100}), 2.5, kRounding);
  // 7.4 stays, 7.5 does not.
  EXPECT_NEAR(level({1, 2, 3, 4, 7.4f}), 17.4 / 5, kRounding);
  EXPECT_NEAR(level({1, 2, 3, 4, 7.5f}), 2.5, kRounding);
  // Only high scores are outliers: the median of -90 2 3 4 5 is 3, MAD 1, and −90 stays.
  EXPECT_NEAR(level({-90, 2, 3, 4, 5}), -76.0 / 5, kRounding);
  MeanGate loose;
  loose.options.outlier_sigmas = 100.0;
  EXPECT_NEAR(level({1, 2, 3, 4, 100}, {}, loose), 22.0, kRounding);
}

TEST(MeanGate, AsksOnlyScoredFeaturesOutsideDynamicBoxes) {
  EXPECT_NEAR(level({1, 50, 2, kNaN, 3, 60}, {false, true, false, false, false, true}), 2.0, kRounding);
}

TEST(MeanGate, NothingIsDynamicWhereNothingIsKnown) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(level({}), infinity);
  EXPECT_EQ(level({kNaN, kNaN}), infinity);
  EXPECT_EQ(level({1, 2}, {true, true}), infinity);
}

TEST(MeanGate, EqualScoresAndSingleOnesAreTheirOwnMean) {
  EXPECT_NEAR(level({0.25f}), 0.25, kRounding);
  EXPECT_NEAR(level({0.1f, 0.1f, 0.1f}), 0.1, kRounding);
  EXPECT_EQ(level({0, 0, 0, 0}), 0.0);
  // More than half alike: MAD 0, so that everything above is an outlier.
  EXPECT_NEAR(level({1, 1, 1, 5}), 1.0, kRounding);
}

TEST(MeanGate, AgreesWithSortingOnRandomScores) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    std::vector<float> values(1 + random.index(80));
    for (float& value : values) value = static_cast<float>(std::pow(random.uniform(), 4.0));  // long tail
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[(sorted.size() - 1) / 2];
    std::vector<double> deviations;
    for (const double value : sorted) deviations.push_back(std::abs(value - median));
    std::sort(deviations.begin(), deviations.end());
    const double limit = median + 3 * 1.4826 * deviations[(deviations.size() - 1) / 2];
    double sum = 0, count = 0;
    for (const double value : sorted)
      if (value <= limit) sum += value, ++count;
    EXPECT_NEAR(level(values), sum / count, 1e-12) << "seed " << seed;
  }
}

TEST(MeanGate, GivesItsScratchBack) {
  std::vector<FeatureScore> scores(100);
  for (FeatureScore& score : scores) score.value = 1.0f;
  Regions regions;
  regions.of_feature.resize(100);
  Workspace workspace;
  const int* const before = workspace.take<int>(1).data();
  MeanGate{}.threshold(scores, regions, workspace);
  EXPECT_EQ(workspace.take<int>(1).data(), before + 16) << "64 bytes further";
}

}  // namespace
}  // namespace stillpoint::mean_gate_test
