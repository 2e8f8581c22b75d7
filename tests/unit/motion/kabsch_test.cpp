// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/kabsch.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>
#include <vector>

#include "motion_scene.hpp"

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

}  // namespace
}  // namespace stillpoint
