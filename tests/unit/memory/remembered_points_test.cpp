// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/memory/remembered_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

constexpr NeighbourWeights kWeights = {25.0f, 15.0f};
constexpr float kTolerance_m = 0.1f;  // of one surface

RememberedPoints::Sums sums_around(const std::vector<RememberedPoint>& points, const Vector2f& pixel, float depth_m) {
  std::vector<Vector2f> pixels;
  for (const RememberedPoint& point : points) pixels.push_back(point.pixel);
  Workspace workspace;
  return RememberedPoints(pixels, points, kWeights, workspace).around(pixel, depth_m, kTolerance_m);
}

/// One point after the other, as the weights are told.
RememberedPoints::Sums one_by_one(const std::vector<RememberedPoint>& points, const Vector2f& pixel, float depth_m) {
  RememberedPoints::Sums sums;
  for (const RememberedPoint& point : points) {
    if (!point.pixel.allFinite()) continue;
    const float squared = (point.pixel - pixel).squaredNorm();
    const bool same_kind = (depth_m > 0) == (point.depth_m > 0);
    if (same_kind && std::abs(depth_m - point.depth_m) > kTolerance_m) continue;
    const float vote = std::max(0.0f, 1 - squared / (25.0f * 25.0f)) * (same_kind ? 1.0f : 0.02f);
    sums.asked += vote;
    sums.votes += vote * point.certainty;
    sums.dynamic_prior += vote * point.certainty * point.dynamic_prior;
    if (!point.is_feature) continue;
    const float near = std::max(0.0f, 1 - squared / (15.0f * 15.0f));
    const float weight = near * near * (same_kind ? 1.0f : 0.2f);
    sums.feature_weight += weight;
    sums.log_odds += weight * point.log_odds;
  }
  return sums;
}

// A point 15 px away on the same surface: its vote is 1 − (15 / 25)² = 0.64, and as a feature it is another one.
TEST(RememberedPoints, AVoteFallsWithTheDistance) {
  const RememberedPoints::Sums sums = sums_around({{{115, 100}, 2.0f, 3.0f, 0.5f, true}}, {100, 100}, 2.05f);
  EXPECT_FLOAT_EQ(sums.votes, 0.64f);
  EXPECT_FLOAT_EQ(sums.dynamic_prior, 0.32f);
  EXPECT_NEAR(sums.feature_weight, 0.0f, 1e-6f);
  // One of which little is known has so much less of a vote.
  const RememberedPoints::Sums unsure = sums_around({{{115, 100}, 2.0f, 3.0f, 0.5f, true, 0.25f}}, {100, 100}, 2.05f);
  EXPECT_FLOAT_EQ(unsure.votes, 0.16f);
  EXPECT_FLOAT_EQ(unsure.dynamic_prior, 0.08f);
  EXPECT_FLOAT_EQ(unsure.asked, 0.64f);
  // At 9 px (1 − 0.36)² = 0.4096 of its log-odds, unless it is a surface cell.
  EXPECT_FLOAT_EQ(sums_around({{{109, 100}, 2.0f, 3.0f, 0.5f, true}}, {100, 100}, 2.0f).log_odds, 3.0f * 0.4096f);
  EXPECT_EQ(sums_around({{{109, 100}, 2.0f, 3.0f, 0.5f, false}}, {100, 100}, 2.0f).feature_weight, 0.0f);
}

TEST(RememberedPoints, AnotherSurfaceHasNoSayAndAnotherKindLittle) {
  EXPECT_EQ(sums_around({{{100, 100}, 2.2f, 3.0f, 1.0f, true}}, {100, 100}, 2.0f).votes, 0.0f);
  for (const auto& [theirs_m, ours_m] : {std::pair{0.0f, 2.0f}, {2.0f, 0.0f}}) {
    const RememberedPoints::Sums sums = sums_around({{{100, 100}, theirs_m, 3.0f, 1.0f, true}}, {100, 100}, ours_m);
    EXPECT_FLOAT_EQ(sums.votes, 0.02f);
    EXPECT_FLOAT_EQ(sums.feature_weight, 0.2f);
  }
  EXPECT_FLOAT_EQ(sums_around({{{100, 100}, 0.0f, 3.0f, 1.0f, true}}, {100, 100}, 0.0f).votes, 1.0f);
}

// Four at a time is the same as one at a time, whatever is left over at the end of a row of cells.
TEST(RememberedPoints, SumsAreThoseOfOnePointAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const auto uniform = [&random](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
    std::vector<RememberedPoint> points(random.index(120));
    for (RememberedPoint& point : points)
      point = {{uniform(0, 120), uniform(0, 120)},
               random.uniform() < 0.3 ? 0.0f : uniform(1.9, 2.1),
               uniform(-3, 3),
               uniform(0, 1),
               random.uniform() < 0.7,
               uniform(0, 1)};
    if (!points.empty() && seed % 3 == 0) points.front().pixel.x() = std::numeric_limits<float>::quiet_NaN();
    for (int query = 0; query < 20; ++query) {
      const Vector2f pixel(uniform(-10, 130), uniform(-10, 130));
      const float depth_m = query % 4 == 0 ? 0.0f : uniform(1.9, 2.1);
      const RememberedPoints::Sums expected = one_by_one(points, pixel, depth_m);
      const RememberedPoints::Sums found = sums_around(points, pixel, depth_m);
      ASSERT_NEAR(found.votes, expected.votes, 1e-4f) << "seed " << seed;
      ASSERT_NEAR(found.asked, expected.asked, 1e-4f) << "seed " << seed;
      ASSERT_NEAR(found.dynamic_prior, expected.dynamic_prior, 1e-4f) << "seed " << seed;
      ASSERT_NEAR(found.feature_weight, expected.feature_weight, 1e-4f) << "seed " << seed;
      ASSERT_NEAR(found.log_odds, expected.log_odds, 1e-4f) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace stillpoint
