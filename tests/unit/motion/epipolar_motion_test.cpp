// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/epipolar/epipolar_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motion_scene.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::epipolar_motion_test {
namespace {

using test::SceneOptions;
using test::TestCamera;

static_assert(is_ego_motion<EpipolarMotion, TestCamera>::value);
static_assert(!is_ego_motion<int, TestCamera>::value);

Motion estimate(const EpipolarMotion& policy, const Matches& matches, const Regions& regions = {}) {
  Workspace workspace;
  return policy.estimate(test::observations_of(matches, regions), test::test_camera(), MotionPrior{}, workspace);
}

const Pose kMotion = test::pose_of({0.02, -0.03, 0.01}, {0.05, -0.02, 0.03});

TEST(EpipolarMotion, KnownMotionComesBackWithItsLength) {
  Random random(1);
  const Matches matches = test::make_matches(kMotion, {}, random);
  for (const auto solver : {EpipolarMotion::Solver::seven, EpipolarMotion::Solver::eight}) {
    EpipolarMotion policy;
    policy.options.solver = solver;
    const Motion motion = estimate(policy, matches);
    ASSERT_EQ(motion.status, Status::ok);
    EXPECT_EQ(motion.candidates, 200);
    EXPECT_EQ(motion.inliers, 200);
    EXPECT_LT(test::rotation_error(motion.current_from_reference, kMotion), 1e-7);     // rounding
    EXPECT_LT(test::translation_error(motion.current_from_reference, kMotion), 1e-6);  // rounding over the baseline
  }
}

TEST(EpipolarMotion, EightMatchesAreEnoughAndSevenAreNot) {
  Random random(2);
  EpipolarMotion policy;
  const Motion eight = estimate(policy, test::make_matches(kMotion, {8}, random));
  ASSERT_EQ(eight.status, Status::ok);
  EXPECT_LT(test::rotation_error(eight.current_from_reference, kMotion), 1e-5);
  for (const std::size_t count : {0u, 1u, 2u, 7u})
    EXPECT_EQ(estimate(policy, test::make_matches(kMotion, {count}, random)).status, Status::too_few_matches);
}

TEST(EpipolarMotion, PrintedEq3GivesAWrongMotion) {
  Random random(3);
  const Matches matches = test::make_matches(kMotion, {}, random);
  EpipolarMotion policy;
  policy.options.printed_eq3 = true;
  const Motion motion = estimate(policy, matches);
  EXPECT_GT(test::rotation_error(motion.current_from_reference, kMotion) +
                test::translation_error(motion.current_from_reference, kMotion),
            0.02);
}

TEST(EpipolarMotion, OneCentimetreHasItsLengthAndUnitTranslationHasNot) {
  // At 1 to 4 m, 1 cm to the side is 525 · 0.01 / z = 1.3 to 5.3 px of parallax.
  Random random(4);
  const Pose step = test::pose_of(Vector3d::Zero(), {0.01, 0, 0});
  const Matches matches = test::make_matches(step, {}, random);
  EpipolarMotion policy;
  const Motion motion = estimate(policy, matches);
  ASSERT_EQ(motion.status, Status::ok);
  EXPECT_LT(test::translation_error(motion.current_from_reference, step), 1e-6);
  policy.options.unit_translation = true;
  const Motion unit = estimate(policy, matches);
  ASSERT_EQ(unit.status, Status::ok);
  EXPECT_NEAR(unit.current_from_reference.translation().norm(), 1.0, 1e-9);
  EXPECT_GT(unit.current_from_reference.translation().x(), 0.99);
}

TEST(EpipolarMotion, RandomScenesWithNoiseAndAMover) {
  EpipolarMotion policy;
  policy.options.threshold_px = 0.6;  // 3 σ of 0.2 px
  int right = 0, within_covariance = 0;
  double squared_errors = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 0.05, 0.1);
    SceneOptions scene;
    scene.count = 300;
    scene.pixel_noise_px = 0.2 / std::sqrt(2.0);
    scene.depth_noise_share = 0.005;
    scene.mover_share = 0.3;
    scene.mover = test::pose_of({0.02, 0.05, 0.0}, {0.2, 0.1, 0.1});
    const Motion motion = estimate(policy, test::make_matches(truth, scene, random));
    if (motion.status != Status::ok) continue;
    right += test::rotation_error(motion.current_from_reference, truth) < 0.01 &&
             test::translation_error(motion.current_from_reference, truth) < 0.03;
    Vector6d error;
    const Matrix3d turn = truth.linear() * motion.current_from_reference.linear().transpose();
    error << turn(2, 1), turn(0, 2), turn(1, 0),
        truth.translation() - turn * motion.current_from_reference.translation();
    const double squared = error.dot(motion.covariance.ldlt().solve(error));
    within_covariance += squared < 6 * 4.0;  // E = 6; twice σ in every axis
    squared_errors += squared;
  }
  EXPECT_GE(right, 95);
  EXPECT_GE(within_covariance, 35);  // the covariance is a lower bound
  EXPECT_GT(squared_errors / 100, 3.0) << "half of what an honest covariance gives: no more than that too large";
}

TEST(EpipolarMotion, StationaryCameraAndPureRotationAreNamedAndHaveNoTranslation) {
  for (const Vector3d& omega : {Vector3d(0, 0, 0), Vector3d(0.03, -0.05, 0.02)}) {
    for (const double noise : {0.0, 0.1}) {
      Random random(5);
      SceneOptions scene;
      scene.pixel_noise_px = noise;
      scene.mover_share = 0.3;
      scene.mover = test::pose_of({0, 0.1, 0}, {0.2, 0, 0});
      const Pose truth = test::pose_of(omega, Vector3d::Zero());
      const Motion motion = estimate(EpipolarMotion{}, test::make_matches(truth, scene, random));
      ASSERT_EQ(motion.status, Status::ok);
      ASSERT_TRUE(motion.warnings.has(Warning::rotation_only));
      EXPECT_TRUE(motion.usable());
      EXPECT_LT(test::rotation_error(motion.current_from_reference, truth), noise > 0 ? 5e-4 : 1e-7);
      EXPECT_EQ(motion.current_from_reference.translation().norm(), 0.0);
      EXPECT_TRUE(motion.covariance.allFinite());
    }
  }
}

TEST(EpipolarMotion, AStepOfMillimetresIsNoRotationWhereMatchesAreGood) {
  // Parallax 525 · 0.004 / z = 0.5 to 2 px: a rotation that takes the mean over leaves less than 0.5 px on most.
  const Pose step = test::pose_of({0.002, -0.001, 0.001}, {0.004, 0.001, -0.001});
  SceneOptions scene;
  scene.pixel_noise_px = 0.02;
  scene.near_m = 1.5;
  int judged_whole = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const Motion motion = estimate(EpipolarMotion{}, test::make_matches(step, scene, random));
    judged_whole += motion.status == Status::ok && test::translation_error(motion.current_from_reference, step) < 0.002;
  }
  EXPECT_GE(judged_whole, 19);
}

TEST(EpipolarMotion, DegenerateScenesAreNamed) {
  Random random(6);
  SceneOptions plane;
  plane.plane = true;
  EXPECT_EQ(estimate(EpipolarMotion{}, test::make_matches(kMotion, plane, random)).status, Status::degenerate_geometry);
  plane.pixel_noise_px = 0.02;
  EXPECT_EQ(estimate(EpipolarMotion{}, test::make_matches(kMotion, plane, random)).status, Status::degenerate_geometry);
  SceneOptions line;
  line.line = true;
  const Motion on_line = estimate(EpipolarMotion{}, test::make_matches(kMotion, line, random));
  EXPECT_EQ(on_line.status, Status::degenerate_geometry);
  Matches same = test::make_matches(kMotion, {50}, random);
  for (std::size_t i = 0; i < same.size(); ++i) {
    same.current.undistorted[i] = same.current.undistorted[0];
    same.reference.undistorted[i] = same.reference.undistorted[0];
  }
  EXPECT_EQ(estimate(EpipolarMotion{}, same).status, Status::degenerate_geometry);
}

TEST(EpipolarMotion, RandomMatchesAreNoConsensus) {
  Random random(7);
  Matches matches = test::make_matches(kMotion, {100}, random);
  for (Vector2d& pixel : matches.current.undistorted) pixel = {random.uniform(0, 640), random.uniform(0, 480)};
  EXPECT_EQ(estimate(EpipolarMotion{}, matches).status, Status::no_consensus);
}

TEST(EpipolarMotion, WithoutDepthThereIsNoLength) {
  Random random(8);
  Matches matches = test::make_matches(kMotion, {}, random);
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < matches.size(); ++i) matches.current.set_depth(i, kNaN, kNaN, test::test_camera());
  EXPECT_EQ(estimate(EpipolarMotion{}, matches).status, Status::no_depth);
  EpipolarMotion unit;
  unit.options.unit_translation = true;
  EXPECT_EQ(estimate(unit, matches).status, Status::ok);
}

TEST(EpipolarMotion, AMoverOfSixtyPercentTakesThePose) {
  // What correction 14 of the method is about: the paper follows the majority, and says so nowhere.
  Random random(9);
  SceneOptions scene;
  scene.mover_share = 0.6;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Motion motion = estimate(EpipolarMotion{}, test::make_matches(kMotion, scene, random));
  ASSERT_EQ(motion.status, Status::ok);
  EXPECT_LT(test::translation_error(motion.current_from_reference, scene.mover * kMotion), 0.01);
}

TEST(EpipolarMotion, EqualSeedsGiveEqualMotions) {
  Random random(10);
  SceneOptions scene;
  scene.pixel_noise_px = 0.1;
  scene.mover_share = 0.3;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Matches matches = test::make_matches(kMotion, scene, random);
  const Motion a = estimate(EpipolarMotion{}, matches), b = estimate(EpipolarMotion{}, matches);
  EXPECT_EQ(a.current_from_reference.matrix(), b.current_from_reference.matrix());
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.inliers, b.inliers);
  EpipolarMotion another;
  bool differs = false;
  for (another.options.seed = 1; another.options.seed <= 10; ++another.options.seed)
    differs = differs || estimate(another, matches).covariance != a.covariance;
  EXPECT_TRUE(differs) << "the seed is an option";
}

TEST(EpipolarMotion, FewerInliersThanTheLeastShareAreNoConsensus) {
  Random random(11);
  SceneOptions scene;
  scene.mover_share = 0.4;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Matches matches = test::make_matches(kMotion, scene, random);
  EpipolarMotion policy;
  policy.options.min_inlier_share = 0.5;
  EXPECT_EQ(estimate(policy, matches).status, Status::ok);
  policy.options.min_inlier_share = 0.7;  // 60 % are static
  EXPECT_EQ(estimate(policy, matches).status, Status::no_consensus);
}

TEST(EpipolarMotion, NoParallaxAskedForIsNoRotation) {
  Random random(12);
  const Matches matches = test::make_matches(test::pose_of({0.03, -0.05, 0.02}, Vector3d::Zero()), {}, random);
  EpipolarMotion policy;
  EXPECT_TRUE(estimate(policy, matches).warnings.has(Warning::rotation_only));
  policy.options.min_parallax_px = 0;
  EXPECT_FALSE(estimate(policy, matches).warnings.has(Warning::rotation_only));
  policy.options.min_parallax_px = 0.5;
  policy.options.noise_sigmas = 0;  // within nothing of the matches' own noise nothing is simpler
  EXPECT_FALSE(estimate(policy, matches).warnings.has(Warning::rotation_only));
}

TEST(EpipolarMotion, TheRotationMustExplainItsShareOfWhatTheFundamentalMatrixDoes) {
  // A tenth of a pixel at 525 · 0.0004 / z: a third and more of the matches keep some parallax beyond the noise.
  Random random(13);
  SceneOptions scene;
  scene.near_m = 0.5;
  const Matches matches = test::make_matches(test::pose_of({0.03, -0.05, 0.02}, {0.0005, 0, 0}), scene, random);
  EpipolarMotion policy;
  policy.options.noise_sigmas = 100;
  policy.options.min_parallax_px = 0.15;
  policy.options.rotation_share = 0.2;
  EXPECT_TRUE(estimate(policy, matches).warnings.has(Warning::rotation_only));
  policy.options.rotation_share = 1.0;
  EXPECT_FALSE(estimate(policy, matches).warnings.has(Warning::rotation_only));
}

TEST(EpipolarMotion, APlaneThatIsNotAskedForIsNotDegenerate) {
  Random random(14);
  SceneOptions plane;
  plane.plane = true;
  plane.pixel_noise_px = 0.02;
  const Matches matches = test::make_matches(kMotion, plane, random);
  EpipolarMotion policy;
  EXPECT_EQ(estimate(policy, matches).status, Status::degenerate_geometry);
  policy.options.planar_share = 1.5;
  EXPECT_NE(estimate(policy, matches).status, Status::degenerate_geometry);
}

TEST(EpipolarMotion, FewerDepthsThanTheLeastGiveNoLength) {
  Random random(15);
  Matches matches = test::make_matches(kMotion, {}, random);
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 5; i < matches.size(); ++i) matches.current.set_depth(i, kNaN, kNaN, test::test_camera());
  EpipolarMotion policy;
  policy.options.min_depths = 5;
  EXPECT_EQ(estimate(policy, matches).status, Status::ok);
  policy.options.min_depths = 6;
  EXPECT_EQ(estimate(policy, matches).status, Status::no_depth);
}

TEST(EpipolarMotion, AMoverOfALowStaticPriorHasNoSay) {
  Random random(16);
  SceneOptions scene;
  scene.mover_share = 0.6;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Matches matches = test::make_matches(kMotion, scene, random);
  Observations observations = test::observations_of(matches);
  for (std::size_t i = 0; i < 120; ++i) observations.remembered.static_prior[i] = 0.3f;
  Workspace workspace;
  EpipolarMotion policy;
  policy.options.least_static_prior = 0.5f;
  const Motion motion = policy.estimate(observations, test::test_camera(), MotionPrior{}, workspace);
  ASSERT_EQ(motion.status, Status::ok);
  EXPECT_EQ(motion.candidates, 80);
  EXPECT_LT(test::translation_error(motion.current_from_reference, kMotion), 1e-5);
}

}  // namespace
}  // namespace stillpoint::epipolar_motion_test
