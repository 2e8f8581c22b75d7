// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/object_hypothesis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"

namespace stillpoint::object_hypothesis_test {
namespace {

const Camera kCamera(525, 525, 320, 240, 640, 480);
constexpr double kElapsed_s = 0.1, kSpeed_m_s = 0.4;
constexpr double kDepth_m = 2.0;

/// An object 2 m ahead that goes 4 cm, which are 10.5 px, to the right. The camera stands still. 24 dynamic features on
/// it, 8 px apart, are its own; one more among them has a step and a probability of its choice.
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

// log-odds of .3: -.85; the object's motion says ln 4 = 1.39 more.
TEST_F(ObjectHypothesisTest, WhatGoesAsItsObjectGoesIsDropped) {
  const std::size_t i = add_inside(step_m(), false, 0.3f);
  run();
  EXPECT_EQ(labels[i].verdict, Verdict::dynamic);
  EXPECT_FALSE(labels[i].keep);
  EXPECT_EQ(labels[i].reason, Reason::object_motion);
  EXPECT_EQ(object_of[i], 0);
}

TEST_F(ObjectHypothesisTest, WhatStandsInFrontOfAnObjectIsKept) {
  const std::size_t i = add_inside(0, true, 0.7f);
  run();
  EXPECT_EQ(labels[i].verdict, Verdict::kept);
  EXPECT_TRUE(labels[i].keep);
  EXPECT_EQ(labels[i].reason, Reason::object_motion);
  EXPECT_EQ(object_of[i], -1) << "it is of no object";
}

// Odds of 1 : 4 (.2) are where one object's motion begins to suffice.
TEST_F(ObjectHypothesisTest, MoreThanOddsOfFourAreNotOverruled) {
  const std::size_t sure_to_stand = add_inside(step_m(), false, 0.19f), nearly = add_inside(step_m(), false, 0.21f),
                    sure_to_move = add_inside(0, true, 0.81f), barely = add_inside(0, true, 0.79f);
  run();
  EXPECT_EQ(labels[sure_to_stand].verdict, Verdict::kept);
  EXPECT_EQ(labels[nearly].verdict, Verdict::dynamic);
  EXPECT_EQ(labels[sure_to_move].verdict, Verdict::dynamic);
  EXPECT_EQ(labels[barely].verdict, Verdict::kept);
  EXPECT_EQ(changed, 2);
}

// Across the ray a step is known to √2 · ½ px. 10.5 px off the better motion are 15 standard deviations; the other is
// as far again. 5.25 px off both, nothing is said.
TEST_F(ObjectHypothesisTest, WhatNeitherMotionExplainsStaysAsItIs) {
  add_inside(0.08, false, 0.4f);
  add_inside(-0.04, true, 0.6f);
  add_inside(0.02, false, 0.4f);
  run();
  EXPECT_EQ(changed, 0);
}

TEST_F(ObjectHypothesisTest, WhatLiesBehindTheObjectIsNotOnIt) {
  add_inside(step_m(), false, 0.4f, kDepth_m + 0.1);
  add({400, 212}, step_m(), false, 0.4f);
  run();
  EXPECT_EQ(changed, 0) << "10 cm farther away; 36 px beside it";
}

TEST_F(ObjectHypothesisTest, OnlyAnObjectThatSurelyMovesHasASay) {
  const auto spoil = {+[](TrackedObject& object) { object.is_confirmed = false; },
                      +[](TrackedObject& object) { object.is_seen = false; },
                      +[](TrackedObject& object) { object.members = 19; },
                      +[](TrackedObject& object) { object.mover.state = MoverState::parked; },
                      +[](TrackedObject& object) { object.linear = ConstantVelocity{1.0}; }};
  add_inside(step_m(), false, 0.4f);
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

// 2 mm are ½ px.
TEST_F(ObjectHypothesisTest, TwoMotionsThatNoiseHidesAreNotToldApart) {
  objects[0].mover.current_from_reference.translation().x() = 0.002;
  add_inside(0.004, false, 0.4f);
  run();
  EXPECT_EQ(changed, 0);
}

TEST_F(ObjectHypothesisTest, WithoutProbabilityDepthOrStepNothingIsChanged) {
  const float kNaN = std::numeric_limits<float>::quiet_NaN();
  add_inside(step_m(), false, kNaN);
  const std::size_t depthless = add_inside(step_m(), false, 0.4f);
  matches.current.depth_m[depthless] = 0;
  const std::size_t no_step = add({344, 228}, step_m(), false, 0.4f);
  for (std::size_t i = 0; i < matches.size(); ++i) matches.state[i] = MatchState::lost;
  run();
  EXPECT_EQ(changed, 0);
  for (std::size_t i = 0; i < no_step; ++i) matches.state[i] = MatchState::matched;
  run();
  EXPECT_EQ(labels[no_step].verdict, Verdict::dynamic) << "by the step of the nearest on its surface";
}

TEST_F(ObjectHypothesisTest, NoObjectOrNoFeatureIsNoError) {
  add_inside(step_m(), false, 0.4f);
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
