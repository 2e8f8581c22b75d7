// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/temporal_hole_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_noise.hpp"

namespace stillpoint::temporal_hole_filling_test {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr double kFocal_px = 100.0, kFactor = 1000.0;

Camera camera() { return Camera(kFocal_px, kFocal_px, 31.5, 23.5, kWidth, kHeight); }

/// An image with a depth image beside it, in millimetres or float metres.
struct Images {
  ImageBuffer gray, depth;
  double timestamp_s = 0.0;

  /// A gray pattern that is moved to the right, a wall everywhere.
  Images(double time_s, double depth_m, int right_px = 0, PixelFormat format = PixelFormat::depth16)
      : timestamp_s(time_s) {
    gray.resize(kWidth, kHeight, PixelFormat::gray8);
    depth.resize(kWidth, kHeight, format);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        gray.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(100 + 40 * ((u - right_px + kWidth) / 8 % 2));
        set(u, v, depth_m);
      }
  }

  void set(int u, int v, double depth_m) {
    if (depth.view().format == PixelFormat::depth16)
      depth.row<std::uint16_t>(v)[u] = static_cast<std::uint16_t>(std::lround(depth_m * kFactor));
    else
      depth.row<float>(v)[u] = static_cast<float>(depth_m);
  }
  void brighten(int by) {
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        gray.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(gray.row<std::uint8_t>(v)[u] + by);
  }
  /// @param hole_m  what stands for no depth
  void dig(int left, int right, double hole_m = 0.0) {
    for (int v = 10; v < 38; ++v)
      for (int u = left; u < right; ++u) set(u, v, hole_m);
  }
  FrameView view() const { return FrameView(gray.view(), DepthView(depth.view(), kFactor), timestamp_s); }
};

class TemporalHoleFillingTest : public testing::Test {
 protected:
  /// The depth of a pixel after the holes of `current` are filled, metres.
  float filled_m(const FrameView& reference, const FrameView& current, int u = 30, int v = 20,
                 const Pose& motion = Pose::Identity()) {
    filled_ = filling_.fill(reference, current, motion, camera(), KinectNoise());
    return filled_.metres(u, v);
  }
  float filled_m(const Images& reference, const Images& current, int u = 30, int v = 20,
                 const Pose& motion = Pose::Identity()) {
    return filled_m(reference.view(), current.view(), u, v, motion);
  }
  static Pose step(double x_m, double z_m) { return make_pose(Matrix3d::Identity(), {x_m, 0.0, z_m}); }

  TemporalHoleFilling filling_;
  DepthView filled_;
};

TEST_F(TemporalHoleFillingTest, AHoleTakesTheDepthOfTheLastFrameAndWhatIsMeasuredStays) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.01);
  now.dig(20, 40);
  EXPECT_EQ(filled_m(before, now), 2.0f);
  EXPECT_EQ(filled_.metres(45, 20), 2.01f) << "measured";
  EXPECT_NE(filled_.image.data, now.depth.view().data);
  EXPECT_EQ(now.view().depth.metres(30, 20), 0.0f) << "the host's image is not written to";
}

TEST_F(TemporalHoleFillingTest, FloatDepthWithoutAValueIsAHoleToo) {
  const Images before(0.0, 2.0, 0, PixelFormat::depth32f);
  for (const float hole_m : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Images now(0.033, 2.0, 0, PixelFormat::depth32f);
    now.dig(20, 40, static_cast<double>(hole_m));
    EXPECT_EQ(filled_m(before, now), 2.0f) << hole_m;
  }
}

// The camera goes 0.1 m ahead: the wall at 2 m is 1.9 m away. The pixel 3 to the left of the middle shows what was
// 3 · 1.9 / 2 = 2.85 to the left.
TEST_F(TemporalHoleFillingTest, DepthChangesWithTheMotion) {
  Images before(0.0, 2.0), now(0.033, 1.9);
  for (Images* const images : {&before, &now})
    for (int v = 0; v < kHeight; ++v) std::fill_n(images->gray.row<std::uint8_t>(v), kWidth, std::uint8_t{90});
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 28, 20, step(0.0, -0.1)), 1.9f, 1e-3f);
}

// What is seen goes 0.04 m to the right: at 2 m that is f x / z = 2 px. The wall is steep: 1 cm deeper with each pixel
// to the right, so that what was at pixel 28 in 1.98 m is at pixel 28 + 4 / 1.98 now. So pixel 30 shows 1.98 m, less
// what 0.02 px are.
TEST_F(TemporalHoleFillingTest, DepthMovesAlong) {
  Images before(0.0, 0.0), now(0.033, 2.0, 2);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) before.set(u, v, 1.7 + 0.01 * u);
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 30, 20, step(0.04, 0.0)), 1.98f, 2e-3f);
  EXPECT_NEAR(filled_m(before, now, 30, 20, step(0.05, 0.0)), 1.975f, 1e-3f) << "2.5 px: between two pixels";
}

// The same downwards: at 2 m 2.5 px, to pixel 20 from 17.5, where the wall is 1.8 + 0.01 · 17.5 m away.
TEST_F(TemporalHoleFillingTest, DepthMovesDownwardsAlong) {
  Images before(0.0, 0.0), now(0.033, 2.0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) before.set(u, v, 1.8 + 0.01 * v);
  now.dig(20, 40);
  EXPECT_NEAR(filled_m(before, now, 30, 20, make_pose(Matrix3d::Identity(), {0.0, 0.05, 0.0})), 1.975f, 1e-3f);
}

TEST_F(TemporalHoleFillingTest, WhereTheImageChangedSomethingElseHasCome) {
  for (const auto& [brighter, expected_m] : {std::pair{18, 2.0f}, std::pair{19, 0.0f}, std::pair{-19, 0.0f}}) {
    const Images before(0.0, 2.0);
    Images now(0.033, 2.0);
    now.dig(20, 40);
    now.brighten(brighter);
    EXPECT_EQ(filled_m(before, now), expected_m) << brighter;
  }
}

/// For how many frames a hole keeps its depth.
int frames_filled(TemporalHoleFilling& filling, double interval_s) {
  Images last(0.0, 2.0);
  for (int frame = 1; frame < 20; ++frame) {
    Images now(frame * interval_s, 2.0);
    now.dig(20, 40);
    const DepthView filled = filling.fill(last.view(), now.view(), Pose::Identity(), camera(), KinectNoise());
    if (!(filled.metres(30, 20) > 0.0f)) return frame - 1;
    now.depth.assign(filled.image);
    std::swap(last, now);
  }
  return 20;
}

TEST_F(TemporalHoleFillingTest, ATenthOfASecondAfterItWasMeasuredADepthIsGone) {
  for (const auto& [rate_hz, frames] : {std::pair{60.0, 6}, {30.0, 3}, {15.0, 1}, {10.0, 1}, {5.0, 0}}) {
    TemporalHoleFilling filling;
    EXPECT_EQ(frames_filled(filling, 1.0 / rate_hz), frames) << rate_hz << " Hz";
  }
}

TEST_F(TemporalHoleFillingTest, WhatIsMeasuredAgainIsNewAgain) {
  Images last(0.0, 2.0);
  for (int frame = 1; frame <= 12; ++frame) {
    Images now(frame / 30.0, 2.0);
    if (frame % 3 != 0) now.dig(20, 40);
    const DepthView filled = filling_.fill(last.view(), now.view(), Pose::Identity(), camera(), KinectNoise());
    EXPECT_EQ(filled.metres(30, 20), 2.0f) << frame;
    now.depth.assign(filled.image);
    std::swap(last, now);
  }
}

// At edges depth comes and goes in every frame: 96 of the 256 pixels of a tile must have lost it.
TEST_F(TemporalHoleFillingTest, AFewPixelsAreNotWorthIt) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.0);
  for (int v = 16; v < 32; ++v)
    for (int u = 20; u < 26; ++u) now.set(u, v, 0.0);
  EXPECT_EQ(filled_m(before, now, 22), 2.0f);
  now.set(20, 16, 2.0);
  EXPECT_EQ(filled_m(before, now, 22), 0.0f);
}

TEST_F(TemporalHoleFillingTest, TheDepthOfAnEdgeIsNotHandedOn) {
  Images before(0.0, 2.0), now(0.033, 2.0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 32; u < kWidth; ++u) before.set(u, v, 3.0);
  now.dig(20, 44);
  EXPECT_EQ(filled_m(before, now, 31), 0.0f);
  EXPECT_EQ(filled_.metres(32, 20), 0.0f);
  EXPECT_EQ(filled_.metres(30, 20), 2.0f);
  EXPECT_EQ(filled_.metres(33, 20), 3.0f);
}

// Posts at 0.5 m before a wall at 3 m; beside each a hole of f B (1 / 0.5 − 1/3) = 100 · 0.042 · 5/3 = 7 px, in all
// rows.
TEST_F(TemporalHoleFillingTest, AShadowOfTheSensorStaysAHole) {
  const Images before(0.0, 3.0);
  for (const double post_m : {0.5, 3.0}) {
    Images now(0.033, 3.0);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        if (u % 16 >= 1) now.set(u, v, u % 16 >= 8 ? post_m : 0.0);
    EXPECT_EQ(filled_m(before, now, 36), post_m < 3.0 ? 0.0f : 3.0f) << "posts at " << post_m << " m";
  }
}

TEST_F(TemporalHoleFillingTest, WhatWasOutsideTheImageOrBehindTheCameraStaysAHole) {
  const Images before(0.0, 2.0);
  Images now(0.033, 2.0);
  now.dig(0, kWidth);
  EXPECT_EQ(filled_m(before, now, 2, 20, step(0.2, 0.0)), 0.0f) << "10 px to the right";
  EXPECT_EQ(filled_m(before, now, 30, 20, step(0.0, -2.5)), 0.0f);
  EXPECT_EQ(filled_m(before, now, 30, 20, step(1e9, 0.0)), 0.0f);
}

TEST_F(TemporalHoleFillingTest, WithoutAnImageOfTheSameKindDepthComesBackAsItIs) {
  Images now(0.033, 2.0);
  now.dig(20, 40);
  const auto comes_back = [&](const FrameView& reference) {
    filled_m(reference, now.view());
    return filled_.image.data == now.depth.view().data;
  };
  const Images before(0.0, 2.0);
  FrameView reference = before.view();
  reference.depth = DepthView();
  EXPECT_TRUE(comes_back(reference)) << "no depth before";
  EXPECT_TRUE(comes_back(Images(0.0, 2.0, 0, PixelFormat::depth32f).view())) << "another format";
  ImageBuffer small;
  small.assign(before.depth.view());
  small.resize(kWidth, kHeight - 1, PixelFormat::depth16);
  reference.depth = DepthView(small.view(), kFactor);
  EXPECT_TRUE(comes_back(reference)) << "another size";
  filling_.is_enabled = false;
  EXPECT_TRUE(comes_back(before.view()));
}

// Colour at 30 Hz, depth at 15: every other frame has what the last one measured, and the third in a row nothing.
TEST_F(TemporalHoleFillingTest, AFrameWithoutADepthImageHasNothingButHoles) {
  for (const PixelFormat format : {PixelFormat::depth16, PixelFormat::depth32f}) {
    filling_ = TemporalHoleFilling();
    const Images before(0.0, 2.0, 0, format);
    const Images now(0.05, 2.0);
    FrameView blind = now.view();
    blind.depth = DepthView();
    const DepthView filled = filling_.fill(before.view(), blind, Pose::Identity(), camera(), KinectNoise());
    ASSERT_FALSE(filled.empty());
    EXPECT_EQ(filled.image.format, format);
    EXPECT_EQ(filled.metres(32, 24), 2.0f);
    const Images late(0.12, 2.0);
    FrameView later = late.view();
    later.depth = DepthView();
    EXPECT_TRUE(filling_.fill(before.view(), later, Pose::Identity(), camera(), KinectNoise()).empty()) << "too old";
  }
  const Images first(0.0, 2.0);
  FrameView blind = first.view();
  blind.depth = DepthView();
  EXPECT_TRUE(filling_.fill(blind, blind, Pose::Identity(), camera(), KinectNoise()).empty()) << "never any depth";
}

TEST_F(TemporalHoleFillingTest, ADepthImageOfHalfTheSizeIsFilledToo) {
  Images before(0.0, 2.0), now(0.033, 2.0);
  std::array<ImageBuffer, 2> half;
  for (ImageBuffer& depth : half) {
    depth.resize(kWidth / 2, kHeight / 2, PixelFormat::depth32f);
    for (int v = 0; v < kHeight / 2; ++v) std::fill_n(depth.row<float>(v), kWidth / 2, 2.0f);
  }
  for (int v = 2; v < 14; ++v) std::fill_n(half[1].row<float>(v) + 4, 10, 0.0f);
  FrameView reference = before.view(), current = now.view();
  reference.depth = DepthView(half[0].view());
  current.depth = DepthView(half[1].view());
  EXPECT_EQ(filled_m(reference, current, 10, 10), 2.0f);
  now.brighten(19);
  EXPECT_EQ(filled_m(reference, current, 10, 10), 0.0f);
}

/// What is seen goes 6 px to the right while the camera stands; the wall is 1 cm deeper with each pixel to the right.
/// So the hole at pixel 30 shows what was at pixel 24, in 1.94 m.
class AlongFlow : public TemporalHoleFillingTest {
 protected:
  static constexpr double kIn24_m = 1.94;

  AlongFlow() {
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) before_.set(u, v, 1.7 + 0.01 * u);
    now_.dig(20, 40);
  }

  /// @param keypoints  the host's
  void begin(std::initializer_list<Vector2f> keypoints) {
    matches_.begin(span<const Vector2f>(keypoints.begin(), keypoints.size()));
  }
  void add_corner(const Vector2f& pixel, const Vector2f& step) {
    matches_.resize(matches_.size() + 1);
    matches_.current.pixel.back() = pixel;
    matches_.reference.pixel.back() = pixel - step;
    matches_.state.back() = MatchState::matched;
  }
  /// The depth of pixel (30, 20) after both fillings, metres.
  float filled_along_m() {
    const float static_m = filled_m(before_, now_);
    EXPECT_EQ(static_m, 0.0f) << "in the place of a static point the image differs";
    FrameView now = now_.view();
    now.depth = filled_;
    filled_ = filling_.fill_along_flow(before_.view(), now, matches_, KinectNoise(), workspace_);
    return filled_.metres(30, 20);
  }

  Images before_{0.0, 0.0}, now_{0.033, 2.0, 6};
  Matches matches_;
  Workspace workspace_;
  std::vector<std::unique_ptr<ImageBuffer>> kept_;  // depth images of frames of the past
};

TEST_F(AlongFlow, AFeatureTakesItsDepthAlongAsTheCornersAroundItMove) {
  begin({{30, 20}});
  EXPECT_EQ(filled_along_m(), 0.0f) << "no corner, no flow";
  add_corner({36, 26}, {6, 0});
  EXPECT_NEAR(filled_along_m(), kIn24_m, 1e-3);
  EXPECT_EQ(now_.view().depth.metres(30, 20), 0.0f) << "the host's image is not written to";
  matches_.state.back() = MatchState::lost;
  EXPECT_EQ(filled_along_m(), 0.0f) << "a corner that was not found has no flow";
}

TEST_F(AlongFlow, OfAllCornersTheMostAlikeIsFollowed) {
  for (const bool own_first : {true, false}) {
    begin({{30, 20}});
    if (own_first) add_corner({36, 26}, {6, 0});
    add_corner({33, 23}, {5, 0});  // one column of five differs by 80 / 2: 16 on average, alike but less so
    if (!own_first) add_corner({36, 26}, {6, 0});
    EXPECT_NEAR(filled_along_m(), kIn24_m, 1e-3) << own_first;
  }
}

TEST_F(AlongFlow, WhatIsAlikeNowhereStaysAHole) {
  begin({{30, 20}});
  add_corner({36, 26}, {6, 0});
  const std::uint8_t alike = now_.gray.row<std::uint8_t>(20)[30];
  now_.brighten(19);
  now_.gray.row<std::uint8_t>(20)[30] = alike;  // alone of 25: 24 · 19 / 25 > 18
  EXPECT_EQ(filled_along_m(), 0.0f);
}

TEST_F(AlongFlow, AFewPixelsAreNotWorthIt) {
  for (int v = 17; v <= 23; ++v)
    for (int u = 50; u <= 56; ++u) now_.set(u, v, 0.0);
  begin({{53, 20}});
  add_corner({50, 26}, {6, 0});
  filled_along_m();
  EXPECT_EQ(filled_.metres(53, 20), 0.0f);
}

TEST_F(AlongFlow, ACornerThatIsFarAwaySaysNothing) {
  begin({{30, 20}});
  matches_.pixel_scale = 0.25f;  // 12 px
  add_corner({30, 33}, {6, 0});
  EXPECT_EQ(filled_along_m(), 0.0f);
  add_corner({30, 31}, {6, 0});
  EXPECT_NEAR(filled_along_m(), kIn24_m, 1e-3);
}

TEST_F(AlongFlow, ThePixelsAroundAFeatureGoWithItWhereTheyAreAlike) {
  now_.gray.row<std::uint8_t>(22)[32] = static_cast<std::uint8_t>(now_.gray.row<std::uint8_t>(22)[32] + 19);
  begin({{30, 20}});
  add_corner({36, 26}, {6, 0});
  EXPECT_NEAR(filled_along_m(), kIn24_m, 1e-3);
  EXPECT_NEAR(filled_.metres(30, 32), kIn24_m, 1e-3) << "12 px below";
  EXPECT_EQ(filled_.metres(30, 33), 0.0f) << "13 px below";
  EXPECT_EQ(filled_.metres(32, 22), 0.0f) << "another gray value";
  EXPECT_EQ(filled_.metres(45, 20), 2.0f) << "measured";
}

// A corner of the matcher's own in a hole is a feature as others are.
TEST_F(AlongFlow, ACornerTakesItsOwnDepthAlong) {
  begin({});
  add_corner({30, 20}, {6, 0});
  EXPECT_NEAR(filled_along_m(), kIn24_m, 1e-3);
}

TEST_F(AlongFlow, AtTheBorderNothingComesFromOutside) {
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < 16; ++u) now_.set(u, v, 0.0);
  now_.gray.row<std::uint8_t>(20)[5] = before_.gray.row<std::uint8_t>(20)[0];
  begin({{8, 20}, {std::numeric_limits<float>::quiet_NaN(), 20}, {63, 47}});
  matches_.state[1] = MatchState::outside;
  add_corner({20, 20}, {6, 0});
  filled_along_m();
  EXPECT_NEAR(filled_.metres(8, 20), 1.72f, 1e-3f) << "what was at pixel 2";
  EXPECT_EQ(filled_.metres(5, 20), 0.0f) << "what was at pixel -1";
}

// The depth image has half the size of the gray one: a step of 12 px is one of 6 there.
TEST_F(AlongFlow, PixelsOfAnotherSizeThanTheDepthImage) {
  const auto widen = [](Images& images) {
    ImageBuffer wide;
    wide.resize(2 * kWidth, 2 * kHeight, PixelFormat::gray8);
    for (int v = 0; v < 2 * kHeight; ++v)
      for (int u = 0; u < 2 * kWidth; ++u) wide.row<std::uint8_t>(v)[u] = images.gray.row<std::uint8_t>(v / 2)[u / 2];
    images.gray = std::move(wide);
  };
  widen(before_);
  widen(now_);
  filled_ = filling_.fill(before_.view(), now_.view(), Pose::Identity(),
                          Camera(2 * kFocal_px, 2 * kFocal_px, 63.5, 47.5, 2 * kWidth, 2 * kHeight), KinectNoise());
  EXPECT_EQ(filled_.metres(32, 20), 0.0f);
  FrameView now = now_.view();
  now.depth = filled_;
  begin({{64, 41}});
  add_corner({73, 53}, {12, 0});
  filled_ = filling_.fill_along_flow(before_.view(), now, matches_, KinectNoise(), workspace_);
  EXPECT_NEAR(filled_.metres(32, 20), 1.96f, 1e-3f) << "what was at pixel 26";
  EXPECT_NEAR(filled_.metres(32, 26), 1.96f, 1e-3f);
  EXPECT_EQ(filled_.metres(32, 27), 0.0f) << "12 px of the gray image are 6 of the depth's";
}

// 30 Hz: three frames are within a tenth of a second, however the depth came along.
TEST_F(AlongFlow, ATenthOfASecondAfterItWasMeasuredADepthIsGone) {
  Images last = std::move(before_);
  DepthView last_depth = last.view().depth;
  for (int frame = 1; frame <= 4; ++frame) {
    Images next(0.033 * frame, 0.0, 6 * frame);
    FrameView reference = last.view(), current = next.view();
    reference.depth = last_depth;
    current.depth = filling_.fill(reference, current, Pose::Identity(), camera(), KinectNoise());
    begin({{static_cast<float>(22 + 6 * frame), 20.0f}});
    add_corner({30, 26}, {6, 0});
    const DepthView depth = filling_.fill_along_flow(reference, current, matches_, KinectNoise(), workspace_);
    EXPECT_NEAR(depth.metres(22 + 6 * frame, 20), frame <= 3 ? 1.92f : 0.0f, 1e-3f) << frame;
    kept_.push_back(std::make_unique<ImageBuffer>());
    kept_.back()->assign(depth.image);
    last_depth = DepthView(kept_.back()->view(), kFactor);
    last = std::move(next);
  }
}

TEST_F(AlongFlow, AfterAGapNothingIsTakenFromTheFrameBeforeIt) {
  begin({{30, 20}});
  add_corner({36, 26}, {6, 0});
  filled_along_m();
  now_.timestamp_s = 1.0;
  EXPECT_EQ(filled_along_m(), 0.0f);
  EXPECT_EQ(filled_.image.data, now_.depth.view().data);
}

TEST_F(AlongFlow, WithoutLostDepthTheImageComesBackAsItIs) {
  begin({{45, 20}});
  add_corner({36, 26}, {6, 0});
  Images whole(0.033, 2.0, 6);
  EXPECT_EQ(filling_.fill_along_flow(before_.view(), whole.view(), matches_, KinectNoise(), workspace_).image.data,
            whole.depth.view().data)
      << "before `fill`";
  filled_m(before_, whole);
  EXPECT_EQ(filling_.fill_along_flow(before_.view(), whole.view(), matches_, KinectNoise(), workspace_).image.data,
            whole.depth.view().data);
}

}  // namespace
}  // namespace stillpoint::temporal_hole_filling_test
