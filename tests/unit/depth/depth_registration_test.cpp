// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/depth_registration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/warnings.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint::depth_registration_test {
namespace {

constexpr int kWidth = 320, kHeight = 60;
constexpr double kFocal_px = 260.0;

Camera camera() { return Camera(kFocal_px, kFocal_px, 159.5, 29.5, kWidth, kHeight); }

/// Bright posts 1 m before the camera and a dark wall behind them; the camera moves sideways, so that all edges go by
/// as many pixels.
class DepthRegistrationTest : public testing::Test {
 protected:
  DepthRegistrationTest() {
    matches_.elapsed_s = 1.0;
    for (double& left_px : left_px_) left_px = random_.uniform(20.0, kWidth - 40.0);
  }

  bool is_post(int u, double offset_px) const {
    for (const double left_px : left_px_)
      if (u >= left_px + offset_px && u < left_px + 12.0 + offset_px) return true;
    return false;
  }

  /// Where the posts are at a time; a frame is shown each second.
  static double swings(double time) { return 14.0 * std::sin(0.35 * time) + 5.0 * std::sin(0.8 * time); }

  /// Shows frames to `registration_`.
  /// @param late   the depth image is of so many seconds before
  /// @param off_px  and lies so far to the right
  void observe(int frames, double late, double off_px = 0.0, const std::function<double(double)>& offset_px = swings) {
    for (int i = 0; i < frames; ++i) {
      const int before = frame_ - static_cast<int>(matches_.elapsed_s);
      gray_.resize(kWidth, kHeight, PixelFormat::gray8);
      const double now_px = offset_px(frame_), then_px = offset_px(frame_ - late) + off_px;
      for (int v = 0; v < kHeight; ++v)
        for (int u = 0; u < kWidth; ++u)
          gray_.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(is_post(u, now_px) ? 200 : 50);
      if (shrink_ == 1)
        paint_depth<float>(PixelFormat::depth32f, 1.0f, then_px);
      else
        paint_depth<std::uint16_t>(PixelFormat::depth16, std::uint16_t{1000}, then_px);
      Motion motion;
      motion.status = Status::ok;
      motion.metric = is_metric_;
      motion.current_from_reference =
          make_pose(Matrix3d::Identity(), {(now_px - offset_px(before)) / kFocal_px, 0.0, 0.0});
      move_features(static_cast<float>(now_px - offset_px(before)));
      if (is_still_) motion.current_from_reference.setIdentity();
      registration_.observe(view(), matches_, labels_, motion, camera());
      if (drops_) matches_.elapsed_s = 2.0;
      frame_ += static_cast<int>(matches_.elapsed_s);
    }
  }

  void move_features(float flow_px) {
    for (std::size_t i = 0; i < matches_.size(); ++i)
      matches_.reference.pixel[i] = matches_.current.pixel[i] - Vector2f(flow_px, 0.0f);
  }

  /// One in each 8 × 8 pixels.
  void dynamic_features(double depth_m, MatchState state) {
    std::vector<Vector2f> pixels;
    for (int v = 4; v < kHeight; v += 8)
      for (int u = 4; u < kWidth; u += 8) pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
    matches_.begin(pixels);
    std::fill(matches_.current.depth_m.begin(), matches_.current.depth_m.end(), depth_m);
    std::fill(matches_.state.begin(), matches_.state.end(), state);
    labels_.assign(matches_.size(), Label{});
    for (Label& label : labels_) label.keep = false;
  }

  /// Of the frame shown last.
  /// @param motion  of the camera, roughly, within `elapsed_s`
  DepthView undo(const Pose& motion, double elapsed_s = 1.0) {
    const FrameView reference(gray_.view(), DepthView(), -elapsed_s);
    return registration_.undo(reference, view(), motion, camera());
  }

  FrameView view() const { return FrameView(gray_.view(), DepthView(depth_.view(), 1000.0), 0.0); }

  /// @param metre  in units of the depth image
  template <class Depth>
  void paint_depth(PixelFormat format, Depth metre, double offset_px) {
    depth_.resize(kWidth / shrink_, kHeight / shrink_, format);
    for (int v = 0; v < kHeight / shrink_; ++v)
      for (int u = 0; u < kWidth / shrink_; ++u)
        depth_.row<Depth>(v)[u] = static_cast<Depth>(is_post(shrink_ * u, offset_px) ? metre : 3 * metre);
  }

  Random random_{3};
  std::array<double, 3> left_px_{};
  ImageBuffer gray_, depth_;
  int frame_ = 0, shrink_ = 1;
  bool is_metric_ = true;
  bool is_still_ = false;  // the posts go by themselves
  bool drops_ = false;     // every other frame, after the first
  Matches matches_;
  std::vector<Label> labels_;
  DepthRegistration registration_;
};

TEST_F(DepthRegistrationTest, DepthOfItsImagesMomentHasNone) {
  observe(100, 0.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

TEST_F(DepthRegistrationTest, DepthOfTheFrameBeforeIsOneFrameLate) {
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

TEST_F(DepthRegistrationTest, OfHalfAFrameToo) {
  observe(80, 0.5);
  EXPECT_EQ(registration_.delay_s(), 0.5);
}

// A dropped frame makes the motion between two frames larger, not the delay.
TEST_F(DepthRegistrationTest, WhereFramesAreDroppedItIsTheSameTime) {
  drops_ = true;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

TEST_F(DepthRegistrationTest, NorDoMoversTellAnother) {
  is_still_ = drops_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

// By the velocity before, which is not that after.
TEST_F(DepthRegistrationTest, DepthOfTheFrameAfterIsEarly) {
  observe(80, -1.0);
  EXPECT_NEAR(registration_.delay_s(), -1.0, 0.25);
}

TEST_F(DepthRegistrationTest, AConstantShiftIsNoDelay) {
  observe(80, 0.0, 3.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

TEST_F(DepthRegistrationTest, NorDoesItHideOne) {
  observe(80, 1.0, 3.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

// With the camera's swings a delay makes a part of the shift good.
TEST_F(DepthRegistrationTest, AShiftBeyondWhatIsSearchedTellsNothing) {
  for (const double off_px : {5.0, 6.0, 8.0, -5.0, -7.0}) {
    registration_.reset();
    observe(80, 0.0, off_px);
    EXPECT_EQ(registration_.delay_s(), 0.0) << off_px;
  }
}

// Each delay looks like a shift then.
TEST_F(DepthRegistrationTest, WhereTheCameraMovesEvenlyNobodyKnows) {
  observe(60, 1.0, 0.0, [](double time) { return 3.0 * time - 60.0; });
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

TEST_F(DepthRegistrationTest, WhereItStandsNobodyKnows) {
  observe(80, 1.0, 0.0, [](double) { return 0.0; });
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

TEST_F(DepthRegistrationTest, WhatIsFoundHoldsWhileTheCameraStands) {
  observe(80, 1.0);
  observe(400, 1.0, 0.0, [at_px = swings(80)](double) { return at_px; });
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

TEST_F(DepthRegistrationTest, WhatIsMendedIsForgotten) {
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
  observe(400, 0.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

// Depth of half the size, 16 bit.
TEST_F(DepthRegistrationTest, OfASmallerDepthImageToo) {
  shrink_ = 2;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

TEST_F(DepthRegistrationTest, AMotionWithoutAScaleTellsNothing) {
  is_metric_ = false;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

TEST_F(DepthRegistrationTest, AResetForgetsIt) {
  observe(80, 1.0);
  registration_.reset();
  EXPECT_EQ(registration_.delay_s(), 0.0);
  observe(2, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0) << "nor does the next look bring it back";
}

TEST_F(DepthRegistrationTest, AResetForgetsWhatMoversTold) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(80, 1.0);
  registration_.reset();
  observe(1, 0.0, 0.0, [](double) { return 0.0; });
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

// The posts go by as if the camera moved, but are dynamic, and nobody knows how they moved: nothing is left that would
// tell.
TEST_F(DepthRegistrationTest, WhatMovesByItselfTellsNothing) {
  dynamic_features(1.0, MatchState::lost);
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
  dynamic_features(2.0, MatchState::lost);  // of something behind the posts
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

// The camera stands, the posts swing by themselves.
TEST_F(DepthRegistrationTest, UnlessItIsKnownHow) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  for (Label& label : labels_) label.keep = true;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0) << "no dynamic feature";
  dynamic_features(1.0, MatchState::matched);
  for (std::size_t i = 0; i < matches_.size(); i += 2) matches_.state[i] = MatchState::lost;
  observe(60, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

TEST_F(DepthRegistrationTest, WhatMovesFindsNoneWhereThereIsNone) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(100, 0.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
  observe(100, 0.0, 3.0);
  EXPECT_EQ(registration_.delay_s(), 0.0) << "shifted, not late";
}

// Within 16 px, 5 % of the width.
TEST_F(DepthRegistrationTest, AnEdgeMovesWithFeaturesThatAreNear) {
  is_still_ = true;
  left_px_.fill(150.0);  // and 19 px to either side
  dynamic_features(1.0, MatchState::matched);
  for (std::size_t i = 0; i < matches_.size(); ++i) labels_[i].keep = matches_.current.pixel[i].x() > 110.0f;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
  for (std::size_t i = 0; i < matches_.size(); ++i) labels_[i].keep = matches_.current.pixel[i].x() < 110.0f;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

// What is found while somebody walks holds when they stand, while the memory still calls them dynamic: at no flow all
// delays are alike.
TEST_F(DepthRegistrationTest, WhatIsFoundOnMoversHoldsWhenTheyStand) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(80, 1.0);
  observe(400, 1.0, 0.0, [at_px = swings(80)](double) { return at_px; });
  EXPECT_EQ(registration_.delay_s(), 1.0);
}

// Of movers, by 3 px to the right: it is moved 3 px to the left again.
TEST_F(DepthRegistrationTest, WhatMovesTellsAShiftToo) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(60, 0.0, 3.0);
  EXPECT_EQ(registration_.right_px(), -3);
  EXPECT_EQ(registration_.down_px(), 0);
  EXPECT_TRUE(registration_.warnings() == Warnings(Warning::depth_shifted));
  EXPECT_EQ(registration_.delay_s(), 0.0);
  left_px_.fill(100.0);
  observe(1, 0.0, 3.0, [](double) { return 0.0; });  // the post is where the image has it, its depth 3 px beside
  const DepthView undone = undo(Pose::Identity());
  EXPECT_EQ(undone.metres(99, 30), 3.0f);
  EXPECT_EQ(undone.metres(100, 30), 1.0f);
  EXPECT_EQ(undone.metres(111, 30), 1.0f);
  EXPECT_EQ(undone.metres(112, 30), 3.0f);
  EXPECT_EQ(undone.metres(kWidth - 1, 30), 0.0f) << "nothing came from there";
  Workspace workspace;
  EXPECT_EQ(registration_.undo_along_flow(view(), view(), matches_, workspace).image.data, depth_.view().data)
      << "not late";
}

TEST_F(DepthRegistrationTest, AShiftThatIsMendedIsForgotten) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(60, 0.0, 3.0);
  EXPECT_EQ(registration_.right_px(), -3);
  observe(200, 0.0);
  EXPECT_EQ(registration_.right_px(), 0);
  EXPECT_TRUE(registration_.warnings().empty());
}

// Late by a frame, and 3 px to the right: the corners take along what was moved to the left.
TEST_F(DepthRegistrationTest, AShiftAndADelay) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(80, 1.0, 3.0);
  EXPECT_EQ(registration_.delay_s(), 1.0);
  EXPECT_EQ(registration_.right_px(), -3);
  Warnings both = Warning::depth_shifted;
  both.add(Warning::depth_unsynchronised);
  EXPECT_TRUE(registration_.warnings() == both);
  left_px_.fill(100.0);
  observe(1, 0.0, 3.0, [](double) { return 0.0; });
  FrameView frame = view();
  frame.depth = undo(Pose::Identity());
  matches_.begin({});
  matches_.resize(1);
  matches_.current.pixel = {Vector2f(116, 30)};
  matches_.reference.pixel = {Vector2f(106, 30)};
  matches_.state = {MatchState::matched};
  Workspace workspace;
  const DepthView undone = registration_.undo_along_flow(view(), frame, matches_, workspace);
  EXPECT_NE(undone.metres(109, 30), 1.0f);
  EXPECT_EQ(undone.metres(110, 30), 1.0f);
  EXPECT_EQ(undone.metres(121, 30), 1.0f);
  EXPECT_EQ(undone.metres(122, 30), 3.0f);
}

// Depth of half the size: 2 pixels of the image are one of its own.
TEST_F(DepthRegistrationTest, AShiftOfASmallerDepthImage) {
  is_still_ = true;
  shrink_ = 2;
  dynamic_features(1.0, MatchState::matched);
  observe(60, 0.0, 2.0);
  EXPECT_NEAR(registration_.right_px(), -2, 1);
  left_px_.fill(100.0);
  observe(1, 0.0, 2.0, [](double) { return 0.0; });
  const DepthView undone = undo(Pose::Identity());
  EXPECT_EQ(undone.metres(48, 15), 3.0f);
  EXPECT_EQ(undone.metres(50, 15), 1.0f);
}

TEST_F(DepthRegistrationTest, SwitchedOffThereIsNoShift) {
  is_still_ = true;
  dynamic_features(1.0, MatchState::matched);
  observe(60, 0.0, 3.0);
  registration_.is_enabled = false;
  EXPECT_EQ(registration_.right_px(), 0);
  EXPECT_TRUE(registration_.warnings().empty());
  EXPECT_EQ(undo(Pose::Identity()).image.data, depth_.view().data);
  registration_.is_enabled = true;
  registration_.reset();
  EXPECT_EQ(registration_.right_px(), 0);
}

TEST_F(DepthRegistrationTest, SwitchedOffItLooksAtNothing) {
  registration_.is_enabled = false;
  observe(80, 1.0);
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

// Whoever has switched it off is not warned of what it found, nor gets it back.
TEST_F(DepthRegistrationTest, SwitchedOffItForgets) {
  observe(80, 1.0);
  registration_.is_enabled = false;
  EXPECT_EQ(registration_.delay_s(), 0.0);
  observe(1, 0.0);
  registration_.is_enabled = true;
  EXPECT_EQ(registration_.delay_s(), 0.0);
}

// A post's left edge at 100 in the late depth; the camera's motion takes it 10 px to the right within a frame.
TEST_F(DepthRegistrationTest, UndoneTheDepthLiesOnItsImage) {
  observe(80, 1.0);
  left_px_.fill(100.0);
  observe(1, 0.0, 0.0, [](double) { return 0.0; });
  const Pose motion = make_pose(Matrix3d::Identity(), {10.0 / kFocal_px, 0.0, 0.0});
  const DepthView undone = undo(motion);
  EXPECT_NE(undone.metres(109, 30), 1.0f);
  EXPECT_EQ(undone.metres(110, 30), 1.0f);
  EXPECT_EQ(undone.metres(121, 30), 1.0f);
  EXPECT_NE(undone.metres(122, 30), 1.0f);
}

// A post that stands before a camera that stands, and whose corners went 10 px to the right.
TEST_F(DepthRegistrationTest, UndoneAlongTheFlowItLiesOnWhatMoves) {
  observe(80, 1.0);
  left_px_.fill(100.0);
  observe(1, 0.0, 0.0, [](double) { return 0.0; });
  FrameView frame = view();
  frame.depth = undo(Pose::Identity());
  EXPECT_EQ(frame.depth.metres(100, 30), 1.0f);
  matches_.begin({});
  matches_.resize(2);
  matches_.current.pixel = {Vector2f(116, 30), Vector2f(80, 30)};
  matches_.reference.pixel = {Vector2f(106, 30), Vector2f(80, 30)};
  matches_.state = {MatchState::matched, MatchState::matched};
  Workspace workspace;
  const DepthView undone = registration_.undo_along_flow(view(), frame, matches_, workspace);
  EXPECT_EQ(undone.metres(109, 30), 3.0f);
  EXPECT_EQ(undone.metres(110, 30), 1.0f);
  EXPECT_EQ(undone.metres(121, 30), 1.0f);
  EXPECT_EQ(undone.metres(122, 30), 3.0f);
}

// 20 px within two seconds, of which depth is one late: 10 px.
TEST_F(DepthRegistrationTest, AfterADroppedFrameAsMuchIsUndone) {
  observe(80, 1.0);
  left_px_.fill(100.0);
  observe(1, 0.0, 0.0, [](double) { return 0.0; });
  FrameView frame = view();
  frame.depth = undo(make_pose(Matrix3d::Identity(), {20.0 / kFocal_px, 0.0, 0.0}), 2.0);
  EXPECT_EQ(frame.depth.metres(110, 30), 1.0f);
  EXPECT_EQ(frame.depth.metres(121, 30), 1.0f);
  frame.depth = undo(Pose::Identity(), 2.0);
  matches_.begin({});
  matches_.resize(1);
  matches_.elapsed_s = 2.0;
  matches_.current.pixel = {Vector2f(116, 30)};
  matches_.reference.pixel = {Vector2f(96, 30)};
  matches_.state = {MatchState::matched};
  Workspace workspace;
  const DepthView undone = registration_.undo_along_flow(view(), frame, matches_, workspace);
  EXPECT_EQ(undone.metres(110, 30), 1.0f);
  EXPECT_EQ(undone.metres(121, 30), 1.0f);
}

TEST_F(DepthRegistrationTest, DepthThatIsNotLateIsHandedOnAsItIs) {
  observe(40, 0.0);
  const DepthView undone = undo(make_pose(Matrix3d::Identity(), {0.1, 0.0, 0.0}));
  EXPECT_EQ(undone.image.data, depth_.view().data);
  matches_.resize(1);
  matches_.state[0] = MatchState::matched;
  matches_.current.pixel[0] = {50, 30};
  matches_.reference.pixel[0] = {40, 30};
  Workspace workspace;
  EXPECT_EQ(registration_.undo_along_flow(view(), view(), matches_, workspace).image.data, depth_.view().data);
}

// Nor is there any of a frame without a depth image, or of one for which it is switched off.
TEST_F(DepthRegistrationTest, WhatCannotBeUndoneIsHandedOnAsItIs) {
  observe(80, 1.0);
  Workspace workspace;
  const FrameView bare(gray_.view(), DepthView(), 0.0);
  EXPECT_TRUE(registration_.undo(view(), bare, Pose::Identity(), camera()).empty());
  EXPECT_EQ(registration_.undo_along_flow(bare, view(), matches_, workspace).image.data, depth_.view().data);
  registration_.is_enabled = false;
  EXPECT_EQ(undo(Pose::Identity()).image.data, depth_.view().data);
  EXPECT_EQ(registration_.undo_along_flow(view(), view(), matches_, workspace).image.data, depth_.view().data);
}

}  // namespace
}  // namespace stillpoint::depth_registration_test
