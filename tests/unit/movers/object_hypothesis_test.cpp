// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/object_hypothesis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint::object_hypothesis_test {
namespace {

const Camera kCamera(525, 525, 320, 240, 640, 480);
constexpr double kElapsed_s = 0.03, kSpeed_m_s = 0.24;
constexpr double kDepth_m = 2.0;

/// An object 2 m ahead that goes 7.2 mm, which are 1.89 px, to the right. The camera stands still. Across the ray a
/// step is known to √2 · ½ px: the object's is 2.67 standard deviations, 7.1 in χ². 24 dynamic features on it, 8 px
/// apart, are its own; one more among them has a step and a probability of its choice.
class ObjectHypothesisTest : public testing::Test {
 protected:
  ObjectHypothesisTest() {
    matches.elapsed_s = kElapsed_s;
    for (int k = 0; k < 24; ++k)
      add({300.0f + 8.0f * static_cast<float>(k % 6), 200.0f + 8.0f * static_cast<float>(k / 6)}, step_m(), true,
          0.95f);
    TrackedObject object;
    object.is_confirmed = object.is_seen = true;
    object.members = 24;
    object.mover.state = MoverState::moving;
    object.mover.current_from_reference.translation() = step_m() * Vector3d::UnitX();
    object.linear.correct({kSpeed_m_s, 0, 0}, 1e-6 * Matrix3d::Identity());
    objects.push_back(object);
  }

  static double step_m() { return kSpeed_m_s * kElapsed_s; }

  std::size_t add(const Vector2f& pixel, double x_m, bool is_dynamic, float probability, double depth_m = kDepth_m) {
    const std::size_t i = matches.size();
    matches.resize(i + 1);
    matches.current.pixel[i] = pixel;
    matches.current.undistorted[i] = pixel.cast<double>();
    matches.current.set_depth(i, depth_m, 0.01, kCamera);
    matches.reference.depth_m[i] = depth_m;
    matches.reference.depth_sigma_m[i] = 0.01;
    matches.reference.point[i] = matches.current.point[i] - x_m * Vector3d::UnitX();
    matches.state[i] = MatchState::matched;
    Label label;
    label.verdict = is_dynamic ? Verdict::dynamic : Verdict::kept;
    label.keep = !is_dynamic;
    label.reason = is_dynamic ? Reason::inconsistent : Reason::consistent;
    label.probability = probability;
    label.log_odds = std::log(probability / (1.0f - probability));
    labels.push_back(label);
    object_of.push_back(is_dynamic ? 0 : -1);
    return i;
  }

  /// The feature under test, in the middle of the object.
  std::size_t add_inside(double x_m, bool is_dynamic, float probability, double depth_m = kDepth_m) {
    return add({324, 212}, x_m, is_dynamic, probability, depth_m);
  }

  void run() {
    const FrameView frame;
    const Pose stands = Pose::Identity();
    const MovingFeatures<Camera> features{frame, matches, labels, stands, kCamera, 0.5, object_of};
    const PixelGrid followed(matches.current.pixel, features.beside_px(), workspace,
                             [&](std::size_t i) { return matches.metric(i); });
    const std::vector<Label> before = labels;
    ObjectHypothesis::run(objects, features, followed, labels, workspace);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(labels[i].verdict, Verdict::dynamic) << i;
    changed = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) changed += labels[i].verdict != before[i].verdict;
  }

  Matches matches;
  std::vector<Label> labels;
  std::vector<std::int32_t> object_of;
  std::vector<TrackedObject> objects;
  Workspace workspace;
  int changed = 0;
};

// log-odds of .4: -.41; the object's motion says ln 4 = 1.39 more; ln (.7 / .3) = .85 is needed.
TEST_F(ObjectHypothesisTest, WhatGoesAsItsObjectGoesIsDropped) {
  const std::size_t i = add_inside(step_m(), false, 0.4f);
  run();
  EXPECT_EQ(labels[i].verdict, Verdict::dynamic);
  EXPECT_FALSE(labels[i].keep);
  EXPECT_EQ(labels[i].reason, Reason::object_motion);
  EXPECT_EQ(object_of[i], 0);
  EXPECT_NEAR(labels[i].probability, 0.4 * 4 / (0.4 * 4 + 0.6), 0.01) << "what its weight is made of";
  EXPECT_NEAR(labels[i].log_odds, std::log(0.4 * 4 / 0.6), 0.05) << "what the keep-floor sorts by";
}

// Log-odds of .45: -.20, with the object's motion 1.19; of .52: .08.
TEST_F(ObjectHypothesisTest, TheKeepFloorTakesWhatWasDynamicByLessFirst) {
  const std::size_t raised = add_inside(step_m(), false, 0.45f), hardly = add_inside(0, true, 0.52f);
  run();
  ASSERT_EQ(labels[raised].reason, Reason::object_motion);
  KeepFloor floor;
  floor.options.fewest_features = 1;
  floor.options.fewest_cells = 0;
  const std::uint8_t pixel = 0;  // of the image only its size is looked at
  EXPECT_EQ(floor.apply(matches.current.pixel, {&pixel, 640, 480, 640, PixelFormat::gray8}, labels, workspace), 1u);
  EXPECT_EQ(labels[hardly].reason, Reason::keep_floor);
  EXPECT_FALSE(labels[raised].keep);
}

TEST_F(ObjectHypothesisTest, WhatStandsStaysAsItIs) {
  add_inside(0, false, 0.49f);
  add_inside(0, true, 0.51f);
  run();
  EXPECT_EQ(changed, 0);
}

// .85 - 1.39 = -.54 are the log-odds of .368.
TEST_F(ObjectHypothesisTest, OddsOfSevenToThreeAreNeeded) {
  const std::size_t just_below = add_inside(step_m(), false, 0.363f), just_above = add_inside(step_m(), false, 0.374f);
  run();
  EXPECT_EQ(labels[just_below].verdict, Verdict::kept);
  EXPECT_EQ(labels[just_above].verdict, Verdict::dynamic);
  EXPECT_EQ(changed, 1);
}

// At .6 of the object's step standing still is off by 2.57 in χ², the object's motion by 1.14: it says .71 more, which
// log-odds of -.04 do not suffice for; at .7 by 3.50 and .64, which do.
TEST_F(ObjectHypothesisTest, BetweenTheTwoMotionsTheBetterFitMustBeClear) {
  const std::size_t nearly = add_inside(0.6 * step_m(), false, 0.49f), clear = add_inside(0.7 * step_m(), false, 0.49f);
  run();
  EXPECT_EQ(labels[nearly].verdict, Verdict::kept);
  EXPECT_EQ(labels[clear].verdict, Verdict::dynamic);
}

// Beyond the object's step: off by 1.46 in χ² at 1.452 of it, by 2.62 at 1.606. The median of χ² is 2.37.
TEST_F(ObjectHypothesisTest, WhatTheObjectsMotionDoesNotExplainStaysAsItIs) {
  const std::size_t explained = add_inside(1.452 * step_m(), false, 0.45f),
                    unexplained = add_inside(1.606 * step_m(), false, 0.45f);
  run();
  EXPECT_EQ(labels[explained].verdict, Verdict::dynamic);
  EXPECT_EQ(labels[unexplained].verdict, Verdict::kept);
}

// 8 mm are 2.1 px, 8.8 in χ²; 8.4 mm are 2.2 px, 9.7.
TEST_F(ObjectHypothesisTest, WhereTheMotionsAreFarApartTheFilterHasToldThemApart) {
  const std::size_t i = add_inside(0.008, false, 0.45f);
  objects[0].mover.current_from_reference.translation().x() = 0.0084;
  run();
  EXPECT_EQ(changed, 0);
  objects[0].mover.current_from_reference.translation().x() = 0.008;
  run();
  EXPECT_EQ(labels[i].verdict, Verdict::dynamic);
}

TEST_F(ObjectHypothesisTest, WhatLiesBehindTheObjectIsNotOnIt) {
  add_inside(step_m(), false, 0.45f, kDepth_m + 0.1);
  add({400, 212}, step_m(), false, 0.45f);
  run();
  EXPECT_EQ(changed, 0) << "10 cm farther away; 36 px beside it";
}

TEST_F(ObjectHypothesisTest, OnlyAnObjectThatSurelyMovesHasASay) {
  const auto spoil = {+[](TrackedObject& object) { object.is_confirmed = false; },
                      +[](TrackedObject& object) { object.is_seen = false; },
                      +[](TrackedObject& object) { object.members = 19; },
                      +[](TrackedObject& object) { object.mover.state = MoverState::parked; },
                      +[](TrackedObject& object) { object.linear = ConstantVelocity{1.0}; }};
  add_inside(step_m(), false, 0.45f);
  const std::vector<TrackedObject> good = objects;
  for (const auto& change : spoil) {
    objects = good;
    change(objects[0]);
    run();
    EXPECT_EQ(changed, 0);
  }
  objects = good;
  run();
  EXPECT_EQ(changed, 1);
}

TEST_F(ObjectHypothesisTest, WithoutProbabilityDepthOrStepNothingIsChanged) {
  const float kNaN = std::numeric_limits<float>::quiet_NaN();
  add_inside(step_m(), false, kNaN);
  const std::size_t depthless = add_inside(step_m(), false, 0.45f);
  matches.current.depth_m[depthless] = 0;
  const std::size_t no_step = add({344, 228}, step_m(), false, 0.45f);
  for (std::size_t i = 0; i < matches.size(); ++i) matches.state[i] = MatchState::lost;
  run();
  EXPECT_EQ(changed, 0);
  for (std::size_t i = 0; i < no_step; ++i) matches.state[i] = MatchState::matched;
  run();
  EXPECT_EQ(labels[no_step].verdict, Verdict::dynamic) << "by the step of the nearest on its surface";
}

TEST_F(ObjectHypothesisTest, NoObjectOrNoFeatureIsNoError) {
  add_inside(step_m(), false, 0.45f);
  objects.clear();
  run();
  EXPECT_EQ(changed, 0);
  const FrameView frame;
  const Matches none;
  const Pose stands = Pose::Identity();
  const MovingFeatures<Camera> features{frame, none, {}, stands, kCamera, 0.5, {}};
  const PixelGrid followed(none.current.pixel, features.beside_px(), workspace, [](std::size_t) { return true; });
  ObjectHypothesis::run(objects, features, followed, {}, workspace);
}

}  // namespace
}  // namespace stillpoint::object_hypothesis_test
