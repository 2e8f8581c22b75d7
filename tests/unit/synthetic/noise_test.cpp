// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stillpoint::synthetic {
namespace {

TEST(NormalTable, HasTheQuantilesOfTheNormalDistribution) {
  const NormalTable table;
  constexpr double kSlice = 0.01;  // width of a slice near these quantiles, and the scaling to unit deviation
  EXPECT_NEAR(table[static_cast<std::size_t>(0.975 * 4096)], 1.960, kSlice);
  EXPECT_NEAR(table[static_cast<std::size_t>(0.9987 * 4096)], 3.01, 5 * kSlice);
  EXPECT_NEAR(table[static_cast<std::size_t>(0.1587 * 4096)], -1.0, kSlice);
}

TEST(NormalStream, HasMeanZeroAndDeviationOne) {
  const NormalTable table;
  NormalStream stream(table, 1);
  constexpr int kCount = 200000;
  double sum = 0, squares = 0, fourth = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = static_cast<double>(stream.next());
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4 / std::sqrt(kCount));  // four standard errors
  EXPECT_NEAR(squares / kCount, 1.0, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourth / kCount, 3.0, 0.1);  // tails: uniform noise would have 1.8
}

}  // namespace
}  // namespace stillpoint::synthetic
