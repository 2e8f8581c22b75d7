// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/corner_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "wave_texture.hpp"

namespace stillpoint::corner_tracker_test {
namespace {

static_assert(is_matcher<CornerTracker>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 320, kHeight = 240;

CornerTracker tracker() {
  CornerTracker tracker;
  tracker.options.cell_px = 20;
  return tracker;
}

Matches follow(CornerTracker& tracker, const cv::Mat& reference, double reference_s, const cv::Mat& current,
               double current_s, const std::vector<Vector2f>& keypoints = {}) {
  Matches matches;
  matches.begin(keypoints);
  tracker.match(FrameView(reference, DepthView(), reference_s), FrameView(current, DepthView(), current_s), matches);
  return matches;
}

/// Counts the corners that were found `shift` from where they are now.
std::size_t followed_by(const Matches& matches, const Vector2f& shift) {
  std::size_t count = 0;
  for (std::size_t i = matches.host_count; i < matches.size(); ++i)
    count += matches.matched(i) && (matches.reference.pixel[i] - matches.current.pixel[i] - shift).norm() < 0.5f;
  return count;
}

/// A part of one rendered picture of a room: parts that begin elsewhere are the same content, moved by whole pixels.
cv::Mat room_seen_from(int u, int v) {
  static const cv::Mat picture = [] {
    SyntheticFrame frame;
    SyntheticSequence(synthetic::static_room()).render(20, frame);
    const ImageView view = frame.gray.view();
    return cv::Mat(view.height, view.width, CV_8UC1, const_cast<std::uint8_t*>(view.data), view.stride_bytes).clone();
  }();
  return picture(cv::Rect(u, v, kWidth, kHeight)).clone();
}

// The window moves by (−10, 6), so that content moves by (10, −6) and corners are found (−10, 6) away.
TEST(CornerTracker, FollowsATenPixelMotion) {
  for (const auto& [u, v] : {std::pair{20, 20}, {160, 120}, {290, 60}}) {
    CornerTracker corners = tracker();
    const Matches matches = follow(corners, room_seen_from(u, v), 1.0, room_seen_from(u - 10, v + 6), 1.1);
    EXPECT_EQ(matches.host_count, 0u);
    ASSERT_GT(matches.size(), 100u);
    EXPECT_LE(matches.size(), 192u) << "16 × 12 cells";
    std::size_t matched = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      matched += matches.matched(i);
      const Vector2f pixel = matches.current.pixel[i];
      EXPECT_EQ(pixel, Vector2f(pixel.array().round())) << "a corner is a pixel: patches are cut there";
    }
    EXPECT_GE(followed_by(matches, {-10, 6}), matches.size() / 2) << "near the border there is no coarse level";
    EXPECT_GE(followed_by(matches, {-10, 6}), matched * 9 / 10) << "and those are lost, not wrong";
  }
}

// Content moves by 16 px to the right: what is now in the first 16 columns was outside of the reference.
TEST(CornerTracker, WhatWasOutsideIsLost) {
  CornerTracker corners = tracker();
  const Matches matches = follow(corners, room_seen_from(160, 120), 1.0, room_seen_from(144, 120), 1.1);
  std::size_t outside = 0, claimed = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches.current.pixel[i].x() >= 16) continue;
    ++outside;
    claimed += matches.matched(i);
  }
  EXPECT_GE(outside, 5u);
  EXPECT_LE(claimed, outside / 4);
}

TEST(CornerTracker, FoundNearTheBorderIsNearEdge) {
  const test::WaveTexture texture(3);
  CornerTracker corners = tracker();
  const cv::Mat image = texture.shifted(kWidth, kHeight, {0, 0});
  const cv::Mat before = texture.shifted(kWidth, kHeight, {-6, 0});  // corners are found further left
  const Matches matches = follow(corners, before, 1.0, image, 1.1);
  std::size_t near_edge = 0, matched = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches.matched(i)) continue;
    const Vector2f found = matches.reference.pixel[i];
    const bool at_edge = ImageView(image).border_distance_px(found.x(), found.y()) < 8.0f;
    EXPECT_EQ(matches.state[i], at_edge ? MatchState::near_edge : MatchState::matched);
    ++(at_edge ? near_edge : matched);
  }
  EXPECT_GE(near_edge, 3u);
  EXPECT_GT(matched, 5u);
}

TEST(CornerTracker, HostFeaturesAreNotFollowedButThoseOutsideAreMarked) {
  const test::WaveTexture texture(4);
  const cv::Mat image = texture.shifted(kWidth, kHeight, {0, 0});
  CornerTracker corners = tracker();
  const std::vector<Vector2f> keypoints = {{50, 50},   {0, 0},      {kWidth - 1, kHeight - 1},
                                           {-1, 50},   {50, -0.5f}, {320, 50},
                                           {kNaN, 50}, {50, kNaN},  {std::numeric_limits<float>::infinity(), 50}};
  const Matches matches = follow(corners, image, 1.0, image, 1.1, keypoints);
  ASSERT_EQ(matches.host_count, keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i)
    EXPECT_EQ(matches.state[i], i < 3 ? MatchState::lost : MatchState::outside) << i;
  EXPECT_GT(matches.size(), keypoints.size());
}

TEST(CornerTracker, UnrelatedImagesLoseTheirCorners) {
  CornerTracker corners = tracker();
  const Matches matches = follow(corners, test::WaveTexture(5).shifted(kWidth, kHeight, {0, 0}), 1.0,
                                 test::WaveTexture(6).shifted(kWidth, kHeight, {0, 0}), 1.1);
  std::size_t matched = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) matched += matches.matched(i);
  EXPECT_LT(matched, matches.size() / 3);
}

// The last frame's pyramid is kept for its time stamp; any other reference is built anew.
TEST(CornerTracker, AReferenceIsRecognisedByItsTime) {
  const test::WaveTexture texture(7);
  const cv::Mat at_0 = texture.shifted(kWidth, kHeight, {0, 0}), at_3 = texture.shifted(kWidth, kHeight, {3, 0}),
                at_9 = texture.shifted(kWidth, kHeight, {9, 0});
  CornerTracker corners = tracker();
  follow(corners, at_0, 1.0, at_3, 1.1);
  const Matches next = follow(corners, at_3, 1.1, at_9, 1.2);
  EXPECT_GE(followed_by(next, {-6, 0}), next.size() / 2);
  const Matches jump = follow(corners, at_0, 1.0, at_3, 1.3);
  EXPECT_GE(followed_by(jump, {-3, 0}), jump.size() / 2) << "the reference is not the last frame";
  corners.reset();
  const Matches same_time = follow(corners, at_9, 1.3, at_0, 1.4);
  EXPECT_GE(followed_by(same_time, {9, 0}), same_time.size() / 2) << "after reset() a time stamp says nothing";
}

// Tiles that repeat every 20 px, with a little texture of their own, hang behind a curtain that fills two thirds of the
// view and was drawn 20 px to the right: the alignment follows the curtain, and from there each tile finds the one
// beside it. Where the camera is expected at rest, the tiles are looked for there as well, and fit better.
TEST(CornerTracker, WhereTheAlignmentIsWrongTheExpectedPlaceFitsBetter) {
  constexpr int kPeriod_px = 20, kCurtain = 2 * kWidth / 3;
  const test::WaveTexture of_tiles(8), of_curtain(9);
  const auto tiles = [&](const Vector2d& p) -> double {
    const double phase = 6.2831853 / kPeriod_px;
    return 100.0 + 40.0 * std::sin(phase * p.x()) * std::sin(phase * p.y()) + 0.1 * (of_tiles.at(p) - 128.0);
  };
  const auto frame = [&](int drawn_px) {
    cv::Mat image = of_curtain.shifted(kWidth, kHeight, {static_cast<double>(drawn_px), 0});
    for (int v = 0; v < kHeight; ++v)
      for (int u = kCurtain; u < kWidth; ++u)
        image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(tiles({u, v}));
    return image;
  };
  const cv::Mat before = frame(0), now = frame(kPeriod_px), depth(kHeight, kWidth, CV_16UC1, cv::Scalar(10000));
  const FrameView reference(before, DepthView::tum(depth), 1.0), current(now, DepthView::tum(depth), 1.1);
  const Camera camera(260, 260, 159.5, 119.5, kWidth, kHeight);
  CornerTracker corners = tracker();
  const Pose found = corners.align(reference, current, Pose::Identity(), camera, KinectNoise());
  const Vector3d ahead(0, 0, 2.0);
  EXPECT_NEAR(camera.project(found * ahead).x() - camera.project(ahead).x(), -kPeriod_px, 6)
      << "it follows the curtain";
  Matches matches;
  matches.begin(span<const Vector2f>());
  corners.match(reference, current, matches);
  std::size_t on_tiles = 0, right = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!(matches.current.pixel[i].x() > kCurtain + 12) || !matches.matched(i)) continue;
    ++on_tiles;
    right += (matches.reference.pixel[i] - matches.current.pixel[i]).norm() < 0.5f;
  }
  EXPECT_GE(on_tiles, 30u);
  EXPECT_GE(right, on_tiles * 9 / 10);
}

TEST(CornerTracker, TinyAndFlatImagesHaveNoCorners) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {16, 16}, {25, 300}, {200, 150}}) {
    CornerTracker corners = tracker();
    const cv::Mat flat(height, width, CV_8UC1, cv::Scalar(90));
    EXPECT_EQ(follow(corners, flat, 1.0, flat, 1.1).size(), 0u) << width << " x " << height;
  }
}

}  // namespace
}  // namespace stillpoint::corner_tracker_test
