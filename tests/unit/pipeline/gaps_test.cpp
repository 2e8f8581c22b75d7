// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies where single frames lack something: keypoints, depth, or the frames before them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/pipeline/scene_run.hpp"

namespace stillpoint::gaps_test {
namespace {

std::vector<Vector2f> corners(const SyntheticFrame& frame) { return scene_run::orb_corners(frame, 500); }

/// What became of the frames behind a gap.
struct Outcome {
  FilterScore score;
  int frames = 0, refused = 0;
  int wrong = 0;  ///< judged by a motion whose rotation is 10 mrad off, 5 px, or more
};

/// A camera that stands and looks round a room without movers: `starts_s` after 1 s it turns at 1.2 rad/s.
synthetic::Scene turning(double starts_s) {
  constexpr double kSpeed_rad_s = 1.2, kLeft_rad = -0.48;
  synthetic::SceneOptions options;
  options.frames = 120;
  synthetic::Scene scene = synthetic::pure_rotation(options);
  std::vector<synthetic::Waypoint> looks;
  for (const double time_s : {0.0, 1.0, 1.0 + starts_s, 2.0 + starts_s}) {
    const double turned_s = std::max(0.0, time_s - 1.0 - 0.5 * starts_s);
    looks.push_back({time_s, {0, -1.42, -0.8}, kLeft_rad + kSpeed_rad_s * turned_s, -0.18, 0});
  }
  if (!(starts_s > 0)) looks.erase(looks.begin() + 2);
  scene.camera_path = {synthetic::Path(looks, starts_s > 0 ? synthetic::Blend::spline : synthetic::Blend::linear), {}};
  return scene;
}

/// Frames of the turning camera, those from `gap` on counted.
/// @param change  what frame `gap` lacks
template <class Change>
Outcome run(const synthetic::Scene& scene, const std::vector<int>& frames, int gap, Change&& change) {
  SyntheticSequence sequence(scene);
  FrameFilter<> filter(sequence.camera());
  SyntheticFrame frame;
  Pose world_from_last = Pose::Identity();
  Outcome outcome;
  for (const int f : frames) {
    sequence.render(f, frame);
    FrameView view = frame.view();
    std::vector<Vector2f> pixels = corners(frame);
    if (f == gap) change(view, pixels);
    const FrameResult& result = filter.filter_frame(view, pixels);
    if (f > gap) {
      const Pose truth = frame.world_from_camera.inverse() * world_from_last;
      const Matrix3d off = result.motion().current_from_reference.linear() * truth.linear().transpose();
      ++outcome.frames;
      if (!judged(result.status()))
        ++outcome.refused;
      else
        outcome.wrong += rotation_angle(off) > 0.01;
      outcome.score.add_frame(frame.labels.view(), pixels, result.keep());
    }
    world_from_last = frame.world_from_camera;
  }
  return outcome;
}

std::vector<int> every(int step, int first, int last) {
  std::vector<int> frames;
  for (int f = first; f <= last; f += step) frames.push_back(f);
  return frames;
}

// 10 Hz, 0.12 rad or 63 px from frame to frame. Depth is filled by the motion that is expected: where that is a little
// off, the frame is refused, and the next, which is compared with a frame without depth; the turn is not lost by that.
TEST(Gaps, AFrameThatLacksSomethingDoesNotLoseATurn) {
  const auto behind_one = [](auto&& change) { return run(turning(1.0), every(3, 21, 84), 66, change); };
  const Outcome no_keypoints = behind_one([](FrameView&, std::vector<Vector2f>& pixels) { pixels.clear(); });
  const Outcome no_depth = behind_one([](FrameView& view, std::vector<Vector2f>&) { view.depth = DepthView(); });
  EXPECT_EQ(no_keypoints.refused, 0);
  EXPECT_LE(no_depth.refused, 1);
  for (const Outcome& outcome : {no_keypoints, no_depth}) {
    EXPECT_EQ(outcome.frames, 6);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_LT(*outcome.score.false_positive_rate(), 0.02);
  }
}

// 30 Hz; the host drops frames where the turn begins, so that 60 to 125 px come at once, which nothing has announced.
// A frame may be refused for that. Judged by a wrong motion, half of the room is dropped for twenty frames.
TEST(Gaps, AnImageThatJumpsIsRefusedOrUnderstood) {
  for (const int dropped : {2, 5}) {
    std::vector<int> frames = every(1, 24, 30);
    for (const int f : every(1, 31 + dropped, 43)) frames.push_back(f);
    const Outcome outcome = run(turning(0.0), frames, 30, [](FrameView&, std::vector<Vector2f>&) {});
    EXPECT_EQ(outcome.wrong, 0) << dropped;
    EXPECT_LE(outcome.refused, 1) << dropped;
    EXPECT_LT(*outcome.score.false_positive_rate(), 0.01) << dropped;
  }
}

// A host that fills the size in whether there is an image or not.
TEST(Gaps, ASizeWithoutDataIsNoDepthImage) {
  SyntheticSequence sequence(turning(0.0));
  FrameFilter<> filter(sequence.camera());
  SyntheticFrame frame;
  for (int i = 0; i < 6; ++i) {
    sequence.render(i, frame);
    FrameView view = frame.view();
    const ImageView& image = view.depth.image;
    if (i > 1) view.depth.image = ImageView(nullptr, image.width, image.height, image.stride_bytes, image.format);
    const Status status = filter.filter_frame(view, corners(frame)).status();
    if (i == 0) continue;
    EXPECT_EQ(status, i < 5 ? Status::ok : Status::no_depth) << "a tenth of a second of holes is filled, " << i;
  }
}

// Colour at 30 Hz, depth at 15.
TEST(Gaps, EveryOtherFrameMayHaveNoDepthImage) {
  const synthetic::Scene scene = synthetic::walking_people(scene_run::small(60));
  const auto recall = [&scene](bool has_every_depth) {
    FrameFilter<> filter(scene.camera);
    int index = 0;
    const scene_run::Outcome outcome =
        scene_run::run(scene, [&](const SyntheticFrame& frame, std::vector<Vector2f>& pixels) -> const FrameResult& {
          pixels = corners(frame);
          FrameView view = frame.view();
          if (!has_every_depth && index++ % 2 == 1) view.depth = DepthView();
          return filter.filter_frame(view, pixels);
        });
    EXPECT_EQ(outcome.judged, outcome.frames);
    EXPECT_LT(*outcome.score.false_positive_rate(), 0.02);
    return *outcome.score.recall();
  };
  EXPECT_GT(recall(false), recall(true) - 0.05);
}

/// Half of the depth image loses its depth, in squares of 24 pixels, others in each frame.
void dig_holes(ImageBuffer& depth, Random& random) {
  constexpr int kSide_px = 24;
  const ImageView view = depth.view();
  for (int top = 0; top < view.height; top += kSide_px)
    for (int left = 0; left < view.width; left += kSide_px) {
      if (random.uniform() < 0.5) continue;
      const int width = std::min(kSide_px, view.width - left);
      for (int v = top; v < std::min(top + kSide_px, view.height); ++v)
        std::fill_n(depth.row<std::uint16_t>(v) + left, width, std::uint16_t{0});
    }
}

// Each hole is there with a chance of a half: of the features in one, 1 − 1/2³ had a depth in the last three frames.
// Where a static point was, 1 of 19 on these walkers finds it.
TEST(Gaps, WhatMovesKeepsItsDepthWhereHolesComeAndGo) {
  const synthetic::Scene scene = synthetic::walking_people(scene_run::small(45));
  FrameFilter<> filter(scene.camera);
  Random random(3);
  int in_holes = 0, filled = 0, wrong = 0;
  scene_run::run(scene, [&](const SyntheticFrame& frame, std::vector<Vector2f>& pixels) -> const FrameResult& {
    pixels = corners(frame);
    ImageBuffer depth;
    depth.assign(frame.depth.view());
    dig_holes(depth, random);
    const FrameView view(frame.gray.view(), DepthView(depth.view(), frame.depth_factor), frame.timestamp_s);
    const FrameResult& result = filter.filter_frame(view, pixels);
    for (std::size_t i = 0; i < pixels.size() && judged(result.status()); ++i) {
      const int u = rounded(pixels[i].x()), v = rounded(pixels[i].y());
      if (frame.labels.view().row<std::uint8_t>(v)[u] != static_cast<std::uint8_t>(PixelLabel::moving)) continue;
      if (view.depth.has_depth(u, v)) continue;
      ++in_holes;
      filled += result.depth_m(i) > 0;
      wrong += result.depth_m(i) > 0 &&
               std::abs(result.depth_m(i) - static_cast<double>(frame.exact_depth.view().row<float>(v)[u])) > 0.1;
    }
    return result;
  });
  EXPECT_GT(in_holes, 1000);
  EXPECT_GT(2 * filled, in_holes);
  EXPECT_LT(50 * wrong, filled);
}

}  // namespace
}  // namespace stillpoint::gaps_test
