// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What the map calls dynamic goes back to the filter.

#include <gtest/gtest.h>
#include <stillpoint/compiled.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include "made_map.hpp"
#include "slam/dynamic_features.hpp"
#include "slam/slam.hpp"
#include "slam_run.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace slam_test {
namespace {

struct MockFeatures {
  std::vector<stillpoint::Vector2f> keypoints = {{1, 1}, {2, 2}, {3, 3}};
  void compact(stillpoint::span<const std::uint8_t>) { keypoints.resize(1); }
};

struct MockBackend {
  bool has_pose = true;
  std::vector<std::uint8_t> flags = {0, 1, 0};
  MockFeatures extract(const stillpoint::FrameView&) { return {}; }
  std::optional<Pose> track(const stillpoint::FrameView&, const MockFeatures&) {
    return has_pose ? std::optional<Pose>(Pose::Identity()) : std::nullopt;
  }
  stillpoint::span<const std::uint8_t> dynamic_features() const { return flags; }
};

struct MockResult {
  std::vector<std::uint8_t> flags = {1, 0, 0};
  stillpoint::span<const std::uint8_t> keep() const { return flags; }
};

struct MockFilter {
  std::vector<std::vector<std::uint8_t>> told;
  MockResult filter_frame(const stillpoint::FrameView&, const std::vector<stillpoint::Vector2f>&) { return {}; }
  void expect_dynamic(stillpoint::span<const std::uint8_t> flags) { told.emplace_back(flags.begin(), flags.end()); }
};

TEST(FilteredTracker, TellsTheFilterWhatTheMapCallsDynamic) {
  stillpoint::FilteredTracker tracker(MockFilter{}, MockBackend{});
  tracker.tells_filter = false;  // that is about poses
  tracker.track({});
  ASSERT_EQ(tracker.filter.told.size(), 1u);
  EXPECT_EQ(tracker.filter.told[0], (std::vector<std::uint8_t>{0, 1, 0})) << "one for each keypoint, dropped ones too";
  tracker.backend.has_pose = false;
  tracker.track({});
  EXPECT_EQ(tracker.filter.told.size(), 1u) << "without a pose the map says nothing";
}

/// A frame of the camera at 0.1 m that sees some points elsewhere.
slam::Frame frame_with_moved(const std::vector<Vector3d>& points, std::size_t moved, double by_m) {
  std::vector<Vector3d> now = points;
  for (std::size_t i = 0; i < moved; ++i) now[i].x() += by_m;
  return made_frame(now, camera_at(0.1));
}

/// Points in one corner of the image, 3 m away, and others all over it.
std::vector<Vector3d> box_and_room(int box = 9) {
  std::vector<Vector3d> points;
  for (int i = 0; i < box; ++i)
    points.push_back(camera().back_project({100 + 15.0 * (i % 3), 100 + 15.0 * (i / 3)}, 3));
  for (const Vector3d& point : made_points(40)) points.push_back(point);
  return points;
}

std::vector<std::uint8_t> found_dynamic(const slam::Map& map, const slam::Frame& frame) {
  const std::vector<slam::KeyframeId> all = {0, 1};
  return slam::DynamicFeatures(camera())(frame, map, map.points_of(all), slam::MeasurementNoise{});
}

TEST(DynamicFeatures, FindsWhatIsNotWhereTheMapHasIt) {
  const std::vector<Vector3d> points = box_and_room();
  const slam::Map map = made_map(points, 2);
  const auto found = found_dynamic(map, frame_with_moved(points, 9, 0.06));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(found[i], i < 9) << i;
}

TEST(DynamicFeatures, AFeatureDeviatesByMoreThanTheNoiseOfBoth) {
  const slam::Map map = made_map(made_points(1), 2);
  slam::Frame frame = made_frame(made_points(1), camera_at(0.1));
  const auto is_off = [&] { return slam::deviates(map.point(0), frame, 0, camera(), slam::MeasurementNoise{}); };
  EXPECT_FALSE(is_off());
  frame.pixel[0].x() += 10.0;
  EXPECT_TRUE(is_off());
  frame.pixel[0].x() -= 10.0;
  frame.depth_m[0] += 0.6;
  EXPECT_TRUE(is_off());
  frame.depth_m[0] = 0.0;
  EXPECT_FALSE(is_off()) << "no depth says nothing";
}

// The map's points have moved along: only where they were first seen tells.
TEST(DynamicFeatures, FindsWhatTookItsPointsAlong) {
  const std::vector<Vector3d> points = box_and_room();
  slam::Map map = made_map(points, 2);
  for (slam::PointId id = 0; id < 9; ++id) map.point(id).p_world.x() += 0.06;
  const auto found = found_dynamic(map, frame_with_moved(points, 9, 0.06));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(found[i], i < 9) << i;
}

TEST(DynamicFeatures, NothingIsDynamicInAStaticRoomNorByASingleMatch) {
  const std::vector<Vector3d> points = box_and_room(3);  // fewer than the votes that are needed
  const slam::Map map = made_map(points, 2);
  for (const std::size_t moved : {0u, 3u})
    for (const std::uint8_t flag : found_dynamic(map, frame_with_moved(points, moved, 0.06)))
      EXPECT_EQ(flag, 0) << moved;
}

TEST(Map, RemembersWherePointsWereFirstSeenWhenThatKeyframeGoes) {
  slam::Map map = made_map(made_points(5), 3, 0.1);
  const Vector3d p_world = map.point(2).p_world;
  map.remove_keyframe(0);
  const slam::FirstSeen& first = map.point(2).first;
  ASSERT_TRUE(map.has(first.keyframe));
  const Pose world_from_camera = map.keyframe(first.keyframe).camera_from_world.inverse();
  EXPECT_LT((world_from_camera * first.p_camera - p_world).norm(), 1e-9);
}

/// Share of a slow box's features that the filter drops in the last half second of five.
double dropped_share(bool uses_multi_view) {
  stillpoint::synthetic::SceneOptions ten_per_second;
  ten_per_second.frame_rate_hz = 10;
  ten_per_second.frames = 50;
  constexpr double kSpeed = 0.01, kSeconds = 5.0;
  stillpoint::synthetic::Scene scene = stillpoint::synthetic::static_room(ten_per_second);
  const auto path = stillpoint::synthetic::PathBuilder({0.3, 0, 2.0}, 0.3)
                        .slide_to({0.3 + kSpeed * kSeconds, 0, 2.0}, kSpeed)
                        .path(stillpoint::synthetic::Blend::linear);
  scene.movers.push_back(stillpoint::synthetic::printed_box(path, {0.30, 0.35, 0.22}, ten_per_second.seed + 20));
  stillpoint::SyntheticSequence sequence(scene);
  slam::SlamOptions options = slam_run::in_step();
  options.finds_dynamic = true;
  options.uses_multi_view = uses_multi_view;
  using Filter = stillpoint::FrameFilter<stillpoint::CompiledPolicies>;
  stillpoint::FilteredTracker tracker(Filter(sequence.camera()), slam::Slam(sequence.camera(), options));
  tracker.tells_filter = false;
  stillpoint::SyntheticFrame frame;
  double on_box = 0, dropped = 0;
  for (int i = 0; i < ten_per_second.frames; ++i) {
    sequence.render(i, frame);
    tracker.track(frame.view(), [&](const std::vector<cv::KeyPoint>& keypoints, const stillpoint::FrameResult& result) {
      if (i < ten_per_second.frames - 5) return;
      for (std::size_t k = 0; k < keypoints.size(); ++k) {
        const int u = cvRound(keypoints[k].pt.x), v = cvRound(keypoints[k].pt.y);
        const int label = frame.labels.view().row<std::uint8_t>(v)[u];
        constexpr int kBackground = 0, kIgnored = 64;
        if (label == kBackground || label == kIgnored) continue;
        ++on_box;
        dropped += result.keep()[k] == 0;
      }
    });
  }
  return dropped / on_box;
}

TEST(Slam, FindsABoxOfACentimetrePerSecond) {
  EXPECT_GT(dropped_share(true), 0.8) << "with multi-view geometry";
  EXPECT_LT(dropped_share(false), 0.1) << "without";
}

}  // namespace
}  // namespace slam_test
