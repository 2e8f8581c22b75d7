// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What Ceres does for us: bundle adjustment and pose graph; and the removal of what deviates.

#include <gtest/gtest.h>

#include <cmath>

#include "made_map.hpp"
#include "slam/bundle_adjustment.hpp"
#include "slam/multi_view.hpp"
#include "slam/pose_graph.hpp"
#include "stillpoint/core/geometry.hpp"

namespace slam_test {
namespace {

constexpr int kViews = 4;

/// Exact measurements; the free poses and the points are moved away by some centimetres.
slam::BundleProblem disturbed_problem(double depth_share = 1.0) {
  const slam::Map map = made_map(made_points(50), kViews, 0.1);
  slam::BundleProblem problem = slam::MultiView(camera(), slam::MeasurementNoise{}).gather_all(map);
  stillpoint::Random random(3);
  for (std::size_t i = 1; i < problem.views.size(); ++i) {
    Pose& pose = problem.views[i].camera_from_world;
    pose.linear() = stillpoint::rotation_from_vector({0.02, -0.01, 0.03}) * pose.linear();
    pose.translation() += Vector3d(0.03, -0.02, 0.04);
  }
  for (slam::BundleProblem::Point& point : problem.points)
    for (int axis = 0; axis < 3; ++axis) point.p_world[axis] += 0.05 * (random.uniform() - 0.5);
  for (slam::BundleProblem::Measurement& measurement : problem.measurements)
    if (random.uniform() > depth_share) measurement.depth_m = 0;
  return problem;
}

void expect_true_poses(const slam::BundleProblem& problem, double tolerance_m) {
  for (int i = 0; i < kViews; ++i) {
    const Pose error = problem.views[static_cast<std::size_t>(i)].camera_from_world * camera_at(0.1 * i).inverse();
    EXPECT_LT(error.translation().norm() + stillpoint::rotation_angle(error.linear()), tolerance_m) << i;
  }
}

constexpr double kExact_m = 1e-5;

TEST(BundleAdjustment, FindsPosesAndPointsOfExactMeasurements) {
  slam::BundleProblem problem = disturbed_problem();
  slam::BundleOptions options;
  options.iterations = 50;
  slam::adjust(problem, camera(), options);
  expect_true_poses(problem, kExact_m);
  EXPECT_TRUE(problem.views[0].camera_from_world.isApprox(camera_at(0))) << "is fixed";
  const std::vector<Vector3d> points = made_points(50);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((problem.points[i].p_world - points[i]).norm(), 10 * kExact_m);
}

// Some depths give the scale; pixels alone leave it free.
TEST(BundleAdjustment, AFewDepthsGiveTheScale) {
  slam::BundleProblem problem = disturbed_problem(0.2);
  slam::BundleOptions options;
  options.iterations = 100;
  slam::adjust(problem, camera(), options);
  expect_true_poses(problem, 10 * kExact_m);
}

TEST(BundleAdjustment, NothingToAdjustIsNoError) {
  slam::BundleProblem problem;
  slam::adjust(problem, camera(), {});
  problem.views.push_back({0, camera_at(1)});
  slam::adjust(problem, camera(), {});
  EXPECT_TRUE(problem.views[0].camera_from_world.isApprox(camera_at(1)));
}

TEST(MultiView, LeavesOutWhatDeviatesAndNothingElse) {
  slam::BundleProblem problem = disturbed_problem();
  // Of 200 measurements ten are of something that has moved: by 20 px or by 60 cm in depth.
  for (std::size_t i = 0; i < problem.measurements.size(); ++i) {
    if (i % 20 != 7) continue;
    if (i % 40 == 7)
      problem.measurements[i].pixel.x() += 20;
    else
      problem.measurements[i].depth_m += 0.6;
  }
  slam::MultiView multi_view(camera(), slam::MeasurementNoise{});
  multi_view.options.rounds = 10;
  multi_view.options.iterations = 30;
  multi_view.converge(problem);
  for (std::size_t i = 0; i < problem.measurements.size(); ++i)
    EXPECT_EQ(problem.measurements[i].fits, i % 20 != 7) << i;
  expect_true_poses(problem, kExact_m);
}

TEST(MultiView, WhatDeviatesIsRemovedFromTheMap) {
  slam::Map map = made_map(made_points(50), kViews, 0.1);
  map.keyframe(2).pixel[9].y() += 15;
  const slam::MultiView multi_view(camera(), slam::MeasurementNoise{});
  slam::BundleProblem problem = multi_view.gather(3, map);
  multi_view.converge(problem);
  multi_view.apply(problem, map);
  EXPECT_EQ(map.point(9).observation_in(2), slam::kNone);
  EXPECT_EQ(map.keyframe(2).point[9], slam::kNone);
  EXPECT_EQ(map.point(9).observations.size(), 3u);
  EXPECT_EQ(map.point(8).observations.size(), 4u);
}

TEST(MultiView, KeyframesOutsideOfTheWindowHoldIt) {
  const slam::Map map = made_map(made_points(50), kViews, 0.1);
  slam::MultiView multi_view(camera(), slam::MeasurementNoise{});
  multi_view.options.window_keyframes = 2;
  const slam::BundleProblem problem = multi_view.gather(3, map);
  ASSERT_EQ(problem.views.size(), 4u);
  EXPECT_EQ(problem.views[0].keyframe, 3);
  EXPECT_FALSE(problem.views[0].is_fixed);
  EXPECT_TRUE(problem.views[2].is_fixed);
  EXPECT_TRUE(problem.views[3].is_fixed);
}

// Sixteen cameras in a ring, each of whose steps is wrong by 0.01 rad and 2 cm: as much of each as the weights expect.
// The error in height is spread evenly, which is right; of that in yaw a third stays, part of which is taken for
// translation.
TEST(PoseGraph, SpreadsTheErrorOfALoop) {
  constexpr int kCount = 16;
  constexpr double kTurn_rad = 2 * 3.14159265358979323846 / kCount;
  const auto step = [](double turn_rad, double climb_m) {
    Pose next_from_last = Pose::Identity();
    next_from_last.linear() = stillpoint::rotation_from_vector({0, turn_rad, 0});
    next_from_last.translation() = Vector3d(0, climb_m, -0.5);
    return next_from_last;
  };
  slam::PoseGraph graph;
  std::vector<Pose> truth(1, Pose::Identity());
  graph.nodes.push_back({0, Pose::Identity(), true});
  for (int i = 1; i < kCount; ++i) {
    truth.push_back(step(kTurn_rad, 0) * truth.back());
    const Pose wrong = step(kTurn_rad + 0.01, 0.02);
    graph.nodes.push_back({i, wrong * graph.nodes.back().camera_from_world, false});
    graph.edges.push_back({i, i - 1, wrong, 1.0});
  }
  graph.edges.push_back({0, kCount - 1, truth[0] * truth[kCount - 1].inverse(), 100.0});
  const auto worst_error_m = [&] {
    double worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      worst = std::max(
          worst, (graph.nodes[i].camera_from_world.inverse().translation() - truth[i].inverse().translation()).norm());
    return worst;
  };
  const double before_m = worst_error_m();
  slam::relax(graph);
  EXPECT_TRUE(graph.nodes[0].camera_from_world.isApprox(Pose::Identity()));
  EXPECT_LT(worst_error_m(), before_m / 4);
  const Pose end = graph.nodes[0].camera_from_world * graph.nodes[kCount - 1].camera_from_world.inverse();
  EXPECT_LT((end.translation() - graph.edges.back().a_from_b.translation()).norm(), 0.02);
}

TEST(PoseGraph, LeavesAGraphThatAgrees) {
  slam::PoseGraph graph;
  graph.nodes = {{0, camera_at(0), true}, {1, camera_at(1), false}};
  graph.edges = {{1, 0, camera_at(1), 1.0}};
  slam::relax(graph);
  EXPECT_TRUE(graph.nodes[1].camera_from_world.isApprox(camera_at(1), 1e-9));
}

}  // namespace
}  // namespace slam_test
