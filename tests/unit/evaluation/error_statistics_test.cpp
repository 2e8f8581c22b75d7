// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/evaluation/error_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace stillpoint::error_statistics_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-15;

TEST(ErrorStatistics, HandComputed) {
  // 3, 1, 4, 4: mean 12/4 = 3, mean square 42/4 = 10.5, variance 10.5 - 9 = 1.5, middle two 3 and 4.
  const ErrorStatistics s = error_statistics(std::vector<double>{3, 1, 4, 4});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(10.5));
  EXPECT_NEAR(s.std, std::sqrt(1.5), kRounding);
  EXPECT_DOUBLE_EQ(s.median, 3.5);
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_DOUBLE_EQ(error_statistics(std::vector<double>{9, 1, 2}).median, 2.0);
}

TEST(ErrorStatistics, OfOneErrorIsThatError) {
  const ErrorStatistics s = error_statistics(std::vector<double>{0.25});
  for (const double figure : {s.rmse, s.mean, s.median, s.min, s.max}) EXPECT_EQ(figure, 0.25);
  EXPECT_EQ(s.std, 0.0);
}

TEST(ErrorStatistics, NothingAndNaNGiveNoFigures) {
  for (const std::vector<double>& errors : {std::vector<double>{}, std::vector<double>{1.0, kNaN, 2.0}}) {
    const ErrorStatistics s = error_statistics(errors);
    EXPECT_EQ(s.count, errors.size());
    for (const double figure : {s.rmse, s.mean, s.median, s.std, s.min, s.max}) EXPECT_TRUE(std::isnan(figure));
  }
}

TEST(ImprovementPercent, HandComputed) {
  EXPECT_DOUBLE_EQ(improvement_percent(0.4, 0.1).value(), 75.0);
  EXPECT_DOUBLE_EQ(improvement_percent(0.2, 0.3).value(), -50.0);
  EXPECT_DOUBLE_EQ(improvement_percent(0.2, 0.2).value(), 0.0);
  // The paper's walking_xyz: 0.2995 to 0.0116 m, by Eq. 17: 0.2879 / 0.2995 = 96.127 %.
  EXPECT_NEAR(improvement_percent(0.2995, 0.0116).value(), 96.127, 5e-4);
}

TEST(ImprovementPercent, IsEmptyWithoutSomethingToCompare) {
  EXPECT_FALSE(improvement_percent(0.0, 0.1));
  EXPECT_FALSE(improvement_percent(-1.0, 0.1));
  EXPECT_FALSE(improvement_percent(kNaN, 0.1));
  EXPECT_FALSE(improvement_percent(0.1, kNaN));
  EXPECT_FALSE(improvement_percent(std::numeric_limits<double>::infinity(), 0.1));
}

}  // namespace
}  // namespace stillpoint::error_statistics_test
