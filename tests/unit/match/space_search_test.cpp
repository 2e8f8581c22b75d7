// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/space_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/space_history.hpp"

namespace stillpoint::space_search_test {
namespace {

constexpr int kWidth = 320, kHeight = 240;

// ---- Pooled depth ----

FrameView view_of(const cv::Mat& gray, const cv::Mat& depth, double timestamp_s) {
  return FrameView(gray, DepthView::tum(depth), timestamp_s);
}

// Blocks of 320 / 160 = 2 px: the nearest depth of each, where half of its pixels have one.
TEST(PooledDepth, KeepsTheNearestDepthOfEachBlock) {
  const cv::Mat gray(kHeight, kWidth, CV_8UC1, cv::Scalar(50));
  cv::Mat depth(kHeight, kWidth, CV_32FC1, cv::Scalar(3.0));
  depth.at<float>(101, 201) = 1.0f;
  depth.at<float>(20, 20) = depth.at<float>(20, 21) = depth.at<float>(21, 20) = 0.0f;
  PooledDepth pooled;
  pooled.assign(view_of(gray, depth, 0), Pose::Identity());
  EXPECT_EQ(pooled.width, 160);
  EXPECT_EQ(pooled.height, 120);
  EXPECT_EQ(pooled.nearest_around({201, 101}), 1.0f);
  EXPECT_EQ(pooled.nearest_around({203, 99}), 1.0f) << "one block beside it";
  EXPECT_EQ(pooled.nearest_around({205, 101}), 3.0f) << "two blocks beside it";
  EXPECT_EQ(pooled.nearest_around({22, 22}), 0.0f) << "a block beside it is three quarters empty";
  for (const Vector2f& outside : {Vector2f(0, 100), Vector2f(-50, 100), Vector2f(319, 100), Vector2f(100, 239)})
    EXPECT_EQ(pooled.nearest_around(outside), 0.0f);
  EXPECT_EQ(pooled.nearest_around({std::numeric_limits<float>::quiet_NaN(), 3}), 0.0f);
}

/// Of a wall at 3 m, of which one pixel is 1 m away.
PooledDepth pooled_wall(int width, int height, const cv::Point& nearer) {
  const cv::Mat gray(height, width, CV_8UC1, cv::Scalar(50));
  cv::Mat depth(height, width, CV_32FC1, cv::Scalar(3.0));
  depth.at<float>(nearer) = 1.0f;
  PooledDepth pooled;
  pooled.assign(view_of(gray, depth, 0), Pose::Identity());
  return pooled;
}

// 480 / 5.3 = 90.6 blocks: the last is cut off, and those above it are known.
TEST(PooledDepth, KnowsTheLastRowsToo) {
  const PooledDepth pooled = pooled_wall(848, 480, {400, 475});
  EXPECT_EQ(pooled.height, 91);
  EXPECT_EQ(pooled.nearest_around({400, 474}), 1.0f);
  EXPECT_EQ(pooled.nearest_around({500, 474}), 3.0f);
  EXPECT_EQ(pooled.nearest_around({500, 479}), 0.0f) << "a border block has neighbours that are unknown";
}

// The camera on its side: the same blocks across.
TEST(PooledDepth, OfAnUprightImageToo) {
  const PooledDepth pooled = pooled_wall(480, 848, {475, 400});
  EXPECT_EQ(pooled.width, 91);
  EXPECT_EQ(pooled.height, 160);
  EXPECT_EQ(pooled.nearest_around({474, 400}), 1.0f);
  EXPECT_EQ(pooled.nearest_around({474, 500}), 3.0f);
  EXPECT_EQ(pooled.nearest_around({479, 500}), 0.0f) << "a border block has neighbours that are unknown";
}

TEST(SpaceHistory, KeepsAViewEachFourTenthsOfASecond) {
  const cv::Mat gray(kHeight, kWidth, CV_8UC1, cv::Scalar(50)), depth(kHeight, kWidth, CV_32FC1, cv::Scalar(3.0));
  SpaceHistory history;
  for (int f = 0; f <= 30; ++f) history.push(view_of(gray, depth, f / 30.0), Pose::Identity());
  ASSERT_EQ(history.size(), 3u);  // 0, 0.4, 0.8 s
  EXPECT_NEAR(history.back(1).timestamp_s, 0.8, 1e-9);
  EXPECT_NEAR(history.back(3).timestamp_s, 0.0, 1e-9);
  for (int f = 31; f <= 600; ++f) history.push(view_of(gray, depth, f / 30.0), Pose::Identity());
  EXPECT_EQ(history.size(), SpaceHistory::kViews);
  history.clear();
  EXPECT_EQ(history.size(), 0u);
}

// ---- Who came? ----

/// A wall at 3 m was seen from the origin each 0.4 s up to 4 s ago; now it is 4.4 s.
class SpaceSearchTest : public testing::Test {
 protected:
  SpaceSearchTest() {
    for (int k = 0; k < 10; ++k) history_.push(view_of(gray_, depth_, 0.4 * k), Pose::Identity());
  }

  /// Views that saw through a feature straight ahead at this depth, measured or guessed with this relative spread.
  int through(double depth_m, double spread = 0.01, const Pose& filter_from_current = Pose::Identity()) {
    Matches matches;
    const std::vector<Vector2f> pixels = {{160, 120}};
    matches.begin(pixels);
    matches.past_observations.add(1);
    matches.past_observations.point[0] = camera_.back_project({160, 120}, depth_m);
    matches.past_observations.inverse_depth_sigma[0] = spread / depth_m;
    search_.count_views_through(history_, kNow_s, filter_from_current, camera_, KinectNoise(), matches);
    return matches.past_observations.views_through[0];
  }

  /// Static prior of a surface cell at `depth_m` beside `others` cells on the wall, and how often it was there.
  SurfaceCell cell(double depth_m, int others) {
    Matches matches;
    matches.begin(std::vector<Vector2f>());
    add_cell(160, 120, depth_m, matches);
    for (int k = 0; k < others; ++k) add_cell(40 + 20 * k, 60, 3.0, matches);
    set_prior(matches);
    return matches.past_observations.surfaces[0];
  }

  void add_cell(int u, int v, double depth_m, Matches& matches) const {
    SurfaceCell cell;
    cell.pixel = Vector2f(static_cast<float>(u), static_cast<float>(v));
    cell.point = camera_.back_project(cell.pixel.cast<double>(), depth_m);
    matches.past_observations.surfaces.push_back(cell);
  }

  void set_prior(Matches& matches) {
    Workspace workspace;
    search_.set_static_prior(history_, now_s_, Pose::Identity(), camera_, KinectNoise(), kStep_px, matches, workspace);
  }

  static constexpr int kStep_px = 20;

  static constexpr double kNow_s = 4.4;
  double now_s_ = kNow_s;
  const cv::Mat gray_{kHeight, kWidth, CV_8UC1, cv::Scalar(50)};
  cv::Mat depth_{kHeight, kWidth, CV_32FC1, cv::Scalar(3.0)};
  Camera camera_{300, 300, 160, 120, kWidth, kHeight};
  SpaceHistory history_;
  SpaceSearch search_;
};

TEST_F(SpaceSearchTest, WhatStandsWhereViewsSawThroughIsCounted) {
  EXPECT_EQ(through(2.0), 10) << "all ten saw the wall behind it";
  EXPECT_EQ(through(3.0), 0) << "it is the wall";
  EXPECT_EQ(through(4.0), 0) << "the wall hid it";
  EXPECT_EQ(through(2.0, 0.1), 0) << "nobody measured where it is";
}

// The margin at 2.6 m: 0.08 + 0.05 t + 4 (σ(2.6) + σ(3)) with σ(z) = 0.0012 + 0.0019 (z − 0.4)²: 0.0104 + 0.0140, so
// 0.177 + 0.05 t: 0.4 m of distance is more for t ≤ 4.4 s, 0.25 m only for t < 1.45 s, the views of 0.8 and 1.2 s ago.
TEST_F(SpaceSearchTest, TheMarginGrowsWithTheTimeThatPosesAreChained) {
  EXPECT_EQ(through(2.6), 10);
  EXPECT_EQ(through(2.75), 2);
}

// A step of 0.5 m toward the wall: a feature 2.5 m ahead is on it.
TEST_F(SpaceSearchTest, TheMotionSinceIsTakenOut) {
  Pose filter_from_current = Pose::Identity();
  filter_from_current.translation().z() = 0.5;
  EXPECT_EQ(through(2.5, 0.01, filter_from_current), 0);
  EXPECT_EQ(through(1.5, 0.01, filter_from_current), 10);
}

TEST_F(SpaceSearchTest, ASurfaceThatCameHasLittleSay) {
  EXPECT_LT(cell(2.0, 9).space_static_prior, 0.1f);
  EXPECT_EQ(cell(2.0, 9).occupied_views, 0);
  EXPECT_EQ(cell(3.0, 9).space_static_prior, 1.0f);
  EXPECT_EQ(cell(3.0, 9).occupied_views, 6) << "views of 2.4 to 4.4 s ago";
}

// A crowd may fill the view: nothing of the room is left to see.
TEST_F(SpaceSearchTest, WhatFillsTheViewCameAllTheSame) { EXPECT_LT(cell(2.0, 0).space_static_prior, 0.1f); }

// The views saw nothing left of column 160. A body at 2 m spans the whole row at v = 100, but for a gap at u = 40; the
// wall is the row at v = 180, the steps between both are edges. Right of the middle the views saw through the body:
// cells of its other half adjoin those one after the other, 60 to 140, and so does a corner at u = 75, but not what
// lies left of the gap.
TEST_F(SpaceSearchTest, WhatNoViewKnowsBelongsToTheSurfaceBesideIt) {
  depth_(cv::Rect(0, 0, 160, kHeight)).setTo(0.0);
  history_.clear();
  for (int k = 0; k < 10; ++k) history_.push(view_of(gray_, depth_, 0.4 * k), Pose::Identity());
  Matches matches;
  matches.begin(std::vector<Vector2f>());
  for (int u = 10; u < kWidth; u += kStep_px)
    if (u / kStep_px != 2) add_cell(u, 110, 2.0, matches);
  const std::size_t body_count = matches.past_observations.surfaces.size();
  for (int v : {170, 190, 210, 230})
    for (int u = 10; u < kWidth; u += kStep_px) add_cell(u, v, 3.0, matches);
  matches.resize(1);  // a support corner
  matches.current.pixel[0] = Vector2f(75, 110);
  matches.current.depth_m[0] = 2.0;
  matches.current.point[0] = camera_.back_project({75, 110}, 2.0);
  set_prior(matches);
  for (std::size_t s = 0; s < matches.past_observations.surfaces.size(); ++s) {
    const SurfaceCell& cell = matches.past_observations.surfaces[s];
    if (s < body_count && cell.pixel.x() > 60)
      EXPECT_LT(cell.space_static_prior, 0.1f) << cell.pixel.transpose();
    else
      EXPECT_EQ(cell.space_static_prior, 1.0f) << cell.pixel.transpose();
  }
  EXPECT_LT(matches.space_static_prior[0], 0.1f);
}

// A body at 2 m spans the row at v = 110. Views of 2.8 s ago and older saw through its right half; its left half they
// saw not at all, or standing. Those of 2.4 s ago and newer saw all of it: longer than `kSettled_s`, but it may have
// come with the right half.
TEST_F(SpaceSearchTest, WhatWasFirstSeenAfterTheOthersCameMayHaveComeWithThem) {
  for (const bool left_stood_before : {false, true}) {
    history_.clear();
    for (int k = 0; k < 10; ++k) {
      cv::Mat depth = depth_.clone();
      const bool has_come = k >= 5;  // 2.0 s, of 4.4
      depth(cv::Rect(160, 95, 160, 30)).setTo(has_come ? 2.0 : 3.0);
      depth(cv::Rect(0, 95, 160, 30)).setTo(has_come || left_stood_before ? 2.0 : 0.0);
      history_.push(view_of(gray_, depth, 0.4 * k), Pose::Identity());
    }
    Matches matches;
    matches.begin(std::vector<Vector2f>());
    for (const int v : {110, 170, 190, 210, 230})
      for (int u = 10; u < kWidth; u += kStep_px) add_cell(u, v, v == 110 ? 2.0 : 3.0, matches);
    set_prior(matches);
    for (const SurfaceCell& cell : matches.past_observations.surfaces) {
      const bool came = cell.pixel.y() < 120 && (cell.pixel.x() > 160 || !left_stood_before);
      EXPECT_EQ(cell.space_static_prior < 1.0f, came) << left_stood_before << ": " << cell.pixel.transpose();
    }
  }
}

// A body 0.4 m before the wall adjoins it: 2.75 · 20 / 300 · 2.6 m = 0.48 m. The views are 0.4, 0.8 and 1.2 s old, none
// of them 2.2 s. Those of the earlier half know the wall, which stays static; the newest alone would not do.
TEST_F(SpaceSearchTest, AtTheBeginningTheOldestViewsTellTheRoomFromWhoCame) {
  for (const bool early_ones_saw_the_wall : {true, false}) {
    history_.clear();
    for (const double t : {0.0, 0.4, 0.8}) {
      cv::Mat depth = depth_.clone();
      if (t < 0.6 && !early_ones_saw_the_wall) depth(cv::Rect(0, 121, kWidth, kHeight - 121)).setTo(0.0);
      history_.push(view_of(gray_, depth, t), Pose::Identity());
    }
    now_s_ = 1.2;
    Matches matches;
    matches.begin(std::vector<Vector2f>());
    for (const int v : {110, 130, 150})
      for (int u = 10; u < kWidth; u += kStep_px) add_cell(u, v, v == 110 ? 2.6 : 3.0, matches);
    set_prior(matches);
    for (const SurfaceCell& cell : matches.past_observations.surfaces) {
      const bool is_static = cell.pixel.y() > 110 && early_ones_saw_the_wall;
      EXPECT_EQ(cell.space_static_prior >= 1.0f, is_static) << cell.pixel.transpose();
      EXPECT_EQ(cell.occupied_views, 0) << "no view is old enough to say so";
    }
  }
}

TEST_F(SpaceSearchTest, WithoutViewsOrDepthNothingIsSaid) {
  history_.clear();
  EXPECT_EQ(through(2.0), 0);
  depth_.setTo(0.0);
  history_.push(view_of(gray_, depth_, 0), Pose::Identity());
  EXPECT_EQ(through(2.0), 0);
  EXPECT_EQ(cell(2.0, 3).space_static_prior, 1.0f);
}

}  // namespace
}  // namespace stillpoint::space_search_test
