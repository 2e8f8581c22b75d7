// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies on depth from a stereo pair: the scenes are known, the depth is what block matching makes of them.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/stereo/stereo_depth.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "stillpoint/synthetic/stereo.hpp"
#include "unit/pipeline/scene_run.hpp"

namespace stillpoint {
namespace {

using scene_run::Outcome;
using scene_run::small;

Outcome run(const synthetic::Scene& scene) {
  constexpr double kBaseline_m = 0.11;
  SyntheticSequence right_sequence(synthetic::right_of(scene, kBaseline_m));
  StereoDepth stereo(scene.camera, kBaseline_m);
  FrameFilter<> filter(scene.camera);
  filter.depth_noise = stereo.noise();
  SyntheticFrame right;
  cv::Mat depth;
  int index = 0;
  return scene_run::run(scene, [&](const SyntheticFrame& left, std::vector<Vector2f>& pixels) -> const FrameResult& {
    right_sequence.render(index++, right);
    stereo.compute(as_mat(left.gray.view()), as_mat(right.gray.view()), depth);
    std::vector<cv::KeyPoint> found;
    cv::ORB::create(500)->detect(as_mat(left.gray.view()), found);
    for (const cv::KeyPoint& key_point : found) pixels.emplace_back(key_point.pt.x, key_point.pt.y);
    return filter.filter_frame(FrameView(left.gray.view(), depth, left.timestamp_s), pixels);
  });
}

TEST(FilterOnStereo, AStaticRoomStaysWithinTheSetRate) {
  const Outcome outcome = run(synthetic::static_room(small(30)));
  EXPECT_EQ(outcome.judged, outcome.frames);
  ASSERT_GT(outcome.score.background().features, 8000u);
  EXPECT_LE(outcome.score.false_positive_rate(), TailGate::Options{}.false_positive_rate);
}

TEST(FilterOnStereo, APushedBoxIsFound) {
  const Outcome outcome = run(synthetic::pushed_box(small(45)));
  EXPECT_EQ(outcome.judged, outcome.frames);
  ASSERT_GT(outcome.score.moving().features, 1000u);
  EXPECT_GE(outcome.score.recall(), 0.9);
  EXPECT_LE(outcome.score.false_positive_rate(), 0.02);
}

}  // namespace
}  // namespace stillpoint
