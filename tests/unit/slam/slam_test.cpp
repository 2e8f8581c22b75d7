// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "slam/slam.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace slam_test {
namespace {

using stillpoint::Pose;

/// A frame of the static room, and what the SLAM is given of it.
struct Step {
  int index;
  std::size_t features = 10000;  ///< at most
  bool has_depth = true;
};

struct Outcome {
  std::vector<std::optional<Pose>> live;
  stillpoint::Trajectory trajectory;
  stillpoint::Trajectory truth;  ///< by the camera of the first frame
};

examples::slam::SlamOptions in_step() {
  examples::slam::SlamOptions options;
  options.maps_in_step = true;
  return options;
}

Outcome run(const std::vector<Step>& steps, const examples::slam::SlamOptions& options) {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::static_room());
  stillpoint::SyntheticFrame frame;
  examples::slam::Slam slam(sequence.camera(), options);
  Outcome result;
  Pose first_from_world = Pose::Identity();
  for (const Step& step : steps) {
    sequence.render(step.index, frame);
    if (result.truth.empty()) first_from_world = frame.world_from_camera.inverse();
    stillpoint::FrameView view(frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor),
                               frame.timestamp_s);
    if (!step.has_depth) view.depth = {};
    auto features = slam.extract(view);
    std::vector<std::uint8_t> keep(features.keypoints.size(), 1);
    for (std::size_t i = step.features; i < keep.size(); ++i) keep[i] = 0;
    features.compact(keep);
    result.live.push_back(slam.track(view, features));
    result.truth.push_back({frame.timestamp_s, first_from_world * frame.world_from_camera});
  }
  result.trajectory = slam.trajectory();
  return result;
}

double error_m(const Pose& found, const Pose& truth) { return (found.translation() - truth.translation()).norm(); }

// The depth of a point at 2 m is 6 mm uncertain (KinectNoise); a hundred of them make a pose ten times better. As much
// again for the keyframe that it hangs on.
constexpr double kError_m = 2 * 0.006;

std::vector<Step> frames(int first, int last) {
  std::vector<Step> steps;
  for (int i = first; i <= last; ++i) steps.push_back({i});
  return steps;
}

TEST(Slam, FollowsTheCamera) {
  const Outcome found = run(frames(0, 19), in_step());
  ASSERT_EQ(found.trajectory.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    ASSERT_TRUE(found.live[i]) << i;
    EXPECT_LT(error_m(*found.live[i], found.truth[i].world_from_camera), kError_m) << i;
    EXPECT_LT(error_m(found.trajectory[i].world_from_camera, found.truth[i].world_from_camera), kError_m) << i;
    EXPECT_EQ(found.trajectory[i].timestamp_s, found.truth[i].timestamp_s);
  }
}

TEST(Slam, InStepEqualFramesGiveEqualBytes) {
  const Outcome first = run(frames(0, 9), in_step()), second = run(frames(0, 9), in_step());
  ASSERT_EQ(first.trajectory.size(), second.trajectory.size());
  for (std::size_t i = 0; i < first.trajectory.size(); ++i)
    EXPECT_TRUE(first.trajectory[i].world_from_camera.matrix() == second.trajectory[i].world_from_camera.matrix());
}

TEST(Slam, MapsInAThreadOfItsOwn) {
  const Outcome found = run(frames(0, 9), {});
  ASSERT_EQ(found.trajectory.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_LT(error_m(found.trajectory[i].world_from_camera, found.truth[i].world_from_camera), kError_m) << i;
}

TEST(Slam, EndsAtAnyFrame) {
  for (int last = 0; last < 3; ++last) {
    stillpoint::SyntheticSequence sequence(stillpoint::synthetic::static_room());
    stillpoint::SyntheticFrame frame;
    examples::slam::Slam slam(sequence.camera(), {});
    for (int i = 0; i <= 10 * last; i += 10) {
      sequence.render(i, frame);
      const stillpoint::FrameView view(frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor),
                                       frame.timestamp_s);
      slam.track(view, slam.extract(view));
    }
  }  // nobody waits for mapping
}

TEST(Slam, FramesWithoutAPoseHaveNoRow) {
  const Outcome found = run({{0}, {1}, {2, 0}, {3, 11}, {4}}, in_step());
  EXPECT_FALSE(found.live[2]);
  EXPECT_FALSE(found.live[3]);
  ASSERT_TRUE(found.live[4]);
  EXPECT_EQ(found.trajectory.size(), 3u);
  EXPECT_LT(error_m(*found.live[4], found.truth[4].world_from_camera), kError_m);
}

TEST(Slam, BeginsWithTheFirstFrameThatHasDepth) {
  const Outcome found = run({{0, 10000, false}, {1}, {2}}, in_step());
  EXPECT_FALSE(found.live[0]);
  ASSERT_TRUE(found.live[1]);
  EXPECT_TRUE(found.live[1]->matrix().isIdentity());
  EXPECT_TRUE(found.live[2]);
}

// Twenty frames on, no prediction helps: the index of places knows where the camera is.
TEST(Slam, FindsItsWayBack) {
  const Outcome found = run({{0}, {1}, {2, 0}, {22}, {23}}, in_step());
  EXPECT_FALSE(found.live[2]);
  ASSERT_TRUE(found.live[3]);
  EXPECT_LT(error_m(*found.live[3], found.truth[3].world_from_camera), 2 * kError_m);
  ASSERT_TRUE(found.live[4]);
}

TEST(Slam, GoesOnWhereItWasLost) {
  std::vector<Step> steps = {{0}, {1}};
  for (int i = 0; i < 16; ++i) steps.push_back({2, 0});
  steps.push_back({2});
  examples::slam::SlamOptions options = in_step();
  const Outcome found = run(steps, options);
  for (std::size_t i = 2; i < 18; ++i) EXPECT_FALSE(found.live[i]) << i;
  ASSERT_TRUE(found.live[18]);
  EXPECT_LT(error_m(*found.live[18], found.truth[18].world_from_camera), 0.02);
}

TEST(Slam, TheRowsOfTheAblationRun) {
  for (int row = 0; row < 2; ++row) {
    examples::slam::SlamOptions options = in_step();
    options.uses_multi_view = row != 0;
    options.uses_bundle = row != 1;
    options.uses_loops = false;
    const Outcome found = run(frames(0, 9), options);
    ASSERT_EQ(found.trajectory.size(), 10u);
    EXPECT_LT(error_m(found.trajectory[9].world_from_camera, found.truth[9].world_from_camera), 2 * kError_m) << row;
  }
}

}  // namespace
}  // namespace slam_test
