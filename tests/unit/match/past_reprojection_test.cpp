// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/past_reprojection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <type_traits>
#include <vector>

#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/match/grid_corners.hpp"
#include "stillpoint/match/patch_matcher.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/observations_of.hpp"
#include "wave_texture.hpp"

namespace stillpoint {
namespace {

static_assert(is_matcher<PatchMatcher>::value && reprojects_into_past<PatchMatcher, Camera, KinectNoise>::value);

// ---- Which older frames? ----

/// Times of the older frames that are looked at for features at `depth_m`. A camera of 210 px: 0.7 px are
/// 0.7 depth / 210 across, three of them at 0.1 m/s take 0.1 depth seconds.
std::vector<double> ages(double rate_hz, int frames, double depth_m, double longest_s = 0.5) {
  PastReprojection reproject_into_past;
  reproject_into_past.options.slowest_m_s = 0.1;
  reproject_into_past.options.pixel_sigma = 0.7;
  reproject_into_past.options.longest_s = longest_s;
  const Camera camera(210, 210, 31.5, 23.5, 64, 48);
  const cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(50)), depth(48, 64, CV_32FC1, cv::Scalar(depth_m));
  FrameHistory history(16);
  for (int f = 0; f < frames; ++f) history.push(FrameView(gray, DepthView::tum(depth), f / rate_hz), Pose::Identity());
  const FrameView current(gray, DepthView::tum(depth), frames / rate_hz);
  Matches matches;
  matches.begin(std::vector<Vector2f>{{30, 20}});
  lift(current, GuardedDepth(), camera, KinectNoise(), matches.current);
  Workspace workspace;
  reproject_into_past.choose_keyframes(history, current, Pose::Identity(), camera, KinectNoise(), matches, workspace);
  std::vector<double> elapsed_s;
  for (const OlderFrame& frame : matches.past_observations.frames()) elapsed_s.push_back(frame.elapsed_s);
  return elapsed_s;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

// At 1.9 m 0.19 s are wanted: one frame of 5 Hz, but three are looked at within a second; six of 30 Hz (0.2 s; five are
// 0.167). Between: √6 = 2.4. Of 60 Hz every second frame before the last is kept, of 90 Hz every third: the seventh of
// those kept is 0.2 s old, and the one between is the third: √7 = 2.6.
TEST(PastReprojection, AgesFollowTheFrameRate) {
  expect_near(ages(5, 16, 1.9), {1 / 5.0, 2 / 5.0, 3 / 5.0});
  expect_near(ages(30, 16, 1.9), {1 / 30.0, 2 / 30.0, 6 / 30.0});
  expect_near(ages(60, 16, 1.9), {1 / 60.0, 4 / 60.0, 12 / 60.0});
  expect_near(ages(90, 45, 1.9), {1 / 90.0, 6 / 90.0, 18 / 90.0});
}

// 0.09 s at 0.9 m: three frames of 30 Hz; at 3.8 m 0.38 s: twelve.
TEST(PastReprojection, AgesFollowTheDepth) {
  expect_near(ages(30, 16, 0.9), {1 / 30.0, 2 / 30.0, 3 / 30.0});
  expect_near(ages(30, 16, 3.8), {1 / 30.0, 3 / 30.0, 12 / 30.0});
}

TEST(PastReprojection, AgesEndWithTheHistoryAndTheLongestTime) {
  expect_near(ages(30, 4, 3.8), {1 / 30.0, 2 / 30.0, 4 / 30.0});
  expect_near(ages(30, 1, 3.8), {1 / 30.0});
  expect_near(ages(30, 16, 3.8, 0.15), {1 / 30.0, 2 / 30.0, 5 / 30.0});
  expect_near(ages(30, 16, 0.0), {1 / 30.0, 2 / 30.0, 3 / 30.0});  // no depth at all: the last three
}

// ---- What is seen there? ----

/// A wall of waves at 2 m (or nearer) in both frames; the camera stands.
class PastReprojectionTest : public testing::Test {
 protected:
  PastReprojectionTest() { past_reprojection_.options.occlusion_sigmas = 4.0; }

  Observation look(const Vector2f& pixel) { return look_for({pixel})[0]; }

  /// What the older frame shows of each.
  std::vector<Observation> look_for(const std::vector<Vector2f>& pixels) {
    FrameHistory history(4);
    history.push(FrameView(older_gray_, DepthView::tum(older_depth_), 1.0), Pose::Identity());
    const FrameView current(gray_, DepthView::tum(depth_), 1.1);
    matches_.begin(pixels);
    lift(current, GuardedDepth(), camera_, noise_, matches_.current);
    past_reprojection_.choose_keyframes(history, current, filter_from_current_, camera_, noise_, matches_, workspace_);
    Observations observations = test::observations_of(matches_);
    past_reprojection_.reproject_into_past(history, current, filter_from_current_, camera_, noise_, observations);
    matches_ = observations.matches;
    EXPECT_EQ(matches_.past_observations.frames().size(), 1u);
    return matches_.past_observations.frames()[0].of_feature;
  }

  static cv::Mat wall(double depth_m) { return cv::Mat(120, 160, CV_32FC1, cv::Scalar(depth_m)); }

  Camera camera_{200, 200, 79.5, 59.5, 160, 120};
  KinectNoise noise_;
  test::WaveTexture texture_{11};
  cv::Mat gray_ = texture_.shifted(160, 120, {0, 0}), older_gray_ = gray_.clone();
  cv::Mat depth_ = wall(2.0), older_depth_ = wall(2.0);
  Pose filter_from_current_ = Pose::Identity();
  PastReprojection past_reprojection_;
  Matches matches_;
  Workspace workspace_;
};

TEST_F(PastReprojectionTest, AStandingPointIsSeenInItsPlace) {
  const Observation observation = look({80, 60});
  EXPECT_EQ(observation.state, ObservationState::seen);
  EXPECT_LT((observation.found - Vector2f(80, 60)).norm(), 0.05f);
  EXPECT_LT(observation.dissimilarity, 0.01f);
  EXPECT_EQ(observation.depth_m, 2.0f);
  EXPECT_FLOAT_EQ(observation.depth_sigma_m, static_cast<float>(noise_.sigma(2.0)));
}

// The camera went 0.02 m to the right since: what is at u now was 200 · 0.02 / 2 = 2 px further right.
TEST_F(PastReprojectionTest, TheKnownMotionIsTakenOut) {
  older_gray_ = texture_.shifted(160, 120, {2, 0});
  filter_from_current_.translation().x() = 0.02;
  const Observation observation = look({80, 60});
  EXPECT_EQ(observation.state, ObservationState::seen);
  EXPECT_LT((observation.found - Vector2f(82, 60)).norm(), 0.05f);
  EXPECT_LT(observation.dissimilarity, 0.01f);
}

// A wall that is farther by 1 mm in each column. The second keypoint has another whole pixel, and would be compared by
// another patch.
TEST_F(PastReprojectionTest, WhatLiesOnAFeatureIsFoundBesideIt) {
  for (int u = 0; u < 160; ++u) depth_.col(u).setTo(2.0 + 0.001 * u);
  older_depth_ = depth_.clone();
  older_gray_ = texture_.shifted(160, 120, {-0.5, 0.25});
  const std::vector<Observation> observation = look_for({{80, 60}, {80.75f, 60.5f}, {84, 60}});
  EXPECT_EQ(observation[1].dissimilarity, observation[0].dissimilarity);
  EXPECT_NE(observation[2].dissimilarity, observation[0].dissimilarity) << "else the test asks nothing";
  EXPECT_LT((observation[1].found - observation[0].found - Vector2f(0.75f, 0.5f)).norm(), 1e-5f);
  EXPECT_NEAR(observation[1].depth_m - observation[0].depth_m, 0.001, 1e-6);
  EXPECT_EQ(matches_.past_observations.point[1], matches_.current.point[1]);
}

TEST_F(PastReprojectionTest, WhatMovedIsFoundBesideItsPlaceOrLooksDifferent) {
  older_gray_ = texture_.shifted(160, 120, {-1.5, 0.5});
  const Observation beside = look({80, 60});
  EXPECT_LT((beside.found - Vector2f(78.5f, 60.5f)).norm(), 0.15f);
  EXPECT_LT(beside.dissimilarity, 0.05f);
  Random random(1);
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) older_gray_.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random.index(256));
  EXPECT_GT(look({80, 60}).dissimilarity, 0.4f);
}

TEST_F(PastReprojectionTest, FreeSpaceIsSeenAndOcclusionSaysNothing) {
  older_depth_ = wall(3.0);
  EXPECT_EQ(look({80, 60}).state, ObservationState::seen) << "an older frame looked through to something behind";
  EXPECT_EQ(look({80, 60}).depth_m, 3.0f);
  older_depth_ = wall(1.5);
  const Observation hidden = look({80, 60});
  EXPECT_EQ(hidden.state, ObservationState::occluded);
  EXPECT_TRUE(std::isnan(hidden.dissimilarity)) << "the patch in front is another's";
  // The margin at 2 m: 0.15 + 4 · √2 · σ with σ = 0.0012 + 0.0019 · 1.6² = 0.006064, 0.184 m in all.
  older_depth_ = wall(1.83);
  EXPECT_EQ(look({80, 60}).state, ObservationState::seen);
  older_depth_ = wall(1.80);
  EXPECT_EQ(look({80, 60}).state, ObservationState::occluded);
}

// At 2 m something nearer by 0.02 + 4 · √(0.006064² + σ²) hides what the last frame shows, 0.053 m; σ is 0.0057 at 1.94
// m. The oldest frame has another texture. What the last frame shows elsewhere moves.
TEST_F(PastReprojectionTest, WhatWasUncoveredSinceWasHiddenBefore) {
  cv::Mat unlike(120, 160, CV_8UC1);
  Random random(1);
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) unlike.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random.index(256));
  const auto oldest = [&](double depth_there_m, const Vector2d& moved_px) {
    const cv::Mat there = wall(depth_there_m), last = texture_.shifted(160, 120, moved_px);
    FrameHistory history(4);
    history.push(FrameView(unlike, DepthView::tum(there), 0.9), Pose::Identity());
    history.push(FrameView(last, DepthView::tum(depth_), 1.0), Pose::Identity());
    matches_.begin(std::vector<Vector2f>{{80, 60}});
    const FrameView current(gray_, DepthView::tum(depth_), 1.1);
    lift(current, GuardedDepth(), camera_, noise_, matches_.current);
    past_reprojection_.choose_keyframes(history, current, Pose::Identity(), camera_, noise_, matches_, workspace_);
    Observations observations = test::observations_of(matches_);
    past_reprojection_.reproject_into_past(history, current, Pose::Identity(), camera_, noise_, observations);
    return observations.matches.past_observations.frames()[1].of_feature[0].state;
  };
  EXPECT_EQ(oldest(1.94, {0, 0}), ObservationState::occluded);
  EXPECT_EQ(oldest(1.95, {0, 0}), ObservationState::seen) << "no more than noise";
  EXPECT_EQ(oldest(2.06, {0, 0}), ObservationState::seen) << "what is farther hides nothing";
  EXPECT_EQ(oldest(1.94, {1.5, 0}), ObservationState::seen) << "it moves";
}

// A person stood at 70 px and less in the older frame: 3 px of reach (8 px of a camera of 525 px) from
// 72, not from 74, and the depth in the place
// of the point itself says as much as ever.
TEST_F(PastReprojectionTest, APatchThatWasPartlyCoveredIsNotCompared) {
  older_depth_.colRange(0, 70).setTo(1.0);
  const Observation covered = look({72, 60});
  EXPECT_EQ(covered.state, ObservationState::seen);
  EXPECT_TRUE(std::isnan(covered.dissimilarity));
  EXPECT_EQ(covered.depth_m, 2.0f);
  EXPECT_LT(look({74, 60}).dissimilarity, 0.01f);
  older_depth_.colRange(0, 70).setTo(1.9);
  EXPECT_LT(look({72, 60}).dissimilarity, 0.01f) << "0.1 m nearer is no other surface";
}

// The camera went 0.04 m to the right: a point at 2 m was 4 px, one at 1 m 8 px further right. The feature has no depth
// and both surfaces beside it; it is found on the one that the older image agrees with.
TEST_F(PastReprojectionTest, AFeatureWithoutADepthLiesOnASurfaceBesideIt) {
  depth_.colRange(68, 82).setTo(0.0);  // 9 px are looked at: 24 px of a camera of 525 px
  depth_.colRange(82, 160).setTo(1.0);
  filter_from_current_.translation().x() = 0.04;
  older_depth_ = wall(0.0);
  for (const double depth_m : {1.0, 2.0}) {
    const auto shift = static_cast<float>(8.0 / depth_m);
    older_gray_ = texture_.shifted(160, 120, {shift, 0});
    const Observation observation = look({75, 60});
    EXPECT_EQ(observation.state, ObservationState::seen);
    EXPECT_EQ(matches_.past_observations.point[0].z(), depth_m);
    EXPECT_LT((observation.found - Vector2f(75 + shift, 60)).norm(), 0.1f);
    EXPECT_EQ(observation.depth_m, 0.0f) << "a supposed depth agrees with nothing";
  }
}

// A hole in a wall at 2 m, of which the older frame knows nothing. The look there confirms that the wall goes on, or
// not.
TEST_F(PastReprojectionTest, ASupposedDepthThatLooksChangedIsAGuess) {
  depth_.colRange(72, 79).setTo(0.0);
  older_depth_ = wall(0.0);
  look({75, 60});
  EXPECT_FALSE(matches_.past_observations.is_guess(0)) << "one surface all around, and it looks the same";
  older_gray_ = 255 - gray_;
  EXPECT_GT(look({75, 60}).dissimilarity, 0.3f);
  EXPECT_TRUE(matches_.past_observations.is_guess(0));
}

// The same hole, and somebody at 1.5 m stood before it. On him it looks changed; on the wall it was hidden: nobody
// knows.
TEST_F(PastReprojectionTest, WhatWasHiddenLiesOnNoKnownSurface) {
  depth_.colRange(72, 79).setTo(0.0);
  older_depth_ = wall(1.5);
  EXPECT_EQ(look({75, 60}).state, ObservationState::seen);
  EXPECT_NEAR(matches_.past_observations.point[0].z(), 1.5, 1e-6) << "it looks as if it lay where the older depth is";
  older_gray_ = 255 - gray_;
  EXPECT_EQ(look({75, 60}).state, ObservationState::none);
  EXPECT_TRUE(std::isnan(matches_.past_observations.point[0].z()));
}

// Two pillars at 0.8 m before a wall at 2 m, each with a shadow of 200 · 0.05 · (1 / 0.8 − 1 / 2) = 7.5 px of the wall
// on its left, in all 15 rows that are measured. What looks changed in a shadow lies on the wall, and nothing more is
// known; what looks the same was seen in its place as ever, and a hole of another width may lie on either surface.
TEST_F(PastReprojectionTest, InAShadowOfTheSensorAFeatureLiesOnTheFartherSurface) {
  for (const int pillar : {80, 130}) {
    depth_.colRange(pillar, pillar + 20).setTo(0.8);
    depth_.colRange(pillar - 8, pillar).setTo(0.0);
  }
  older_depth_ = wall(0.0);
  EXPECT_EQ(look({75, 60}).state, ObservationState::seen);
  older_gray_ = 255 - gray_;
  EXPECT_EQ(look({75, 60}).state, ObservationState::none);
  EXPECT_EQ(matches_.past_observations.point[0].z(), 2.0);
  EXPECT_FALSE(matches_.past_observations.is_guess(0));
  depth_.colRange(70, 80).setTo(0.0);
  depth_.colRange(115, 130).setTo(0.0);
  EXPECT_EQ(look({75, 60}).state, ObservationState::seen);
  EXPECT_TRUE(matches_.past_observations.is_guess(0));
}

TEST_F(PastReprojectionTest, WithoutAnOlderDepthThePatchIsComparedAllTheSame) {
  older_depth_ = wall(0.0);
  const Observation observation = look({80, 60});
  EXPECT_EQ(observation.state, ObservationState::seen);
  EXPECT_EQ(observation.depth_m, 0.0f);
  EXPECT_LT(observation.dissimilarity, 0.01f);
  older_depth_ = cv::Mat();
  EXPECT_EQ(look({80, 60}).state, ObservationState::seen);
}

TEST_F(PastReprojectionTest, WithoutADepthOrOutOfViewNothingIsLookedFor) {
  EXPECT_EQ(look({-5, 60}).state, ObservationState::none);
  EXPECT_EQ(look({std::numeric_limits<float>::quiet_NaN(), 60}).state, ObservationState::none);
  filter_from_current_.translation().x() = 1.0;  // 100 px to the right in the older frame
  EXPECT_EQ(look({100, 60}).state, ObservationState::none);
  filter_from_current_.translation().x() = 0.0;
  filter_from_current_.translation().z() = -3.0;  // behind the older camera
  EXPECT_EQ(look({80, 60}).state, ObservationState::none);
  depth_ = wall(0.0);
  filter_from_current_.setIdentity();
  EXPECT_EQ(look({80, 60}).state, ObservationState::none);
}

TEST_F(PastReprojectionTest, SurfaceCellsLieOnSmoothDepthOnly) {
  past_reprojection_.surfaces.step_px = 42;  // 16 px of this camera
  look({80, 60});
  const std::vector<SurfaceCell>& cells = matches_.past_observations.surfaces;
  EXPECT_EQ(cells.size(), 10u * 7u) << "the cells' centres are 8, 24, …, 152 and 8, …, 104: seven rows lie inside";
  for (const SurfaceCell& cell : cells) {
    EXPECT_NEAR(std::abs(cell.normal.z()), 1.0, 1e-6) << "a wall that faces the camera";
    EXPECT_NEAR(cell.point.z(), 2.0, 1e-6);
  }
  for (const SurfaceObservation& observation : matches_.past_observations.frames()[0].of_surface) {
    EXPECT_GT(observation.depth_sigma_m, 0.0);
    EXPECT_NEAR(observation.target.z(), 2.0, 1e-6);
  }
  depth_.colRange(80, 160).setTo(1.0);
  look({40, 60});
  for (const SurfaceCell& cell : matches_.past_observations.surfaces) EXPECT_GT(std::abs(cell.pixel.x() - 79.5f), 5.0f);
  depth_ = wall(0.0);
  look({80, 60});
  EXPECT_TRUE(matches_.past_observations.surfaces.empty());
}

// ---- In a rendered room ----

/// Corners of a scene's frame `now`, looked for in the frames before with the true poses.
struct Rendered {
  synthetic::Scene scene;
  SyntheticFrame frame;
  Matches matches;

  Rendered(synthetic::Scene s, int now, int history_length) : scene(std::move(s)) {
    SyntheticSequence sequence(scene);
    FrameHistory history(16);
    for (int f = now - history_length; f < now; ++f) {
      sequence.render(f, frame);
      history.push(frame.view(), frame.world_from_camera);
    }
    sequence.render(now, frame);
    std::vector<Vector2f> corners;
    Workspace workspace;
    grid_corners(frame.gray.view(), 10, 3000.0f, corners, workspace);
    matches.begin(corners);
    const KinectNoise noise;
    lift(frame.view(), GuardedDepth(), scene.camera, noise, matches.current);
    PastReprojection reproject_into_past;
    reproject_into_past.options.slowest_m_s = 0.01;
    reproject_into_past.options.longest_s = 0.16;
    reproject_into_past.choose_keyframes(history, frame.view(), frame.world_from_camera, scene.camera, noise, matches,
                                         workspace);
    Observations observations = test::observations_of(matches);
    reproject_into_past.reproject_into_past(history, frame.view(), frame.world_from_camera, scene.camera, noise,
                                            observations);
    matches = observations.matches;
  }

  int label(std::size_t i) const {
    const Vector2f pixel = matches.current.pixel[i];
    return frame.labels.view().row<std::uint8_t>(static_cast<int>(pixel.y()))[static_cast<int>(pixel.x())];
  }
};

synthetic::SceneOptions small(std::uint64_t seed = 1) {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.seed = seed;
  return options;
}

TEST(PastReprojectionInARoom, StandingPointsAreFoundWhereTheTrueMotionPutsThem) {
  const Rendered room(synthetic::static_room(small()), 40, 6);
  ASSERT_EQ(room.matches.past_observations.frames().size(), 3u);
  std::size_t features = 0, in_place = 0, alike = 0, with_depth = 0, depth_agrees = 0;
  for (const OlderFrame& frame : room.matches.past_observations.frames()) {
    for (std::size_t i = 0; i < room.matches.size(); ++i) {
      const Observation& observation = frame.of_feature[i];
      if (observation.state != ObservationState::seen) continue;
      const Vector3d there = frame.reference_from_current * room.matches.current.point[i];
      if (!std::isnan(observation.dissimilarity)) {
        ++features;
        alike += observation.dissimilarity < 0.3f;
        in_place += (observation.found.cast<double>() - room.scene.camera.project(there)).norm() < 0.5;
      }
      if (!(observation.depth_m > 0)) continue;
      ++with_depth;
      const double sigma =
          std::hypot(static_cast<double>(observation.depth_sigma_m), room.matches.current.depth_sigma_m[i]);
      depth_agrees += std::abs(static_cast<double>(observation.depth_m) - there.z()) < 4 * sigma + 0.005;
    }
  }
  ASSERT_GT(features, 500u);
  EXPECT_GE(alike, features * 9 / 10);
  EXPECT_GE(in_place, features * 9 / 10) << in_place << " of " << features;
  EXPECT_GE(depth_agrees, with_depth * 95 / 100) << depth_agrees << " of " << with_depth;
}

TEST(PastReprojectionInARoom, WhatMovesIsElsewhereOrLooksDifferent) {
  // The box slides at 0.45 m/s from 0.4 s on.
  const Rendered room(synthetic::pushed_box(small()), 30, 6);
  std::size_t moving = 0, moving_objects = 0, standing = 0, standing_objects = 0;
  const OlderFrame& oldest = room.matches.past_observations.frames()[2];
  for (std::size_t i = 0; i < room.matches.size(); ++i) {
    const Observation& observation = oldest.of_feature[i];
    if (observation.state != ObservationState::seen || std::isnan(observation.dissimilarity)) continue;
    const Vector3d there = oldest.reference_from_current * room.matches.current.point[i];
    const bool objects = (observation.found.cast<double>() - room.scene.camera.project(there)).norm() > 1.0 ||
                         observation.dissimilarity > 0.4f ||
                         std::abs(static_cast<double>(observation.depth_m) - there.z()) > 0.1;
    if (room.label(i) == synthetic::kMoving) {
      ++moving;
      moving_objects += objects;
    } else if (room.label(i) == synthetic::kStatic) {
      ++standing;
      standing_objects += objects;
    }
  }
  ASSERT_GT(moving, 15u);
  EXPECT_GE(moving_objects, moving * 9 / 10) << moving_objects << " of " << moving;
  EXPECT_LE(standing_objects, standing / 10) << standing_objects << " of " << standing;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::is_same_v<LookBack, PastReprojection>, "the name of 0.1");
static_assert(std::is_same_v<Sighting, Observation> && std::is_same_v<SightingState, ObservationState> &&
                  std::is_same_v<SurfaceSighting, SurfaceObservation> && std::is_same_v<Sightings, PastObservations>,
              "names of 0.1");
#pragma GCC diagnostic pop

}  // namespace
}  // namespace stillpoint
