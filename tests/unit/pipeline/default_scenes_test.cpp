// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies, as they come, on synthetic scenes of which the whole truth is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/features2d.hpp>
#include <vector>

#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint {
namespace {

enum class Prior { none, boxes };

/// How the filter did on one scene.
struct Outcome {
  FilterScore score;
  int judged = 0, frames = 0;
  double worst_position_m = 0;  ///< of the chained motions, from the first frame on
};

std::vector<Vector2f> corners(const SyntheticFrame& frame) {
  const ImageView gray = frame.gray.view();
  const cv::Mat image(gray.height, gray.width, CV_8UC1, const_cast<std::uint8_t*>(gray.data), gray.stride_bytes);
  std::vector<cv::KeyPoint> found;
  cv::ORB::create(500)->detect(image, found);
  std::vector<Vector2f> pixels;
  for (const cv::KeyPoint& keypoint : found) pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
  return pixels;
}

Outcome run(const synthetic::Scene& scene, FrameFilter<>& filter, Prior prior = Prior::none) {
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  Outcome outcome;
  Pose first_from_world = Pose::Identity(), first_from_camera = Pose::Identity();
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    filter.prior.detections.clear();
    for (const synthetic::TruthBox& box : frame.boxes) {
      if (prior == Prior::none || box.class_name == synthetic::kUnknownClass) continue;
      const Box extent{static_cast<float>(box.x), static_cast<float>(box.y), static_cast<float>(box.width),
                       static_cast<float>(box.height)};
      filter.prior.detections.push_back({extent, Mobility::dynamic, 1.0f});
    }
    const std::vector<Vector2f> pixels = corners(frame);
    const FrameResult& result = filter.filter_frame(frame.view(), pixels);
    outcome.score.add_frame(frame.labels.view(), pixels, result.keep());
    const Pose camera_from_world = frame.world_from_camera.inverse();
    if (f == 0) {
      first_from_world = camera_from_world;
    } else {
      ++outcome.frames;
      outcome.judged += judged(result.status());
      first_from_camera = first_from_camera * result.motion().current_from_reference.inverse();
      outcome.worst_position_m = std::max(
          outcome.worst_position_m,
          (first_from_camera.translation() - (first_from_world * frame.world_from_camera).translation()).norm());
    }
  }
  return outcome;
}

synthetic::SceneOptions small(int frames, std::uint64_t seed = 1) {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frames = frames;
  options.seed = seed;
  return options;
}

void expect_all_judged(const Outcome& outcome) { EXPECT_EQ(outcome.judged, outcome.frames); }

// If each standing feature were dropped with the rate p, the count of n would stay below np + 3 √(np (1 − p)) in 999 of
// 1000 cases.
TEST(DefaultScenes, AStaticRoomHoldsTheSetRate) {
  for (const double rate : {0.01, 0.05}) {
    std::size_t features = 0, dropped = 0;
    for (const std::uint64_t seed : {1u, 2u}) {
      const synthetic::Scene scene = synthetic::static_room(small(25, seed));
      FrameFilter<> filter(scene.camera);
      filter.gate.options.false_positive_rate = rate;
      const Outcome outcome = run(scene, filter);
      expect_all_judged(outcome);
      features += outcome.score.background().features;
      dropped += outcome.score.background().dropped;
    }
    const double expected = rate * static_cast<double>(features);
    ASSERT_GT(features, 5000u);
    EXPECT_LE(static_cast<double>(dropped), expected + 3 * std::sqrt(expected * (1 - rate))) << "rate " << rate;
  }
}

TEST(DefaultScenes, ABoxThatNoDetectorKnowsIsFound) {
  const synthetic::Scene scene = synthetic::pushed_box(small(60));
  FrameFilter<> filter(scene.camera);
  const Outcome outcome = run(scene, filter);
  expect_all_judged(outcome);
  ASSERT_GT(outcome.score.moving().features, 1000u);
  EXPECT_GE(outcome.score.recall(), 0.75);
  EXPECT_LE(outcome.score.false_alarms(), 0.01);
}

TEST(DefaultScenes, WalkingPeopleInBoxesAreFound) {
  const synthetic::Scene scene = synthetic::walking_people(small(60));
  FrameFilter<> filter(scene.camera);
  const Outcome outcome = run(scene, filter, Prior::boxes);
  expect_all_judged(outcome);
  ASSERT_GT(outcome.score.moving().features, 1000u);
  EXPECT_GE(outcome.score.recall(), 0.80);
  EXPECT_LE(outcome.score.false_alarms(), 0.025);
}

TEST(DefaultScenes, ATurningCameraDoesNoHarm) {
  const synthetic::Scene scene = synthetic::pure_rotation(small(40));
  FrameFilter<> filter(scene.camera);
  const Outcome outcome = run(scene, filter);
  expect_all_judged(outcome);
  EXPECT_LE(outcome.score.false_alarms(), 0.01);
  EXPECT_LE(outcome.worst_position_m, 0.015);
}

TEST(DefaultScenes, AStandingCameraDoesNoHarm) {
  const synthetic::Scene scene = synthetic::standing_camera(small(40));
  FrameFilter<> filter(scene.camera);
  const Outcome outcome = run(scene, filter);
  expect_all_judged(outcome);
  EXPECT_GE(outcome.score.recall(), 0.75);
  EXPECT_LE(outcome.score.false_alarms(), 0.025);
}

// The forearm waves after one second; the rest of the person sits.
TEST(DefaultScenes, AHandThatWavesIsFoundAndTheSitterKept) {
  const synthetic::Scene scene = synthetic::waving_hand(small(75));
  FrameFilter<> filter(scene.camera);
  const Outcome outcome = run(scene, filter);
  expect_all_judged(outcome);
  ASSERT_GT(outcome.score.moving().features, 200u);
  EXPECT_GE(outcome.score.recall(), 0.45);
  EXPECT_LE(outcome.score.parked_dropped(), 0.1);
  EXPECT_LE(outcome.score.false_alarms(), 0.01);
}

}  // namespace
}  // namespace stillpoint
