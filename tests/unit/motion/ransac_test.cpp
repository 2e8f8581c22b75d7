// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/ransac.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

namespace stillpoint {
namespace {

/// The value that most numbers share: a sample is one number.
struct MockEstimator {
  using Model = double;
  static constexpr std::size_t kSampleSize = 1;
  static constexpr std::size_t kMaxModels = 2;
  std::vector<double> data;
  mutable std::size_t solved = 0;

  std::size_t size() const { return data.size(); }
  std::size_t solve(span<const std::size_t> sample, span<Model> models) const {
    ++solved;
    if (data[sample[0]] < 0) return 0;  // a negative number is degenerate
    models[0] = data[sample[0]];
    models[1] = data[sample[0]] + 1000.0;
    return 2;
  }
  float squared_residual(const Model& model, std::size_t i) const {
    return static_cast<float>((data[i] - model) * (data[i] - model));
  }
};
struct RefiningEstimator : MockEstimator {
  bool refine(span<const std::uint32_t> inliers, Model& model) const {
    model = 0;
    for (const std::uint32_t i : inliers) model += data[i] / static_cast<double>(inliers.size());
    return true;
  }
};
static_assert(is_ransac_estimator<MockEstimator>::value && !has_refinement<MockEstimator>::value);
static_assert(has_refinement<RefiningEstimator>::value && !is_ransac_estimator<int>::value);

TEST(Ransac, RequiredTrialsAreThoseOfTheTable) {
  // ceil(log(0.01) / log(1 - w^m)): Hartley and Zisserman, 2nd ed., table 4.3 (confidence 0.99).
  const std::size_t table[][3] = {{2, 50, 17}, {3, 50, 35},  {7, 50, 588}, {8, 50, 1177},
                                  {7, 70, 54}, {8, 60, 272}, {4, 95, 3}};
  for (const auto& [sample, percent, trials] : table)
    EXPECT_EQ(required_trials(static_cast<double>(percent) / 100.0, sample, 0.99, 100000), trials);
  EXPECT_EQ(required_trials(1.0, 7, 0.99, 1000), 1u);
  EXPECT_EQ(required_trials(0.0, 7, 0.99, 1000), 1000u);
  EXPECT_EQ(required_trials(0.5, 7, 1.0, 1000), 1000u);
  EXPECT_EQ(required_trials(std::numeric_limits<double>::quiet_NaN(), 7, 0.99, 1000), 1000u);
  EXPECT_EQ(required_trials(1.0, 7, 0.99, 0), 0u);
}

TEST(Ransac, ReportBelongsToTheModel) {
  MockEstimator estimator;
  for (int i = 0; i < 60; ++i) estimator.data.push_back(i % 3 == 0 ? 50.0 + i : 7.0);
  estimator.data[1] = std::numeric_limits<double>::quiet_NaN();
  Workspace workspace;
  const auto report = ransac(estimator, RansacOptions(0.5), workspace);
  ASSERT_TRUE(report.success);
  EXPECT_EQ(report.model, 7.0);
  EXPECT_EQ(report.inliers, 39u);  // 40 sevens, one of them replaced by NaN
  EXPECT_EQ(report.support, 39.0);
  EXPECT_EQ(report.trials, estimator.solved);
  ASSERT_EQ(report.inlier.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(report.inlier[i] != 0, estimator.data[i] == 7.0);
}

TEST(Ransac, DegenerateSamplesAreCountedAndSkipped) {
  MockEstimator estimator;
  estimator.data.assign(20, -1.0);
  Workspace workspace;
  RansacOptions options(0.5);
  options.max_trials = 30;
  const auto report = ransac(estimator, options, workspace);
  EXPECT_FALSE(report.success);
  EXPECT_EQ(report.trials, 30u);
  EXPECT_EQ(report.degenerate, 30u);
  EXPECT_EQ(report.inliers, 0u);
  estimator.data.clear();
  const auto empty = ransac(estimator, options, workspace);
  EXPECT_FALSE(empty.success);
  EXPECT_EQ(empty.trials, 0u);
}

TEST(Ransac, TrialsKeepToTheirBounds) {
  MockEstimator estimator;
  estimator.data.assign(50, 3.0);
  Workspace workspace;
  RansacOptions options(0.5);
  options.early_rejection = false;
  EXPECT_EQ(ransac(estimator, options, workspace).trials, 1u);
  options.min_trials = 25;
  EXPECT_EQ(ransac(estimator, options, workspace).trials, 25u);
  options.max_trials = 10;
  EXPECT_EQ(ransac(estimator, options, workspace).trials, 10u);
}

TEST(Ransac, NeitherNanNorZeroThresholdHasInliersThatAreNone) {
  MockEstimator estimator;
  estimator.data = {1, 2, 3, 4, 5, 6, 7, 8};
  Workspace workspace;
  EXPECT_FALSE(ransac(estimator, RansacOptions(std::numeric_limits<double>::quiet_NaN()), workspace).success);
  EXPECT_FALSE(ransac(estimator, RansacOptions(0.0), workspace).success);
}

TEST(Ransac, RefinementRaisesTheSupport) {
  RefiningEstimator estimator;
  Random random(1);
  for (int i = 0; i < 200; ++i)
    estimator.data.push_back(i < 120 ? 10.0 + 0.3 * random.gaussian() : random.uniform(0, 100));
  shuffle(span<double>(estimator.data), random);
  Workspace workspace;
  RansacOptions options(1.0);
  options.max_trials = 20;
  const auto refined = ransac(estimator, options, workspace);
  const auto plain = ransac(static_cast<const MockEstimator&>(estimator), options, workspace);
  EXPECT_GT(refined.support, plain.support);
  EXPECT_NEAR(refined.model, 10.0, 0.1);  // 0.3 / sqrt(120) is 0.03
}

TEST(Ransac, AnotherSeedDrawsOtherSamples) {
  MockEstimator estimator;
  for (int i = 0; i < 100; ++i) estimator.data.push_back(10.0 * i);
  Workspace workspace;
  RansacOptions options(0.5);
  options.max_trials = 1;  // the model is what was drawn
  std::set<double> models;
  for (options.seed = 0; options.seed < 20; ++options.seed)
    models.insert(ransac<InlierCountSupport>(estimator, options, workspace).model);
  EXPECT_GT(models.size(), 10u);
}

TEST(Ransac, EarlyRejectionFindsTheSameModelAndEqualSeedsTheSameReport) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    MockEstimator estimator;
    for (int i = 0; i < 300; ++i) estimator.data.push_back(i < 150 ? 10.0 : random.uniform(20, 1000));
    shuffle(span<double>(estimator.data), random);
    Workspace workspace;
    RansacOptions options(0.5);
    options.confidence = 0.9999;
    const auto a = ransac<InlierCountSupport>(estimator, options, workspace);
    const auto b = ransac<InlierCountSupport>(estimator, options, workspace);
    options.early_rejection = false;
    const auto full = ransac<InlierCountSupport>(estimator, options, workspace);
    EXPECT_EQ(a.model, 10.0);
    EXPECT_EQ(full.model, 10.0);
    EXPECT_EQ(a.inliers, 150u);
    EXPECT_EQ(a.trials, b.trials);
    EXPECT_EQ(a.support, b.support);
  }
}

}  // namespace
}  // namespace stillpoint
