// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/kabsch.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>
#include <vector>

#include "motion_scene.hpp"
#include "stillpoint/motion/candidates.hpp"
#include "stillpoint/motion/epipolar/metric_scale.hpp"

namespace stillpoint {
namespace {

TEST(Kabsch, AgreesWithUmeyamaAndFindsTheMotion) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 3.0, 2.0);
    std::vector<Vector3d> source, target;
    Eigen::Matrix3Xd a(3, 10), b(3, 10);
    for (int i = 0; i < 10; ++i) {
      source.emplace_back(random.gaussian(), random.gaussian(), random.gaussian());
      target.push_back(truth * source.back() + 0.3 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian()));
      a.col(i) = source.back();
      b.col(i) = target.back();
    }
    const auto pose = kabsch(source, target);
    ASSERT_TRUE(pose.has_value());
    EXPECT_LT((pose->matrix() - Eigen::umeyama(a, b, false)).norm(), 1e-9);
    EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-12);
  }
}

TEST(Kabsch, MirroredPointsGetARotation) {
  const std::vector<Vector3d> source = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0, 0, 0}};
  std::vector<Vector3d> target = source;
  for (Vector3d& p : target) p.x() = -p.x();
  const auto pose = kabsch(source, target);
  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-12);
}

TEST(Kabsch, WeightZeroLeavesAPointOut) {
  const std::vector<Vector3d> source = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {5, 5, 5}};
  std::vector<Vector3d> target = source;
  target[3].setZero();
  const std::vector<double> weights = {1, 1, 1, 0};
  const auto pose = kabsch(source, target, weights);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((pose->matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
}

TEST(Kabsch, DegeneratePointsHaveNoMotion) {
  const std::vector<Vector3d> two = {{1, 0, 0}, {0, 1, 0}}, same(5, Vector3d(1, 2, 3));
  const std::vector<Vector3d> line = {{1, 1, 1}, {2, 2, 2}, {4, 4, 4}};
  std::vector<Vector3d> nan = {{1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::quiet_NaN()}};
  for (const auto& points : {std::vector<Vector3d>{}, two, same, line, nan}) EXPECT_FALSE(kabsch(points, points));
}

TEST(MetricScale, WeightedMedianIgnoresTheWildAndTheNotFinite) {
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<ScaleVote> votes = {{0.1, 0.01}, {0.11, 0.01}, {0.12, 0.01}, {9.0, 0.01}, {-50.0, 1.0}, {kNaN, 0.01}};
  const auto scale = metric_scale(votes, 3);
  ASSERT_TRUE(scale.has_value());
  EXPECT_EQ(scale->metres, 0.11);  // half of the weight (401 / 2) is reached with the second hundred
  EXPECT_FALSE(metric_scale(votes, 6));
  EXPECT_FALSE(metric_scale({}, 0));
}

TEST(Candidates, FollowTheRuleOfThePaper) {
  Random random(1);
  Matches matches = test::make_matches(Pose::Identity(), {12}, random);
  Regions regions;
  regions.of_feature.assign(12, Membership{});
  matches.state[0] = MatchState::near_edge;
  regions.of_feature[1].edge_distance_px = 4.0f;
  regions.of_feature[2].in_dynamic = true;
  regions.of_feature[3].in_dynamic = regions.of_feature[3].in_fixed = true;
  Workspace workspace;
  const auto any = [](std::size_t) { return true; };
  const auto chosen = [&] {
    const auto found = select_candidates(matches, regions, {}, workspace, any);
    return std::vector<std::uint32_t>(found.begin(), found.end());
  };
  EXPECT_EQ(chosen(), (std::vector<std::uint32_t>{4, 5, 6, 7, 8, 9, 10, 11}));  // exactly 8 are enough
  matches.state[11] = MatchState::lost;
  EXPECT_EQ(chosen(), (std::vector<std::uint32_t>{2, 4, 5, 6, 7, 8, 9, 10}));  // 7 are not; 3 stays out
}

}  // namespace
}  // namespace stillpoint
