// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

double median(std::vector<double> values) { return median_in_place(span<double>(values)); }
double quantile(std::vector<double> values, double q) { return quantile_in_place(span<double>(values), q); }

TEST(Statistics, MedianIsTheMiddleOrTheLowerOfTwo) {
  EXPECT_EQ(median({5}), 5);
  EXPECT_EQ(median({9, 1}), 1);
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2);
  EXPECT_EQ(median({7, 7, 7, 1}), 7);
}

TEST(Statistics, QuantileIsTheNearestRank) {
  // Nearest rank of q over n values: the ⌈q n⌉-th smallest, at least the first.
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.0), 10);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.25), 10);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.26), 20);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.5), 20);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.75), 30);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 1.0), 40);
  EXPECT_EQ(quantile({8}, 0.3), 8);
}

TEST(Statistics, AgreeWithSorting) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    std::vector<double> values(1 + random.index(60));
    for (double& value : values) value = static_cast<double>(random.index(40)) - 20.0;  // with repeated values
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(median(values), sorted[(sorted.size() - 1) / 2]);
    const double q = random.uniform();
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    ASSERT_EQ(quantile(values, q), sorted[std::max<std::size_t>(rank, 1) - 1]) << "seed " << seed << " q " << q;
  }
}

// 1.4826 × MAD of normal values is their standard deviation.
TEST(Statistics, MadToSigmaFitsTheNormalDistribution) {
  Random random(1);
  std::vector<double> deviations(100001);
  for (double& value : deviations) value = std::abs(0.3 * random.gaussian());
  // Standard error of the MAD of n normal values: about 1.17 σ / sqrt(n), scaled by 1.4826; five of them.
  EXPECT_NEAR(kMadToSigma * median(deviations), 0.3, 5 * 0.3 * 1.7 / std::sqrt(100001.0));
}

TEST(Statistics, ExponentialShareIsTheSameForOneStepAndForMany) {
  EXPECT_EQ(exponential_share(0.0, 2.0), 0.0);
  EXPECT_NEAR(exponential_share(2.0 * std::log(2.0), 2.0), 0.5, 1e-15);  // a half after τ ln 2
  // What one step of 0.3 s leaves of the old mean, three of 0.1 s leave too.
  EXPECT_NEAR(1.0 - exponential_share(0.3, 0.7), std::pow(1.0 - exponential_share(0.1, 0.7), 3), 1e-15);
}

}  // namespace
}  // namespace stillpoint
