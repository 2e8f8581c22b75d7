// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies where each depth image is of another instant than its picture, or lies beside it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/warnings.hpp"
#include "stillpoint/depth/shifted_depth.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/pipeline/scene_run.hpp"

namespace stillpoint::registration_scenes_test {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

struct Outcome {
  FilterScore score;
  int known_after = -1;  ///< frames, until the delay was known
  double delay_s = 0.0;  ///< at the end
  int right_px = 0;      ///< by which depth is moved at the end
  Warnings warnings;
  // Features on movers in the second half:
  int with_depth = 0, right = 0;  ///< within 0.1 m
};

/// Two people who cross before a hand-held camera, 30 frames a second.
/// @param late_s    so much older than its picture is each depth image …
/// @param right_px  … and lies so far to the right of it
Outcome run(double late_s, int right_px = 0, bool is_enabled = true) {
  synthetic::Scene scene = synthetic::crossing_people(scene_run::small(40));
  scene.sensor.depth_delay_s = -late_s;
  FrameFilter<> filter(scene.camera);
  filter.depth_registration.is_enabled = is_enabled;
  Outcome outcome;
  int index = 0;
  ShiftedDepth shifted;
  const auto filter_frame = [&](const SyntheticFrame& frame, std::vector<Vector2f>& pixels) -> const FrameResult& {
    pixels = scene_run::orb_corners(frame, 500);
    FrameView view = frame.view();
    view.depth = shifted(view.depth, right_px, 0);
    const FrameResult& result = filter.filter_frame(view, pixels);
    outcome.warnings.add(result.warnings());
    outcome.right_px = filter.depth_registration.right_px();
    if (outcome.known_after < 0 && filter.depth_registration.delay_s() != 0.0) outcome.known_after = index;
    for (std::size_t i = 0; i < pixels.size() && index >= 20; ++i) {
      const int u = rounded(pixels[i].x()), v = rounded(pixels[i].y());
      if (frame.labels.view().row<std::uint8_t>(v)[u] != static_cast<std::uint8_t>(PixelLabel::moving)) continue;
      if (!(result.depth_m(i) > 0)) continue;
      ++outcome.with_depth;
      outcome.right +=
          std::abs(result.depth_m(i) - static_cast<double>(frame.exact_depth.view().row<float>(v)[u])) < 0.1;
    }
    ++index;
    return result;
  };
  outcome.score = scene_run::run(scene, filter_frame).score;
  outcome.delay_s = filter.depth_registration.delay_s();
  return outcome;
}

// By what two people tell; the camera moves by a pixel or two.
TEST(LateDepth, IsKnownWithinHalfASecond) {
  for (const double frames : {1.0, 0.5, -0.5, -1.0}) {
    const Outcome outcome = run(frames * kFrame_s);
    EXPECT_NEAR(outcome.delay_s, frames * kFrame_s, 1e-9);
    EXPECT_GT(outcome.known_after, 0) << frames;
    EXPECT_LE(outcome.known_after, 15) << frames;
    EXPECT_GT(*outcome.score.recall(), 0.97) << frames;
    EXPECT_LT(*outcome.score.false_positive_rate(), 0.03) << frames;
  }
}

TEST(LateDepth, IsNotFoundWhereThereIsNone) {
  const Outcome outcome = run(0.0);
  EXPECT_EQ(outcome.known_after, -1);
  EXPECT_EQ(outcome.right_px, 0);
  EXPECT_FALSE(outcome.warnings.has(Warning::depth_unsynchronised));
  EXPECT_FALSE(outcome.warnings.has(Warning::depth_shifted));
}

// A fifth of what is late lies on the wall, or on the other of the two.
TEST(LateDepth, WhatMovesTakesItsDepthAlong) {
  const Outcome carried = run(kFrame_s), as_it_comes = run(kFrame_s, 0, false);
  EXPECT_EQ(as_it_comes.known_after, -1);
  EXPECT_LT(as_it_comes.right, 0.85 * as_it_comes.with_depth);
  EXPECT_GT(carried.right, 0.98 * carried.with_depth);
  EXPECT_GT(carried.with_depth, as_it_comes.with_depth);
}

// 320 pixels wide: features beside people have their depth, and those on them the wall's. Known to a pixel.
TEST(MisplacedDepth, IsMovedBack) {
  for (const int right_px : {2, -3}) {
    const Outcome moved = run(0.0, right_px), as_it_comes = run(0.0, right_px, false);
    EXPECT_NEAR(moved.right_px, -right_px, 1);
    EXPECT_EQ(moved.delay_s, 0.0);
    EXPECT_TRUE(moved.warnings.has(Warning::depth_shifted));
    EXPECT_FALSE(as_it_comes.warnings.has(Warning::depth_shifted));
    EXPECT_GT(moved.right, 0.98 * moved.with_depth);
    EXPECT_LT(*moved.score.false_positive_rate(), 0.02) << right_px;
    if (right_px == -3) {
      EXPECT_GT(moved.right, 1.3 * as_it_comes.right) << "a third of what moves had no depth, or the wall's";
    }
  }
}

}  // namespace
}  // namespace stillpoint::registration_scenes_test
