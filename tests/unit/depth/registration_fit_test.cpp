// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/registration_fit.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::registration_fit_test {
namespace {

constexpr int kWidth = 320, kHeight = 40;

/// One post per jump: bright, 100 gray levels more than what is around it, 40 px wide. The gray step of an edge is seen
/// by a jump at its pixel or a half beside it, by one that is a pixel farther off no more.
class RegistrationFitTest : public testing::Test {
 protected:
  RegistrationFitTest() { clear(); }

  void clear() {
    gray_.resize(kWidth, kHeight, PixelFormat::gray8);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) gray_.row<std::uint8_t>(v)[u] = 50;
  }

  /// A post whose left edge is at `left_px`, and the jump of its depth.
  /// @param late_px   the jump lies so far behind the edge
  /// @param flow_px   to the right
  void post(int left_px, float late_px, float flow_px) {
    for (int v = 0; v < kHeight; ++v)
      for (int u = left_px; u < left_px + 40; ++u) gray_.row<std::uint8_t>(v)[u] = 150;
    jumps_.push_back({{static_cast<float>(left_px) - late_px, 20.0f}, {flow_px, 0.0f}});
  }

  void look(int times) {
    for (int i = 0; i < times; ++i) fit_.add(gray_.view(), jumps_);
  }

  ImageBuffer gray_;
  std::vector<FlowingJump> jumps_;
  RegistrationFit fit_;
};

TEST_F(RegistrationFitTest, KnowsNothingAtFirst) {
  const RegistrationFit::Best best = fit_.best();
  EXPECT_EQ(best.intervals, 0.0);
  EXPECT_EQ(best.gain, 0.0f);
  EXPECT_EQ(best.deviations, 0.0f);
}

// Two posts go to the right by 16 px and two to the left, all jumps are 16 px behind. At a delay of one frame all four
// lie on an edge. At none a shift of ±4 px reaches no edge, and any gain is infinite.
TEST_F(RegistrationFitTest, WhatGoesBothWaysTellsTheDelay) {
  post(40, 16, 16);
  post(120, 16, 16);
  post(200, -16, -16);
  post(270, -16, -16);
  look(10);
  const RegistrationFit::Best best = fit_.best();
  EXPECT_EQ(best.intervals, 1.0);
  EXPECT_TRUE(best.is_inside);
  EXPECT_EQ(best.gain, std::numeric_limits<float>::infinity());
}

// 4 px a frame either way: at no delay a shift of 4 px to one side puts one post of two on its edge. All of them over
// half of them: a gain of 1. Six looks at four jumps fade by 0.98 each: 4 · (1 - 0.98⁶) / 0.02 = 22.83 jumps, √22.83
// = 4.78.
TEST_F(RegistrationFitTest, AShiftServesOneWayOnly) {
  post(60, 4, 4);
  post(120, 4, 4);
  post(180, -4, -4);
  post(240, -4, -4);
  look(6);
  const RegistrationFit::Best best = fit_.best();
  EXPECT_EQ(best.intervals, 1.0);
  EXPECT_NEAR(best.gain, 1.0f, 1e-4f);
  EXPECT_NEAR(best.deviations, 4.78f, 0.01f);
}

TEST_F(RegistrationFitTest, WhatGoesOneWayMayBeAShift) {
  post(60, 3, 3);
  post(120, 3, 3);
  look(20);
  const RegistrationFit::Best best = fit_.best();
  EXPECT_EQ(best.intervals, 0.0);
  EXPECT_EQ(best.gain, 0.0f);
  EXPECT_EQ(best.right_px, 2) << "of the two pixels beside the edge the one that is nearer";
  EXPECT_EQ(best.down_px, 0) << "the post is as high as the image: all rows are alike";
  EXPECT_EQ(best.shift_gain, std::numeric_limits<float>::infinity()) << "no step 3 px before the edge";
}

// A jump 2 px before the edge: moved by 1 px it sees the step up to the post's first column, moved by 2 px that to its
// second. 97 of 100 gray levels are nearly as good, 90 are not.
TEST_F(RegistrationFitTest, TheShortestOfShiftsThatAreNearlyAsGood) {
  for (const int first_column : {147, 140}) {
    fit_.reset();
    jumps_.clear();
    for (const int left_px : {60, 120}) {
      post(left_px, 2, 0);
      for (int v = 0; v < kHeight; ++v) gray_.row<std::uint8_t>(v)[left_px] = static_cast<std::uint8_t>(first_column);
    }
    look(20);
    EXPECT_EQ(fit_.best().right_px, first_column == 147 ? 1 : 2);
  }
}

TEST_F(RegistrationFitTest, NoShiftIsBestWhereThereIsNone) {
  post(60, 0, 3);
  post(120, 0, -3);
  look(20);
  const RegistrationFit::Best best = fit_.best();
  EXPECT_EQ(best.shift_gain, 0.0f);
}

TEST_F(RegistrationFitTest, DepthThatIsTooNewIsBefore) {
  post(60, -8, 16);
  post(200, 8, -16);
  look(20);
  EXPECT_EQ(fit_.best().intervals, -0.5);
}

// 9 px to the left of all edges, which no shift reaches: at a delay of a frame the shift of 4 px, the farthest, does.
TEST_F(RegistrationFitTest, SaysThatTheFarthestShiftIsBest) {
  post(60, 9, 5);
  post(120, 9, 5);
  look(20);
  EXPECT_FALSE(fit_.best().is_inside);
}

// Looks at one delay, then at another: 0.98 of the older each time, so that soon the newer is the better.
TEST_F(RegistrationFitTest, WhatWasLongAgoFades) {
  const auto look_at = [&](int times, float late_px) {
    clear();
    jumps_.clear();
    post(60, late_px, 16);
    post(200, -late_px, -16);
    look(times);
  };
  look_at(200, 16);
  EXPECT_EQ(fit_.best().intervals, 1.0);
  look_at(20, 0);
  EXPECT_EQ(fit_.best().intervals, 1.0) << "1 - 0.98^20 is a third of all";
  look_at(40, 0);
  EXPECT_EQ(fit_.best().intervals, 0.0) << "1 - 0.98^60 are two thirds";
}

TEST_F(RegistrationFitTest, FewJumpsTellNothing) {
  post(60, 16, 16);
  post(200, -16, -16);
  look(11);
  EXPECT_EQ(fit_.best().intervals, 0.0) << "2 · (1 - 0.98^11) / 0.02 = 19.9";
  look(1);
  EXPECT_EQ(fit_.best().intervals, 1.0);
}

TEST_F(RegistrationFitTest, AResetForgets) {
  post(60, 16, 16);
  post(200, -16, -16);
  look(20);
  EXPECT_EQ(fit_.best().intervals, 1.0);
  fit_.reset();
  EXPECT_EQ(fit_.best().intervals, 0.0);
}

// An image without an edge, no jumps, jumps that all move out of the image.
TEST_F(RegistrationFitTest, NothingToSeeTellsNothing) {
  fit_.add(gray_.view(), {});
  fit_.add(gray_.view(), std::vector<FlowingJump>{{{100.0f, 20.0f}, {8.0f, 0.0f}}});
  fit_.add(gray_.view(), std::vector<FlowingJump>{{{1e9f, 20.0f}, {8.0f, 0.0f}}});
  EXPECT_EQ(fit_.best().intervals, 0.0);
  EXPECT_EQ(fit_.best().deviations, 0.0f);
}

}  // namespace
}  // namespace stillpoint::registration_fit_test
