// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// MonocularPolicies on synthetic scenes whose depth is withheld.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>
#include <vector>

#include "scene_run.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::monocular_test {
namespace {

using scene_run::Outcome;
using scene_run::small;

Outcome run(const synthetic::Scene& scene, bool with_boxes) {
  FrameFilter<MonocularPolicies> filter(scene.camera);
  const auto orb = cv::ORB::create(500);
  return scene_run::run(scene, [&](const SyntheticFrame& frame, std::vector<Vector2f>& pixels) -> const FrameResult& {
    for (const synthetic::TruthBox& box : frame.boxes) {
      if (!with_boxes || box.class_name == synthetic::kUnknownClass) continue;
      filter.prior.detections.push_back({{static_cast<float>(box.x), static_cast<float>(box.y),
                                          static_cast<float>(box.width), static_cast<float>(box.height)},
                                         Mobility::dynamic,
                                         1.0f});
    }
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(as_mat(frame.gray.view()), keypoints);
    for (const cv::KeyPoint& keypoint : keypoints) pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
    FrameView view = frame.view();
    view.depth = DepthView();
    const FrameResult& result = filter.filter_frame(view, pixels);
    if (judged(result.status())) {
      EXPECT_FALSE(result.motion().metric);
      const double length = result.motion().current_from_reference.translation().norm();
      EXPECT_TRUE(length == 0.0 || std::abs(length - 1.0) < 1e-9) << length << " is a claim of metres";
    }
    return result;
  });
}

TEST(Monocular, AStaticRoomIsLeftAlone) {
  const Outcome outcome = run(synthetic::static_room(small(60)), false);
  EXPECT_GE(outcome.judged, 20) << "a filter that judges nothing proves nothing";
  EXPECT_LE(outcome.score.false_positive_rate().value(), 0.01);
}

TEST(Monocular, WhoWalksInABoxIsFoundAndTheRoomKept) {
  const Outcome outcome = run(synthetic::walking_people(small(60)), true);
  ASSERT_GT(outcome.score.moving().features, 1000u);
  EXPECT_GE(outcome.score.recall().value(), 0.4);
  EXPECT_LE(outcome.score.false_positive_rate().value(), 0.1);
}

}  // namespace
}  // namespace stillpoint::monocular_test
