// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/support_problem.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "motion_scene.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::support_problem_test {
namespace {

using test::test_camera;

constexpr std::size_t kFrames = 3, kPoints = 30;
constexpr double kInlierSigmas = 4.0;
constexpr double kRounding = 1e-9;
const std::array<double, 2> kCutoffs{4.0, 3.0};

/// Points that each of three older frames shows, as one motion moved them or as another did.
struct Scene {
  const Pose first = test::pose_of({0.02, -0.03, 0.01}, {0.03, -0.02, 0.03});
  const Pose second = test::pose_of({0.02, -0.03, 0.01}, {-0.2, 0.1, 0.03});  // tens of pixels away
  std::array<Pose, kFrames> links = {Pose::Identity(), test::pose_of({0.0, 0.05, 0.0}, {0.1, 0.0, 0.0}),
                                     test::pose_of({-0.03, 0.0, 0.04}, {0.0, 0.1, -0.1})};
  std::array<Pose, kFrames> scratch, poses;
  std::vector<PointConstraint> points;
  std::vector<PlaneConstraint> planes;
  const test::TestCamera camera = test_camera();

  explicit Scene(std::size_t of_second) {
    Random random(7);
    for (std::size_t f = 0; f < kFrames; ++f) {
      poses[f] = links[f] * first;
      for (std::size_t k = 0; k < kPoints; ++k) {
        PointConstraint point;
        point.point =
            camera.back_project({random.uniform(150, 490), random.uniform(120, 360)}, random.uniform(1.5, 2.5));
        const Vector3d there = links[f] * ((k < of_second ? second : first) * point.point);
        point.pixel = camera.project(there);
        point.depth_m = there.z();
        point.depth_slope = 100.0;
        point.weight = k % 2 == 0 ? 1.0 : 0.5;
        point.frame = f;
        points.push_back(point);
      }
    }
  }

  SupportProblem<test::TestCamera> problem() { return {points, planes, poses, scratch, camera, kInlierSigmas}; }
};

/// Of the weights 1 and 0.5 in turn.
double weight_of(std::size_t count) { return static_cast<double>(kFrames) * 0.75 * static_cast<double>(count); }

TEST(SupportProblem, OnePoseSaysWhatAllOlderFramesShow) {
  Scene scene(0);
  const auto problem = scene.problem();
  EXPECT_EQ(problem.inliers(scene.first), static_cast<int>(kFrames * kPoints));
  EXPECT_EQ(problem.inliers(scene.second), 0);
  EXPECT_NEAR(problem.support(scene.first), weight_of(kPoints), kRounding);
  EXPECT_NEAR(problem.point_support(scene.first), problem.total_weight(), kRounding);
}

TEST(SupportProblem, NoAnswerDependsOnThePoseThatWasAskedBefore) {
  Scene scene(10);
  PlaneConstraint plane;
  plane.point = Vector3d(0.0, 0.0, 2.0);
  plane.target = scene.links[2] * (scene.first * plane.point);
  plane.slope = Vector3d(0.0, 0.0, 100.0);
  plane.frame = 2;
  scene.planes.push_back(plane);
  const auto problem = scene.problem();
  const double support = problem.support(scene.first);
  EXPECT_NEAR(support - problem.point_support(scene.first), 1.0, kRounding) << "the plane's";
  const int inliers = problem.inliers(scene.first);
  EXPECT_NE(problem.inliers(scene.second), inliers);
  EXPECT_EQ(problem.support(scene.first), support);
  problem.refined(scene.second, kCutoffs);
  EXPECT_EQ(problem.inliers(scene.first), inliers);
}

TEST(SupportProblem, ExclusiveSupportIsTheWeightThatOnlyOneMotionExplains) {
  constexpr std::size_t kOfSecond = 10;
  Scene scene(kOfSecond);
  const auto problem = scene.problem();
  Workspace workspace;
  const ExclusiveSupport apart = problem.exclusive_support(scene.first, scene.second, workspace);
  EXPECT_NEAR(apart.one, weight_of(kPoints - kOfSecond), kRounding);
  EXPECT_NEAR(apart.other, weight_of(kOfSecond), kRounding);
  const ExclusiveSupport exchanged = problem.exclusive_support(scene.second, scene.first, workspace);
  EXPECT_EQ(exchanged.one, apart.other);
  EXPECT_EQ(exchanged.other, apart.one);
  const ExclusiveSupport same = problem.exclusive_support(scene.first, scene.first, workspace);
  EXPECT_EQ(same.one, 0.0);
  EXPECT_EQ(same.other, 0.0);
}

}  // namespace
}  // namespace stillpoint::support_problem_test
