// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/pipeline/mask_prediction.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kInterval_s = 0.1;

/// A frame's features as the filter ends with them, in an image of 160 × 120 at 0.1 s, and what is predicted from them.
class MaskPredictionTest : public testing::Test {
 protected:
  MaskPredictionTest() { matches.elapsed_s = kInterval_s; }

  void add(const Vector2f& from, const Vector2f& to, Verdict verdict, double depth_m = 0.0) {
    const std::size_t i = matches.size();
    matches.resize(i + 1);
    matches.current.pixel[i] = to;
    matches.current.depth_m[i] = depth_m;
    if (depth_m > 0) matches.current.depth_sigma_m[i] = 0.006;
    matches.reference.pixel[i] = from;
    matches.state[i] = MatchState::matched;
    Label label;
    label.verdict = verdict;
    label.keep = verdict != Verdict::dynamic;
    labels.push_back(label);
  }
  void add_unmatched(const Vector2f& at, Verdict verdict) {
    add(at, at, verdict);
    matches.state.back() = MatchState::lost;
    matches.reference.pixel.back().setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  const ImageView& predict(int margin_px = 0, double timestamp_s = 2 * kInterval_s) {
    prediction.remember(matches, labels, kInterval_s);
    return paint(margin_px, timestamp_s);
  }
  const ImageView& paint(int margin_px = 0, double timestamp_s = 2 * kInterval_s) {
    prediction.paint(timestamp_s, DepthView(depth.view()), kWidth, kHeight, margin_px, mask, workspace);
    return view = mask.view();
  }
  void set_depth(float left_m, float right_m, int edge_u) {
    depth.resize(kWidth, kHeight, PixelFormat::depth32f);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) depth.row<float>(v)[u] = u < edge_u ? left_m : right_m;
  }
  bool drops(int u, int v) const {
    const std::uint8_t value = view.row<std::uint8_t>(v)[u];
    EXPECT_TRUE(value == 0 || value == 255) << int{value};
    return value == 0;
  }
  int dropped() const {
    int count = 0;
    for (int v = 0; v < view.height; ++v)
      for (int u = 0; u < view.width; ++u) count += drops(u, v);
    return count;
  }

  Matches matches;
  std::vector<Label> labels;
  MaskPrediction prediction;
  Workspace workspace;
  ImageBuffer depth, mask;
  ImageView view;
};

// It went 10 px to the right and 4 down within 0.1 s, and goes on so.
TEST_F(MaskPredictionTest, FeatureIsCarriedOnByItsOwnStep) {
  add({70, 56}, {80, 60}, Verdict::dynamic);
  predict();
  EXPECT_TRUE(drops(90, 64));
  EXPECT_FALSE(drops(80, 60)) << "there it is no more";
  predict(0, 1.5 * kInterval_s);
  EXPECT_TRUE(drops(85, 62)) << "half the time, half the way";
}

// Two frames in a burst: 10 px within a millisecond are no velocity.
TEST_F(MaskPredictionTest, StampsNextToEachOtherTellNoVelocity) {
  add({70, 60}, {80, 60}, Verdict::dynamic);
  matches.elapsed_s = 1e-3;
  predict(0, kInterval_s + 0.033);
  EXPECT_TRUE(drops(80, 60));
  EXPECT_LE(dropped(), 64) << "one feature alone";
  matches.elapsed_s = 0.005;
  predict(0, kInterval_s + 0.004);
  EXPECT_TRUE(drops(88, 60)) << "a fast camera";
}

TEST_F(MaskPredictionTest, NothingIsDroppedOfWhatStandsOrCouldNotBeTold) {
  add({70, 56}, {80, 60}, Verdict::kept);
  add({20, 20}, {20, 20}, Verdict::unknown);
  predict(8);
  EXPECT_EQ(dropped(), 0);
}

// Around the 4 px cell of (90, 64), which begins at (88, 64), a disc about its centre (89.5, 65.5), rounded to (90,
// 66), of 8 + 2 px.
TEST_F(MaskPredictionTest, MarginIsDroppedAroundIt) {
  add({70, 56}, {80, 60}, Verdict::dynamic);
  predict(8);
  EXPECT_TRUE(drops(80, 66) && drops(100, 66) && drops(90, 56) && drops(90, 76));
  EXPECT_FALSE(drops(79, 66) || drops(101, 66) || drops(90, 55) || drops(90, 77));
}

// 40 px beside it is beyond 24 px, and within 2 · 24 px of a camera of twice the focal length.
TEST_F(MaskPredictionTest, ReachIsAnAngle) {
  set_depth(2.0f, 2.0f, 0);
  add({80, 60}, {80, 60}, Verdict::dynamic, 2.0);
  predict();
  EXPECT_TRUE(drops(80 + 20, 60));
  EXPECT_FALSE(drops(80 + 40, 60));
  matches.pixel_scale = 2.0f;
  predict();
  EXPECT_TRUE(drops(80 + 40, 60));
  matches.pixel_scale = 0.5f;
  predict();
  EXPECT_FALSE(drops(80 + 20, 60));
}

TEST_F(MaskPredictionTest, FeatureWithoutAMatchGoesWithTheMovingOnesAroundIt) {
  add({60, 60}, {70, 60}, Verdict::dynamic);
  add({80, 60}, {90, 60}, Verdict::dynamic);
  add({80, 76}, {80, 76}, Verdict::kept);
  add_unmatched({80, 60}, Verdict::dynamic);
  predict();
  EXPECT_TRUE(drops(90, 60));
}

// An object 1 m ahead that goes 2 cm to the right in 0.1 s: 10 px at a focal length of 500 px. Its feature's own match
// says 4.
class FollowedObject : public MaskPredictionTest {
 protected:
  void add_on_object(const Vector2f& from, const Vector2f& to) {
    add(from, to, Verdict::dynamic, 1.0);
    matches.current.point.back() = kCamera.back_project(to.cast<double>(), 1.0);
    movers.pixel.push_back(to);
    movers.match.push_back(static_cast<std::uint32_t>(matches.size() - 1));
  }
  void follow(bool has_rotation, MoverState state = MoverState::moving) {
    Mover mover;
    mover.state = state;
    mover.has_rotation = has_rotation;
    mover.current_from_reference.translation().x() = 0.02;
    mover.pixel_count = movers.pixel.size();
    movers.list = {mover};
    prediction.remember(matches, labels, kInterval_s);
    prediction.follow(movers, matches, kCamera);
    paint();
  }

  const Camera kCamera{500, 500, 80, 60, kWidth, kHeight};
  Movers movers;
};

TEST_F(FollowedObject, WhatMovesAsOneBodyGoesAsItsObject) {
  add_on_object({76, 60}, {80, 60});
  follow(true);
  EXPECT_TRUE(drops(90, 60));
  EXPECT_FALSE(drops(84, 60)) << "its own match is one of many";
}

TEST_F(FollowedObject, LimbsGoByTheirOwnMatch) {
  add_on_object({76, 60}, {80, 60});
  follow(false);
  EXPECT_TRUE(drops(84, 60));
  EXPECT_FALSE(drops(90, 60));
}

TEST_F(FollowedObject, LimbWithoutAMatchGoesWithThoseAroundItElseAsItsObject) {
  add_on_object({80, 60}, {80, 60});
  matches.state.back() = MatchState::lost;
  follow(false);
  EXPECT_TRUE(drops(90, 60)) << "nothing beside it was followed";
  add({96, 60}, {100, 60}, Verdict::dynamic, 1.0);
  follow(false);
  EXPECT_TRUE(drops(84, 60));
  EXPECT_FALSE(drops(90, 60));
}

TEST_F(FollowedObject, WhatIsParkedOrHasNoDepthGoesByItsMatch) {
  add_on_object({76, 60}, {80, 60});
  follow(true, MoverState::parked);
  EXPECT_TRUE(drops(84, 60));
  matches.current.depth_m.back() = 0;
  follow(true);
  EXPECT_TRUE(drops(84, 60));
  EXPECT_FALSE(drops(90, 60));
}

// A thing 1 m away ends at u = 80, the wall behind it is 3 m away. It moves 8 px to the left.
TEST_F(MaskPredictionTest, MovingFeatureSpeaksForItsSurfaceAsFarAsDepthReaches) {
  set_depth(1.0f, 3.0f, 80);
  add({80, 60}, {72, 60}, Verdict::dynamic, 1.0);
  predict();
  EXPECT_TRUE(drops(64, 60));
  EXPECT_TRUE(drops(64 - 20, 60)) << "the surface around it";
  EXPECT_TRUE(drops(70, 60)) << "up to the thing's edge, which moved from 80 to 72";
  EXPECT_FALSE(drops(78, 60)) << "the wall within reach is not its surface";
  EXPECT_FALSE(drops(64 - 32, 60)) << "beyond reach";
}

TEST_F(MaskPredictionTest, OneMovingFeatureAmongStandingOnesSpeaksForItselfAlone) {
  set_depth(2.0f, 2.0f, 0);
  add({80, 60}, {80, 60}, Verdict::dynamic, 2.0);
  add({70, 60}, {70, 60}, Verdict::kept, 2.0);
  add({90, 60}, {90, 60}, Verdict::kept, 2.0);
  predict();
  EXPECT_TRUE(drops(80, 60));
  EXPECT_EQ(dropped(), 16 + 2)
      << "its cell, and of the disc of 2 px around that what is outside: a pixel right and below";
}

TEST_F(MaskPredictionTest, NothingIsPredictedOfTimesThatAreNotAheadOrTooFar) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  add({80, 60}, {80, 60}, Verdict::dynamic);
  for (const double timestamp_s : {kInterval_s, 0.0, kNaN, kInterval_s + 1.01}) {
    predict(8, timestamp_s);
    EXPECT_EQ(dropped(), 0) << timestamp_s;
  }
  predict(8, kInterval_s + 0.99);
  EXPECT_GT(dropped(), 0);
}

TEST_F(MaskPredictionTest, ForgottenVerdictsPredictNothing) {
  EXPECT_EQ(paint(8).width, kWidth) << "before the first frame too there is a mask";
  EXPECT_EQ(dropped(), 0);
  add({80, 60}, {80, 60}, Verdict::dynamic);
  predict();
  ASSERT_GT(dropped(), 0);
  prediction.forget();
  paint(8);
  EXPECT_EQ(dropped(), 0);
}

TEST_F(MaskPredictionTest, WhatLeavesTheImageOrIsNotFiniteIsLeftOut) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  add({100, 60}, {150, 60}, Verdict::dynamic);
  add({80, 60}, {kNaN, 60}, Verdict::dynamic);
  add({kNaN, 60}, {40, 60}, Verdict::dynamic);
  add({1e30f, 0}, {-1e30f, 0}, Verdict::dynamic);
  predict(8);
  EXPECT_EQ(dropped(), 0);
}

TEST_F(MaskPredictionTest, TheGreatestMarginDropsAll) {
  add({70, 56}, {80, 60}, Verdict::dynamic);
  predict(std::numeric_limits<int>::max());
  EXPECT_EQ(dropped(), view.width * view.height);
}

TEST_F(MaskPredictionTest, NegativeMarginIsNone) {
  add({80, 60}, {80, 60}, Verdict::dynamic);
  predict(-50);
  EXPECT_TRUE(drops(80, 60));
}

}  // namespace
}  // namespace stillpoint
