// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "slam/map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "made_map.hpp"
#include "slam/mapping.hpp"
#include "slam/path.hpp"
#include "slam/point_search.hpp"

namespace slam_test {
namespace {

/// Points and keyframes name each other.
void expect_consistent(const slam::Map& map) {
  for (slam::PointId id = 0; id < map.point_ids(); ++id) {
    if (!map.has_point(id)) continue;
    EXPECT_FALSE(map.point(id).observations.empty()) << id;
    for (const slam::Observation& seen : map.point(id).observations)
      EXPECT_EQ(map.keyframe(seen.keyframe).point[static_cast<std::size_t>(seen.feature)], id);
  }
  for (const auto& [id, keyframe] : map.keyframes())
    for (std::size_t i = 0; i < keyframe.size(); ++i) {
      if (keyframe.point[i] == slam::kNone) continue;
      ASSERT_TRUE(map.has_point(keyframe.point[i]));
      EXPECT_EQ(map.point(keyframe.point[i]).observation_in(id), static_cast<int>(i));
    }
}

TEST(Map, BothSidesAgreeWhateverIsRemoved) {
  slam::Map map = made_map(made_points(40), 4);
  expect_consistent(map);
  EXPECT_EQ(map.point_count(), 40u);
  map.remove(3);
  map.remove_observation(5, 2);
  map.merge(7, 8);  // all keyframes see both: the second keeps its own features
  map.remove_keyframe(1);
  expect_consistent(map);
  EXPECT_EQ(map.point_count(), 38u);
  EXPECT_FALSE(map.has_point(3));
  EXPECT_FALSE(map.has_point(7));
  EXPECT_EQ(map.point(8).observations.size(), 3u);
}

TEST(Map, APointThatNobodySeesIsGoneAndItsIdIsUsedAgain) {
  slam::Map map = made_map(made_points(2), 2);
  map.remove_observation(0, 0);
  EXPECT_TRUE(map.has_point(0));
  map.remove_observation(0, 1);
  EXPECT_FALSE(map.has_point(0));
  EXPECT_EQ(map.add_point(1, 0, Vector3d(0, 0, 1), Vector3d::Zero()), 0);
  EXPECT_EQ(map.point_ids(), 2);
}

TEST(Map, CovisibleKeyframesComeByThePointsTheyShare) {
  slam::Map map = made_map(made_points(10), 3);
  for (slam::PointId id = 0; id < 4; ++id) map.remove_observation(id, 1);
  const auto covisible = map.covisible(2, 1);
  ASSERT_EQ(covisible.size(), 2u);
  EXPECT_EQ(covisible[0], (std::pair<slam::KeyframeId, int>(0, 10)));
  EXPECT_EQ(covisible[1], (std::pair<slam::KeyframeId, int>(1, 6)));
  EXPECT_EQ(map.covisible(2, 7).size(), 1u);
}

TEST(Path, GoesWithItsKeyframes) {
  slam::Map map = made_map(made_points(30), 3, 0.1);
  slam::Path path;
  path.add(1.0, 1, Pose::Identity());
  Pose& one = map.keyframe(1).camera_from_world;
  one.translation().y() -= 0.5;
  EXPECT_NEAR(path.trajectory(map)[0].world_from_camera.translation().y(), 0.5, 1e-12);
  // A keyframe that is gone hands its frames to another, where they stay.
  const slam::CulledKeyframe culled{1, 2, one * map.keyframe(2).camera_from_world.inverse()};
  map.remove_keyframe(1);
  path.replace(culled);
  EXPECT_NEAR((path.trajectory(map)[0].world_from_camera.translation() - Vector3d(0.1, 0.5, 0)).norm(), 0, 1e-12);
}

TEST(Mapping, KeyframesThatOthersMakeNeedlessGo) {
  slam::Map map = made_map(made_points(60), 8);
  const slam::Mapping mapping(camera(), slam::MeasurementNoise{});
  const slam::KeyframeId in_use = 2;
  const auto culled = mapping.cull_keyframes(7, in_use, map);
  ASSERT_FALSE(culled.empty());
  expect_consistent(map);
  EXPECT_TRUE(map.has(0)) << "where the world is";
  EXPECT_TRUE(map.has(in_use));
  for (const slam::KeyframeId latest : {5, 6, 7}) EXPECT_TRUE(map.has(latest));
  for (const slam::CulledKeyframe& gone : culled) {
    EXPECT_FALSE(map.has(gone.id));
    const double apart_m = 0.05 * (gone.kept - gone.id);
    EXPECT_NEAR(gone.culled_from_kept.translation().x(), apart_m, 1e-12);
  }
}

TEST(Mapping, PointsThatAreNotFoundAgainGo) {
  slam::Map map = made_map(made_points(20), 2);
  map.point(4).visible = 100;
  const slam::Mapping mapping(camera(), slam::MeasurementNoise{});
  mapping.cull_points(1, map);
  EXPECT_FALSE(map.has_point(4));
  EXPECT_EQ(map.point_count(), 19u);
}

TEST(Mapping, PointsSeenOnceAreOnTrial) {
  slam::Map map = made_map(made_points(20), 2);
  map.remove_observation(4, 1);
  const slam::Mapping mapping(camera(), slam::MeasurementNoise{});
  mapping.cull_points(2, map);
  EXPECT_TRUE(map.has_point(4));
  mapping.cull_points(3, map);
  EXPECT_FALSE(map.has_point(4));
  expect_consistent(map);
}

// Eight features of weight 0.3 show points, two that stand for sure show none: by squares
// 8 · 0.09 / (8 · 0.09 + 2) = 0.72 / 2.72, where their number would say 0.8.
TEST(Frame, WhatTheMapExplainsIsCountedBySquaredWeight) {
  slam::Frame frame = made_frame(made_points(10), camera_at(0));
  frame.features.weights.assign(std::vector<float>{0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 1.0F, 1.0F});
  for (std::size_t i = 0; i < 8; ++i) frame.point[i] = static_cast<slam::PointId>(i);
  EXPECT_NEAR(slam::explained_share(frame), 0.72 / 2.72, 1e-7) << "before anything deviates";
  frame.deviates.assign(10, 0);
  EXPECT_NEAR(slam::explained_share(frame), 0.72 / 2.72, 1e-7);
  frame.depth_m[8] = 0.0;
  EXPECT_NEAR(slam::explained_share(frame), 0.72 / 1.72, 1e-7) << "without depth it makes no point";
  frame.deviates[9] = 1;
  EXPECT_NEAR(slam::explained_share(frame), 1.0, 1e-7) << "what deviates is not to be explained";
  frame.depth_m.assign(10, 0.0);
  EXPECT_EQ(slam::explained_share(frame), 1.0);
}

// A point that one feature has placed is as wrong as that feature: with the noise of both an offset of three pixel
// sigmas is 4.5 in chi-squared, with that of one it is 9 and beyond the limit of 7.8.
TEST(Mapping, APointSeenOnceIsAsWrongAsAFeature) {
  const std::vector<Vector3d> points = made_points(60);
  const slam::MeasurementNoise noise;
  slam::Map map = made_map(points, 1);
  slam::Frame frame = made_frame(points, camera_at(0.05));
  EXPECT_DOUBLE_EQ(noise.pixel_to_point(frame, 0, 1), std::sqrt(2.0) * noise.pixel(frame, 0));
  EXPECT_NEAR(noise.pixel_to_point(frame, 0, 1000), noise.pixel(frame, 0), 1e-3 * noise.pixel(frame, 0));
  for (std::size_t i = 0; i < 20; ++i) frame.point[i] = static_cast<slam::PointId>(i);  // by which it is covisible
  for (Vector2d& pixel : frame.pixel) pixel.x() += 3 * noise.pixel_sigma;
  const slam::KeyframeId id = map.add(frame);
  slam::Mapping(camera(), noise).connect(id, map);
  int named = 0;
  for (std::size_t i = 20; i < points.size(); ++i) named += map.keyframe(id).point[i] == static_cast<slam::PointId>(i);
  EXPECT_GT(named, 35) << "two that fall together may hide each other";
}

// Blur changes 80 of 256 bits; two different corners differ in 128 on average.
TEST(PointSearch, FindsCornersThatBlurHasChanged) {
  const std::vector<Vector3d> points = made_points(60);
  slam::Map map = made_map(points, 2);
  slam::Frame blurred = made_frame(points, camera_at(0.05));
  for (int row = 0; row < blurred.features.descriptors.rows; ++row)
    for (int byte = 0; byte < 10; ++byte) blurred.features.descriptors.at<std::uint8_t>(row, byte) ^= 0xFF;
  const std::vector<slam::KeyframeId> both = {0, 1};
  std::vector<slam::PointMatch> matches;
  slam::PointSearch{}(map, map.points_of(both), camera(), camera_at(0.05), blurred, matches);
  EXPECT_GT(matches.size(), 50u) << "two that fall together may hide each other";
  for (const slam::PointMatch& match : matches) EXPECT_EQ(match.point, match.feature);
}

// The filter gives much that stands still a low weight: where objects leave little else, nothing but that can carry the
// map on.
TEST(Mapping, WhatHasLittleWeightMakesPoints) {
  slam::Map map;
  slam::Frame frame = made_frame(made_points(10), camera_at(0));
  frame.features.weights.assign(std::vector<float>(10, 0.2F));
  frame.deviates = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  slam::Mapping(camera(), slam::MeasurementNoise{}).insert(frame, map);
  EXPECT_EQ(map.point_count(), 9u) << "all but what deviates from the map";
}

// A new keyframe names no point, and has no depth: what it shows is known by where the points must be.
TEST(Mapping, AKeyframeIsConnectedToThePointsThatItShows) {
  const std::vector<Vector3d> points = made_points(60);
  slam::Map map = made_map(points, 2);
  slam::Frame frame = made_frame(points, camera_at(0.1));
  for (slam::PointId id = 0; id < 20; ++id) frame.point[static_cast<std::size_t>(id)] = id;  // by which it is covisible
  const slam::Mapping mapping(camera(), slam::MeasurementNoise{});
  const slam::KeyframeId id = map.add(frame);
  mapping.connect(id, map);
  expect_consistent(map);
  int named = 0;
  for (std::size_t i = 0; i < points.size(); ++i) named += map.keyframe(id).point[i] == static_cast<slam::PointId>(i);
  EXPECT_GT(named, 55) << "two that fall together may hide each other";
  EXPECT_EQ(map.point_count(), 60u);
}

TEST(Mapping, TwoViewsMakePointsWhereDepthIsMissing) {
  const std::vector<Vector3d> points = made_points(60);
  slam::Map map = made_map(points, 1);
  for (slam::PointId id = 40; id < 60; ++id) {
    map.remove(id);
    map.keyframe(0).depth_m[static_cast<std::size_t>(id)] = 0;
  }
  slam::Frame frame = made_frame(points, camera_at(0.2));
  for (slam::PointId id = 0; id < 40; ++id) frame.point[static_cast<std::size_t>(id)] = id;
  for (std::size_t i = 40; i < 60; ++i) frame.depth_m[i] = 0;
  const slam::KeyframeId id = map.add(frame);
  slam::Mapping(camera(), slam::MeasurementNoise{}).connect(id, map);
  expect_consistent(map);
  EXPECT_GT(map.point_count(), 55u);
  for (std::size_t i = 40; i < 60; ++i) {
    const slam::PointId made = map.keyframe(id).point[i];
    if (made == slam::kNone) continue;
    EXPECT_LT((map.point(made).p_world - points[i]).norm(), 1e-6);
    EXPECT_EQ(map.keyframe(0).point[i], made);
  }
}

}  // namespace
}  // namespace slam_test
