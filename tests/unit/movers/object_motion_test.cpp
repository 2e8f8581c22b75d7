// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/object_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/movers/motion_groups.hpp"
#include "stillpoint/movers/moving_features.hpp"

namespace stillpoint::object_motion_test {
namespace {

const Camera kCamera(525, 525, 320, 240, 640, 480);
constexpr double kDepthSigma_m = 0.005, kPixelSigma_px = 0.5;

/// Points in a cube of 0.4 m around a centre, moved.
std::vector<WhitenedPair> pairs_of(const Vector3d& centre, const Pose& moved, std::size_t count, Random& random) {
  std::vector<WhitenedPair> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3d point =
        centre + Vector3d(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    pairs.emplace_back(point, kDepthSigma_m, moved * point, kDepthSigma_m, kPixelSigma_px, kCamera);
  }
  return pairs;
}

Pose shift(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Vector3d(x, y, z);
  return pose;
}

/// About an upright axis through a centre.
Pose turn_about(const Vector3d& centre, double radians) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_vector({0, radians, 0});
  pose.translation() = centre - pose.linear() * centre;
  return pose;
}

TEST(ObjectMotion, TranslationIsExactWithTwoFifthsOfThePairsElsewhere) {
  Random random(3);
  Workspace workspace;
  std::vector<WhitenedPair> pairs = pairs_of({0, 0, 2}, shift(0.02, 0, -0.01), 30, random);
  for (const WhitenedPair& pair : pairs_of({0, 0, 2}, shift(-0.4, 0.3, 0.5), 20, random)) pairs.push_back(pair);
  const std::optional<ObjectMotion> motion = ObjectMotionEstimator::translation(pairs, workspace);
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->moved.translation() - Vector3d(0.02, 0, -0.01)).norm(), 1e-3);
  EXPECT_EQ(motion->moved.linear(), Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(motion->inlier_share, 0.6);
  EXPECT_FALSE(motion->has_rotation);
}

// N pairs straight ahead at 2 m: across the ray each is known to √2 · ½ px · 2 m / 525 px, along it to √2 · 5 mm. The
// pairs are exact, so that Cauchy's weights are 1 and the variance is that over N.
TEST(ObjectMotion, TranslationKnowsHowCertainItIs) {
  Workspace workspace;
  const std::size_t count = 8;
  const std::vector<WhitenedPair> pairs(
      count, WhitenedPair({0, 0, 2}, kDepthSigma_m, {0, 0, 2}, kDepthSigma_m, kPixelSigma_px, kCamera));
  const std::optional<ObjectMotion> motion = ObjectMotionEstimator::translation(pairs, workspace);
  ASSERT_TRUE(motion);
  const double across_sq = 2 * 0.25 * 4.0 / (525.0 * 525.0) / count, along_sq = 2 * 25e-6 / count;
  EXPECT_NEAR(motion->covariance(3, 3), across_sq, 1e-3 * across_sq);
  EXPECT_NEAR(motion->covariance(5, 5), along_sq, 1e-3 * along_sq);
}

/// Standard normal, nearly: twelve uniform numbers have variance 1.
double normal(Random& random) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += random.uniform(-0.5, 0.5);
  return sum;
}

/// The pairs of a turn of 0.01 rad as a camera sees them: noise of pixels, 5 mm of depth.
std::vector<WhitenedPair> seen_turn(const Pose& turn, double pixel_noise_px, Random& random) {
  std::vector<WhitenedPair> pairs;
  const auto seen = [&](const Vector3d& point) {
    const Vector2d pixel = kCamera.project(point) + pixel_noise_px * Vector2d(normal(random), normal(random));
    return kCamera.back_project(pixel, point.z() + kDepthSigma_m * normal(random));
  };
  for (const WhitenedPair& exact : pairs_of({0, 0, 2}, turn, 100, random)) {
    const Vector3d reference = seen(exact.reference), current = seen(exact.current);
    pairs.emplace_back(reference, kDepthSigma_m, current, kDepthSigma_m, kPixelSigma_px, kCamera);
  }
  return pairs;
}

TEST(ObjectMotion, PixelNoiseIsWhatTheOffsetsShowAndNeverLessThanHalf) {
  Random random(5);
  Workspace workspace;
  const Pose turn = turn_about({0, 0, 2}, 0.01);
  EXPECT_DOUBLE_EQ(ObjectMotionEstimator::pixel_noise(seen_turn(turn, 0.5, random), turn, workspace), 1.0);
  EXPECT_DOUBLE_EQ(ObjectMotionEstimator::pixel_noise(seen_turn(turn, 0.02, random), turn, workspace), 0.5);
  const double between = ObjectMotionEstimator::pixel_noise(seen_turn(turn, 0.125, random), turn, workspace);
  EXPECT_NEAR(between, 3.0 * 0.125 / 0.5, 0.15);  // of 200 offsets
  // Half of the pairs belong to a limb that goes 1 cm farther: no noise of pixels.
  std::vector<WhitenedPair> pairs = seen_turn(turn, 0.02, random);
  for (const WhitenedPair& pair : seen_turn(shift(0.01, 0, 0) * turn, 0.02, random)) pairs.push_back(pair);
  for (const WhitenedPair& pair : seen_turn(shift(0, 0.01, 0) * turn, 0.02, random)) pairs.push_back(pair);
  EXPECT_DOUBLE_EQ(ObjectMotionEstimator::pixel_noise(pairs, shift(0.005, 0.005, 0) * turn, workspace), 1.0);
  EXPECT_DOUBLE_EQ(ObjectMotionEstimator::pixel_noise({}, turn, workspace), 1.0);
}

// Pixels that are ten times as good as it was said: with their due weight the turn is known better.
TEST(ObjectMotion, ATurnIsKnownBetterWithTheWeightThatPixelsDeserve) {
  Random random(6);
  const Pose turn = turn_about({0, 0, 2}, 0.01);
  double as_said_sq = 0, weighed_sq = 0;
  for (int k = 0; k < 50; ++k) {
    const std::vector<WhitenedPair> pairs = seen_turn(turn, 0.05, random);
    const std::optional<ObjectMotion> as_said = ObjectMotionEstimator::rigid(pairs, Pose::Identity()),
                                      weighed = ObjectMotionEstimator::rigid(pairs, Pose::Identity(), 0.5);
    ASSERT_TRUE(as_said && weighed);
    as_said_sq += std::pow(rotation_angle(turn.linear().transpose() * as_said->moved.linear()), 2);
    weighed_sq += std::pow(rotation_angle(turn.linear().transpose() * weighed->moved.linear()), 2);
  }
  EXPECT_LT(weighed_sq, 0.7 * as_said_sq);
}

constexpr double kElapsed_s = 1 / 30.0;

// An upper half that goes 5 mm to the right and a lower one that goes 5 mm to the left: 0.15 m/s each. The 10 pairs of
// a part know it to 1.5 · 2 · (√2 · 0.3 px · 2 m / 525 px)² / 10 = 0.8e-6 m², which is taken off 25e-6 m².
TEST(ObjectMotion, PartsThatMoveAgainstEachOtherBend) {
  std::vector<WhitenedPair> pairs;
  for (const double side : {1.0, -1.0})
    for (int k = 0; k < 40; ++k) {
      const Vector3d point(0.01 * (k % 20), side * (0.1 + 0.005 * k), 2.0);
      pairs.emplace_back(point, kDepthSigma_m, point + Vector3d(side * 0.005, 0, 0), kDepthSigma_m, 0.3, kCamera);
    }
  const std::optional<double> bending_sq = ObjectMotionEstimator::bending_sq(pairs, Pose::Identity(), kElapsed_s);
  ASSERT_TRUE(bending_sq);
  EXPECT_NEAR(*bending_sq, (25e-6 - 0.8e-6) * 900, 0.3e-6 * 900);
}

TEST(ObjectMotion, WhatTurnsRigidlyDoesNotBendOnceItsTurnIsTakenOut) {
  Random random(11);
  const Pose moved = shift(0.01, 0, 0.01) * turn_about({0.3, 0, 1.5}, 0.05);
  std::vector<WhitenedPair> pairs = pairs_of({0.3, 0, 1.5}, moved, 80, random);
  const auto noise = [&](double sigma) { return random.uniform(-1.7, 1.7) * sigma; };
  for (WhitenedPair& pair : pairs) pair.current += Vector3d(noise(0.001), noise(0.001), noise(kDepthSigma_m));
  const std::optional<ObjectMotion> rigid = ObjectMotionEstimator::rigid(pairs, Pose::Identity());
  ASSERT_TRUE(rigid);
  EXPECT_LT(*ObjectMotionEstimator::bending_sq(pairs, rigid->moved, kElapsed_s), 1e-4);
  EXPECT_GT(*ObjectMotionEstimator::bending_sq(pairs, Pose::Identity(), kElapsed_s), 0.01);
}

TEST(ObjectMotion, NobodyKnowsWhetherFewPairsBend) {
  Random random(12);
  EXPECT_FALSE(ObjectMotionEstimator::bending_sq({}, Pose::Identity(), kElapsed_s));
  const std::vector<WhitenedPair> pairs = pairs_of({0, 0, 2}, Pose::Identity(), 4, random);
  EXPECT_FALSE(ObjectMotionEstimator::bending_sq(pairs, Pose::Identity(), kElapsed_s));
}

TEST(ObjectMotion, RigidFindsATurn) {
  Random random(4);
  const Pose moved = shift(0.01, 0, 0.02) * turn_about({0.3, 0, 1.5}, 0.05);
  const std::vector<WhitenedPair> pairs = pairs_of({0.3, 0, 1.5}, moved, 60, random);
  const std::optional<ObjectMotion> motion = ObjectMotionEstimator::rigid(pairs, Pose::Identity());
  ASSERT_TRUE(motion);
  EXPECT_TRUE(motion->has_rotation);
  EXPECT_LT(rotation_angle(motion->moved.linear().transpose() * moved.linear()), 1e-4);
  EXPECT_LT((motion->moved.translation() - moved.translation()).norm(), 1e-4);
}

TEST(ObjectMotion, PointsOnALineAndFewPointsDetermineNoTurn) {
  Workspace workspace;
  std::vector<WhitenedPair> line;
  for (int k = 0; k < 20; ++k) {
    const Vector3d point(0.02 * k, 0, 2);
    line.emplace_back(point, kDepthSigma_m, point, kDepthSigma_m, kPixelSigma_px, kCamera);
  }
  EXPECT_FALSE(ObjectMotionEstimator::rigid(line, Pose::Identity()));
  EXPECT_TRUE(ObjectMotionEstimator::translation(line, workspace));
  EXPECT_FALSE(ObjectMotionEstimator::rigid({line.data(), 7}, Pose::Identity()));
  EXPECT_FALSE(ObjectMotionEstimator::translation({line.data(), 2}, workspace));
}

// At (1, 0, 2) the ray is (½, 0, 1). Seen at (0.5, 0, 1) m/s, that is 1 m/s along it: with 0.2 m/s of noise along the
// ray 0.4 m/s are left of the difference to standing still, three standard deviations being noise. Across it nothing
// is.
TEST(FeatureVelocity, NoiseAlongTheRayIsTakenOff) {
  const FeatureVelocity velocity{true, {0.5, 0, 1}, 0.2};
  EXPECT_NEAR(velocity.difference(Vector3d::Zero(), {1, 0, 2}), 0.4, 1e-12);
  const FeatureVelocity across{true, {0.3, 0.4, 0}, 0.2};
  EXPECT_NEAR(across.difference(Vector3d::Zero(), {1, 0, 2}), 0.5, 1e-12);
}

// ---- Groups ----

DynamicPoints points_of(const std::vector<WhitenedPair>& pairs, Workspace& workspace) {
  DynamicPoints points(pairs.size(), workspace);
  for (const WhitenedPair& pair : pairs) {
    points.feature[points.size] = static_cast<std::uint32_t>(points.size);
    points.pair[points.size] = pair;
    points.has_step[points.size++] = 1;
  }
  return points;
}

TEST(DynamicPoints, AreThinnedOutEvenly) {
  Random random(4);
  Workspace workspace;
  DynamicPoints points = points_of(pairs_of({0, 0, 2}, shift(0, 0, 0), 10, random), workspace);
  const Vector3d seventh = points.point(7);
  points.thin_out(10);
  EXPECT_EQ(points.size, 10u);
  points.has_step[5] = 0;
  points.thin_out(4);
  ASSERT_EQ(points.size, 4u);
  const std::uint32_t left[] = {0, 2, 5, 7};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(points.feature[k], left[k]);
  EXPECT_EQ(points.point(3), seventh);
  EXPECT_EQ(points.has_step[2], 0);
}

TEST(MotionGroups, TwoThatTouchAndGoOppositeWaysAreTwoGroups) {
  Random random(5);
  Workspace workspace;
  std::vector<WhitenedPair> pairs = pairs_of({-0.2, 0, 2}, shift(0.03, 0, 0), 60, random);
  for (const WhitenedPair& pair : pairs_of({0.2, 0, 2}, shift(-0.03, 0, 0), 50, random)) pairs.push_back(pair);
  const DynamicPoints points = points_of(pairs, workspace);
  const MotionGroups groups(points, 1.0 / 30, workspace);
  ASSERT_EQ(groups.count, 2u);
  std::size_t wrong = 0;  // the larger group is peeled off first
  for (std::size_t k = 0; k < points.size; ++k) wrong += groups.of_point[k] != (k < 60 ? 0 : 1);
  EXPECT_LE(wrong, 20u) << "two pieces of surface where they touch";
}

TEST(MotionGroups, AnArmThatSwingsIsAPartOfItsBody) {
  Random random(6);
  Workspace workspace;
  std::vector<WhitenedPair> pairs = pairs_of({0, 0, 2}, shift(0.02, 0, 0), 80, random);
  for (const WhitenedPair& pair : pairs_of({0.3, 0, 2}, shift(-0.03, 0, 0), 20, random)) pairs.push_back(pair);
  const MotionGroups groups(points_of(pairs, workspace), 1.0 / 30, workspace);
  for (const std::int32_t group : groups.of_point) EXPECT_EQ(group, 0);
}

TEST(MotionGroups, ThoseThatAreApartAreTwoGroupsThoughTheyMoveAlike) {
  Random random(7);
  Workspace workspace;
  std::vector<WhitenedPair> pairs = pairs_of({-1, 0, 2}, shift(0.02, 0, 0), 40, random);
  for (const WhitenedPair& pair : pairs_of({1, 0, 2}, shift(0.02, 0, 0), 40, random)) pairs.push_back(pair);
  const MotionGroups groups(points_of(pairs, workspace), 1.0 / 30, workspace);
  ASSERT_EQ(groups.count, 2u);
  for (std::size_t k = 0; k < 80; ++k) EXPECT_EQ(groups.of_point[k], groups.of_point[k < 40 ? 0 : 40]);
  EXPECT_NE(groups.of_point[0], groups.of_point[40]);
}

// 17 points are one cluster of K-means, wherever they are: 15 of them 0.1 m apart.
TEST(MotionGroups, WhatLiesFarOffIsOfNoGroupThoughItMovesAlike) {
  Workspace workspace;
  std::vector<Vector3d> seen;
  for (int k = 0; k < 15; ++k) seen.emplace_back(0.1 * (k % 3), 0.1 * (k / 3), 2.0);
  seen.emplace_back(-1.5, 0, 3);
  seen.emplace_back(1.2, 0, 3);
  const Pose moved = shift(0.02, 0, 0);
  std::vector<WhitenedPair> pairs;
  for (const Vector3d& point : seen)
    pairs.emplace_back(point, kDepthSigma_m, moved * point, kDepthSigma_m, kPixelSigma_px, kCamera);
  const MotionGroups groups(points_of(pairs, workspace), 1.0 / 30, workspace);
  ASSERT_EQ(groups.count, 1u);
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_EQ(groups.of_point[k], k < 15 ? 0 : MotionGroups::kNone);
}

TEST(MotionGroups, NothingIsNoGroup) {
  Workspace workspace;
  EXPECT_EQ(MotionGroups(DynamicPoints(), 1.0 / 30, workspace).count, 0u);
}

}  // namespace
}  // namespace stillpoint::object_motion_test
