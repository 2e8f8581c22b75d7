// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "backends/odometry.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace odometry_test {
namespace {

using examples::OrbFeatures;
using examples::RgbdOdometry;
using stillpoint::Pose;

using stillpoint::synthetic::Scene;

/// One frame of a scene, and how many of its features the tracker is given at most.
struct Step {
  int index;
  std::size_t features = 1000;
};

struct Tracked {
  std::optional<Pose> world_from_camera;
  double error_m = 0.0;  ///< of the position, by the camera of frame 0
};

/// @param depth_stride  every n-th pixel of the depth image is left, in both directions
std::vector<Tracked> track(const std::vector<Step>& steps, const Scene& scene = stillpoint::synthetic::static_room(),
                           int depth_stride = 1) {
  stillpoint::SyntheticSequence sequence(scene);
  stillpoint::SyntheticFrame frame;
  RgbdOdometry odometry(sequence.camera());
  std::vector<Tracked> tracked;
  Pose first_from_world = Pose::Identity();
  for (const Step& step : steps) {
    sequence.render(step.index, frame);
    if (tracked.empty()) first_from_world = frame.world_from_camera.inverse();
    cv::Mat depth;
    cv::resize(stillpoint::as_mat(frame.depth.view()), depth, {}, 1.0 / depth_stride, 1.0 / depth_stride,
               cv::INTER_NEAREST);
    const stillpoint::FrameView view(frame.gray.view(), stillpoint::DepthView(depth, frame.depth_factor),
                                     frame.timestamp_s);
    OrbFeatures features = odometry.extract(view);
    std::vector<std::uint8_t> keep(features.keypoints.size(), 1);
    for (std::size_t i = step.features; i < keep.size(); ++i) keep[i] = 0;
    features.compact(keep);
    Tracked result{odometry.track(view, features)};
    if (result.world_from_camera) {
      const Pose truth = first_from_world * frame.world_from_camera;
      result.error_m = (truth.translation() - result.world_from_camera->translation()).norm();
    }
    tracked.push_back(result);
  }
  return tracked;
}

constexpr double kDrift_m = 0.005;  // of a second; the depth of a point at 2 m is 6 mm uncertain, of 1000 far less

TEST(RgbdOdometry, FollowsTheCamera) {
  std::vector<Step> steps;
  for (int i = 0; i < 30; ++i) steps.push_back({i});
  for (const Tracked& tracked : track(steps)) {
    ASSERT_TRUE(tracked.world_from_camera);
    EXPECT_LT(tracked.error_m, kDrift_m);
  }
}

TEST(RgbdOdometry, TakesDepthOfHalfTheSize) {
  for (const Tracked& tracked : track({{0}, {5}, {10}, {15}}, stillpoint::synthetic::static_room(), 2)) {
    ASSERT_TRUE(tracked.world_from_camera);
    EXPECT_LT(tracked.error_m, kDrift_m);
  }
}

// Nothing is filtered: people and a box have their share of the features, and where they have more than the room the
// best pose is theirs. The camera moves some 7 mm a frame.
TEST(RgbdOdometry, DoesNotJumpFromTheRoomToAMover) {
  std::vector<Step> steps;
  for (int i = 0; i < 60; ++i) steps.push_back({i});
  const std::vector<Tracked> tracked = track(steps, stillpoint::synthetic::demo());
  for (std::size_t i = 1; i < tracked.size(); ++i) {
    ASSERT_TRUE(tracked[i].world_from_camera && tracked[i - 1].world_from_camera) << i;
    const Pose step = tracked[i - 1].world_from_camera->inverse() * *tracked[i].world_from_camera;
    EXPECT_LT(step.translation().norm(), 0.05) << i;
  }
}

TEST(RgbdOdometry, FramesWithFewFeaturesHaveNoPose) {
  for (const std::size_t left : {std::size_t{0}, std::size_t{5}, std::size_t{11}}) {
    const std::vector<Tracked> tracked = track({{0}, {1}, {2, left}, {3, left}, {4}});
    EXPECT_FALSE(tracked[2].world_from_camera);
    EXPECT_FALSE(tracked[3].world_from_camera);
    ASSERT_TRUE(tracked[4].world_from_camera);
    EXPECT_LT(tracked[4].error_m, kDrift_m);
  }
}

// In a second and a half the camera turns by 0.45 rad, 250 px of its picture: no prediction leads there.
TEST(RgbdOdometry, ALostCameraIsFoundAgainElsewhere) {
  const std::vector<Tracked> tracked = track({{0}, {1}, {2, 0}, {45}, {46}}, stillpoint::synthetic::pure_rotation());
  EXPECT_FALSE(tracked[2].world_from_camera);
  for (const std::size_t i : {std::size_t{3}, std::size_t{4}}) {
    ASSERT_TRUE(tracked[i].world_from_camera);
    EXPECT_LT(tracked[i].error_m, 2 * kDrift_m);  // half of the features are in both views
  }
}

TEST(RgbdOdometry, AnotherRoomIsNoPose) {
  stillpoint::synthetic::SceneOptions other;
  other.seed += 1000;
  stillpoint::SyntheticSequence room(stillpoint::synthetic::static_room());
  stillpoint::SyntheticSequence elsewhere(stillpoint::synthetic::static_room(other));
  RgbdOdometry odometry(room.camera());
  stillpoint::SyntheticFrame frame;
  const auto track = [&](stillpoint::SyntheticSequence& sequence, int index) {
    sequence.render(index, frame);
    const stillpoint::FrameView view(frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor),
                                     frame.timestamp_s);
    return odometry.track(view, odometry.extract(view));
  };
  EXPECT_TRUE(track(room, 0));
  EXPECT_FALSE(track(elsewhere, 60));
  EXPECT_TRUE(track(room, 2));
}

TEST(RgbdOdometry, EqualFramesGiveEqualBytes) {
  const std::vector<Step> steps = {{0}, {1}, {2, 0}, {30}, {31}, {32}};
  const std::vector<Tracked> first = track(steps), second = track(steps);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].world_from_camera.has_value(), second[i].world_from_camera.has_value());
    if (first[i].world_from_camera) {
      EXPECT_TRUE(first[i].world_from_camera->matrix() == second[i].world_from_camera->matrix());
    }
  }
}

}  // namespace
}  // namespace odometry_test
