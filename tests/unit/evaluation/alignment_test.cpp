// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/evaluation/alignment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint::alignment_test {
namespace {

/// Rounding of sums over some tens of values of size one.
constexpr double kRounding = 1e-12;

Vector3d gaussian_vector(Random& random, double sigma) {
  const double x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
  return sigma * Vector3d(x, y, z);
}

std::vector<Vector3d> cloud(Random& random, std::size_t count) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(gaussian_vector(random, 1.0));
  return points;
}

Similarity random_similarity(Random& random) {
  Similarity similarity;
  similarity.scale = random.uniform(0.1, 5.0);
  similarity.rotation = rotation_from_vector(gaussian_vector(random, 2.0));
  similarity.translation = gaussian_vector(random, 3.0);
  return similarity;
}

Eigen::Matrix4d matrix_of(const Similarity& similarity) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = similarity.scale * similarity.rotation;
  matrix.topRightCorner<3, 1>() = similarity.translation;
  return matrix;
}

Eigen::Matrix3Xd columns_of(const std::vector<Vector3d>& points) {
  Eigen::Matrix3Xd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return columns;
}

TEST(AlignPoints, FindsAKnownSimilarity) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Similarity truth = random_similarity(random);
    const std::vector<Vector3d> source = cloud(random, 3 + random.index(30));
    std::vector<Vector3d> target;
    for (const Vector3d& point : source) target.push_back(truth * point);
    const AlignmentResult result = align_points(source, target, true);
    ASSERT_EQ(result.status, AlignmentStatus::ok) << "seed " << seed;
    // Three points may lie nearly on a line, which costs digits.
    constexpr double kTolerance = 1e-8;
    EXPECT_LT((matrix_of(result.target_from_source) - matrix_of(truth)).norm(), kTolerance) << "seed " << seed;
  }
}

// A tracker that is stuck, or a tripod: the mean of equal positions is not quite equal to them.
TEST(AlignPoints, PointsThatCoincideAnywhereAreCollinear) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const std::vector<Vector3d> path = cloud(random, 300);
    const std::vector<Vector3d> stuck(path.size(), gaussian_vector(random, seed % 2 == 0 ? 1.0 : 1e6));
    for (const bool with_scale : {false, true}) {
      EXPECT_EQ(align_points(stuck, path, with_scale).status, AlignmentStatus::collinear) << seed;
      EXPECT_EQ(align_points(path, stuck, with_scale).status, AlignmentStatus::collinear) << seed;
    }
  }
}

// A micrometre of motion is one, a kilometre from the origin, too.
TEST(AlignPoints, SmallMotionsFarAwayAreAligned) {
  Random random(1);
  std::vector<Vector3d> source = cloud(random, 30), target = source;
  for (Vector3d& point : source) point = 1e-6 * point + Vector3d(1e3, 0, 0);
  EXPECT_EQ(align_points(source, target, true).status, AlignmentStatus::ok);
}

TEST(AlignPoints, AgreesWithEigenOnNoisyPoints) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Similarity truth = random_similarity(random);
    const std::vector<Vector3d> source = cloud(random, 10 + random.index(40));
    std::vector<Vector3d> target;
    // Noise of the size of the cloud: here the best rotation is not near the truth, and often U Vᵀ is a mirror.
    const double noise = seed % 2 == 0 ? 0.1 : 3.0;
    for (const Vector3d& point : source) target.push_back(truth * point + gaussian_vector(random, noise));
    for (const bool with_scale : {false, true}) {
      const AlignmentResult result = align_points(source, target, with_scale);
      ASSERT_EQ(result.status, AlignmentStatus::ok);
      const Eigen::Matrix4d expected = Eigen::umeyama(columns_of(source), columns_of(target), with_scale);
      constexpr double kTolerance = 1e-9;  // both are SVDs; the mirror case can be ill-conditioned
      EXPECT_LT((matrix_of(result.target_from_source) - expected).norm(), kTolerance) << "seed " << seed;
      EXPECT_NEAR(result.target_from_source.rotation.determinant(), 1.0, kRounding);
    }
  }
}

TEST(AlignPoints, MirroredPointsGetARotationNotAMirror) {
  Random random(5);
  const std::vector<Vector3d> source = cloud(random, 20);
  std::vector<Vector3d> target;
  for (const Vector3d& point : source) target.push_back({-point.x(), point.y(), point.z()});
  const AlignmentResult result = align_points(source, target, false);
  ASSERT_EQ(result.status, AlignmentStatus::ok);
  EXPECT_NEAR(result.target_from_source.rotation.determinant(), 1.0, kRounding);
}

TEST(AlignPoints, PointsInAPlaneAreEnough) {
  Random random(6);
  const Similarity truth = random_similarity(random);
  std::vector<Vector3d> source = cloud(random, 20), target;
  for (Vector3d& point : source) {
    point.z() = 0.0;
    target.push_back(truth * point);
  }
  const AlignmentResult result = align_points(source, target, true);
  ASSERT_EQ(result.status, AlignmentStatus::ok);
  EXPECT_LT((matrix_of(result.target_from_source) - matrix_of(truth)).norm(), 1e3 * kRounding);
}

TEST(AlignPoints, DegenerateInputHasAName) {
  Random random(7);
  const std::vector<Vector3d> points = cloud(random, 20);
  const auto status = [](const std::vector<Vector3d>& source, const std::vector<Vector3d>& target) {
    const AlignmentResult result = align_points(source, target, true);
    EXPECT_EQ(result.target_from_source.rotation, Matrix3d::Identity());
    EXPECT_EQ(result.target_from_source.scale, 1.0);
    return result.status;
  };
  EXPECT_EQ(status({}, {}), AlignmentStatus::too_few_points);
  EXPECT_EQ(status({points[0], points[1]}, {points[2], points[3]}), AlignmentStatus::too_few_points);

  std::vector<Vector3d> line;
  for (std::size_t i = 0; i < points.size(); ++i) line.push_back(points[0] + points[i].x() * points[1]);
  EXPECT_EQ(status(line, points), AlignmentStatus::collinear);
  EXPECT_EQ(status(points, line), AlignmentStatus::collinear);
  const std::vector<Vector3d> place(points.size(), points[0]);
  EXPECT_EQ(status(place, points), AlignmentStatus::collinear);
  EXPECT_EQ(status(place, place), AlignmentStatus::collinear);

  std::vector<Vector3d> broken = points;
  broken[4].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status(broken, points), AlignmentStatus::not_finite);
  broken[4].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(status(points, broken), AlignmentStatus::not_finite);
}

TEST(AlignPoints, DifferentSizesAreAnError) {
  const std::vector<Vector3d> three(3, Vector3d::Zero()), four(4, Vector3d::Zero());
  try {
    align_points(three, four, false);
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "align_points: 3 source and 4 target points, expected as many of each");
  }
}

TEST(Transformed, MovesPositionsWithTheScaleAndOrientationsWithoutIt) {
  Similarity similarity;
  similarity.scale = 2.0;
  similarity.rotation = rotation_from_vector({0, 0, M_PI / 2});  // x to y
  similarity.translation = {0, 0, 1};
  StampedPose pose;
  pose.timestamp_s = 7.0;
  pose.world_from_camera.translation() = Vector3d(3, 0, 0);
  const Trajectory moved = transformed(similarity, {pose});
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].timestamp_s, 7.0);
  EXPECT_LT((moved[0].world_from_camera.translation() - Vector3d(0, 6, 1)).norm(), kRounding);
  EXPECT_LT((moved[0].world_from_camera.linear() - similarity.rotation).norm(), kRounding);
}

}  // namespace
}  // namespace stillpoint::alignment_test
