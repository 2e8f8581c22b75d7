// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "motion_scene.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::rigid_motion_test {
namespace {

using test::SceneOptions;
using test::TestCamera;

static_assert(is_ego_motion<RigidMotion, TestCamera>::value);
static_assert(is_ransac_estimator<RigidEstimator>::value);

Motion estimate(const RigidMotion& policy, const Matches& matches, const Regions& regions = {}) {
  Workspace workspace;
  return policy.estimate(test::observations_of(matches, regions), test::test_camera(), MotionPrior{}, workspace);
}

const Pose kMotion = test::pose_of({0.02, -0.03, 0.01}, {0.05, -0.02, 0.03});

TEST(RigidMotion, KnownMotionComesBackOnAnyScene) {
  const Pose still = Pose::Identity(), turn = test::pose_of({0.1, -0.2, 0.05}, Vector3d::Zero());
  for (const Pose& truth : {kMotion, still, turn}) {
    for (const bool plane : {false, true}) {
      Random random(1);
      SceneOptions scene;
      scene.plane = plane;
      const Motion motion = estimate(RigidMotion{}, test::make_matches(truth, scene, random));
      ASSERT_EQ(motion.status, Status::ok);
      EXPECT_EQ(motion.candidates, 200);
      EXPECT_EQ(motion.inliers, 200);
      EXPECT_LT(test::rotation_error(motion.current_from_reference, truth), 1e-9);     // rounding
      EXPECT_LT(test::translation_error(motion.current_from_reference, truth), 1e-9);  // rounding
    }
  }
}

TEST(RigidMotion, CovarianceIsThatOfTheErrors) {
  // The errors' squared Mahalanobis distance has mean 6 if the covariance is theirs. The estimate's own inlier rule and
  // weights let it be somewhat larger; a factor of two either way would be a wrong covariance.
  double sum = 0.0;
  constexpr int kScenes = 200;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 0.05, 0.05);
    SceneOptions scene;
    scene.pixel_noise_px = 0.5;
    scene.depth_noise_share = 0.01;
    RigidMotion policy;
    policy.options.pixel_sigma_px = 0.5;
    const Motion motion = estimate(policy, test::make_matches(truth, scene, random));
    ASSERT_EQ(motion.status, Status::ok);
    const Matrix3d turn = truth.linear() * motion.current_from_reference.linear().transpose();
    const Eigen::AngleAxisd rotation(turn);
    Vector6d error;  // truth = Exp(ω) estimate, then v
    error << rotation.angle() * rotation.axis(),
        truth.translation() - turn * motion.current_from_reference.translation();
    sum += error.dot(motion.covariance.ldlt().solve(error)) / kScenes;
  }
  EXPECT_GT(sum, 3.0);
  EXPECT_LT(sum, 12.0);
}

TEST(RigidMotion, AMoverOfFortyPercentIsLeftOut) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 0.05, 0.05);
    SceneOptions scene;
    scene.pixel_noise_px = 0.5;
    scene.depth_noise_share = 0.01;
    scene.mover_share = 0.4;
    scene.mover = test::pose_of({0.0, 0.1, 0.0}, {0.3, 0.1, 0.0});
    const Motion motion = estimate(RigidMotion{}, test::make_matches(truth, scene, random));
    ASSERT_EQ(motion.status, Status::ok);
    EXPECT_LT(test::rotation_error(motion.current_from_reference, truth), 0.005) << seed;    // 10 σ
    EXPECT_LT(test::translation_error(motion.current_from_reference, truth), 0.02) << seed;  // 10 σ
  }
}

TEST(RigidMotion, AMoverOfSixtyPercentTakesThePoseUnlessThePriorKnowsIt) {
  Random random(2);
  SceneOptions scene;
  scene.mover_share = 0.6;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Matches matches = test::make_matches(kMotion, scene, random);
  EXPECT_LT(test::translation_error(estimate(RigidMotion{}, matches).current_from_reference, scene.mover * kMotion),
            1e-6);
  Regions regions;
  regions.of_feature.assign(matches.size(), Membership{});
  for (std::size_t i = 0; i < 120; ++i) regions.of_feature[i].in_dynamic = true;
  const Motion motion = estimate(RigidMotion{}, matches, regions);
  EXPECT_EQ(motion.candidates, 80);
  EXPECT_LT(test::translation_error(motion.current_from_reference, kMotion), 1e-9);
}

TEST(RigidMotion, TooFewOrDegenerateMatchesAreNamed) {
  Random random(3);
  for (const std::size_t count : {0u, 1u, 2u})
    EXPECT_EQ(estimate(RigidMotion{}, test::make_matches(kMotion, {count}, random)).status, Status::too_few_matches);
  EXPECT_EQ(estimate(RigidMotion{}, test::make_matches(kMotion, {3}, random)).status, Status::ok);

  Matches deep = test::make_matches(kMotion, {50}, random);
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < deep.size(); ++i) deep.reference.set_depth(i, kNaN, kNaN, test::test_camera());
  EXPECT_EQ(estimate(RigidMotion{}, deep).status, Status::no_depth);

  Matches same = test::make_matches(kMotion, {50}, random);
  for (std::size_t i = 0; i < same.size(); ++i) {
    same.current.point[i] = same.current.point[0];
    same.reference.point[i] = same.reference.point[0];
  }
  EXPECT_EQ(estimate(RigidMotion{}, same).status, Status::degenerate_geometry);

  for (const double noise : {0.0, 0.2}) {
    SceneOptions line;
    line.line = true;
    line.pixel_noise_px = noise;
    EXPECT_EQ(estimate(RigidMotion{}, test::make_matches(kMotion, line, random)).status, Status::degenerate_geometry);
  }

  Matches wild = test::make_matches(kMotion, {100}, random);
  for (std::size_t i = 0; i < wild.size(); ++i) {
    wild.current.undistorted[i] = {random.uniform(0, 640), random.uniform(0, 480)};
    wild.current.set_depth(i, random.uniform(1, 4), 0.01, test::test_camera());
  }
  EXPECT_EQ(estimate(RigidMotion{}, wild).status, Status::no_consensus);
}

TEST(RigidMotion, EqualSeedsGiveEqualMotions) {
  Random random(4);
  SceneOptions scene;
  scene.pixel_noise_px = 0.5;
  scene.mover_share = 0.4;
  scene.mover = test::pose_of({0, 0.05, 0}, {0.2, 0, 0.05});
  const Matches matches = test::make_matches(kMotion, scene, random);
  const Motion a = estimate(RigidMotion{}, matches), b = estimate(RigidMotion{}, matches);
  EXPECT_EQ(a.current_from_reference.matrix(), b.current_from_reference.matrix());
  EXPECT_EQ(a.covariance, b.covariance);
  RigidMotion another;
  bool differs = false;
  for (another.options.seed = 1; another.options.seed <= 10; ++another.options.seed)
    differs = differs || estimate(another, matches).covariance != a.covariance;
  EXPECT_TRUE(differs) << "the seed is an option";
}

}  // namespace
}  // namespace stillpoint::rigid_motion_test
