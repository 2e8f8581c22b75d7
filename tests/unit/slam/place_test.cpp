// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Whether a place is known again: by its features, by its objects, and in space.

#include <gtest/gtest.h>

#include <cmath>

#include "made_map.hpp"
#include "slam/feature_grid.hpp"
#include "slam/loop_closing.hpp"
#include "slam/place_index.hpp"
#include "slam/place_pose.hpp"
#include "slam/semantic_cue.hpp"

namespace slam_test {
namespace {

/// A keyframe of features of its own, all of which show a point.
slam::Keyframe made_place(slam::KeyframeId id) {
  slam::Keyframe keyframe;
  static_cast<slam::Frame&>(keyframe) =
      made_frame(made_points(100, 5), camera_at(0), 100 + static_cast<std::uint64_t>(id));
  keyframe.id = id;
  for (std::size_t i = 0; i < keyframe.size(); ++i) keyframe.point[i] = static_cast<slam::PointId>(i);
  return keyframe;
}

TEST(PlaceIndex, KnowsAPlaceAmongMany) {
  slam::PlaceIndex index;
  for (slam::KeyframeId id = 0; id < 30; ++id) index.add(made_place(id));
  EXPECT_EQ(index.size(), 3000u);
  for (const slam::KeyframeId id : {0, 13, 29}) {
    const auto similarity = index.similarity(made_place(id));
    EXPECT_DOUBLE_EQ(similarity.at(id), 1.0);
    for (const auto& [other, share] : similarity)
      if (other != id) {
        EXPECT_LT(share, 0.1) << other;
      }
  }
}

// A corner is never described alike twice: one bit in twenty differs. Each level of the tree asks for one bit.
TEST(PlaceIndex, KnowsAPlaceWhoseDescriptorsHaveChanged) {
  slam::PlaceIndex index;
  for (slam::KeyframeId id = 0; id < 30; ++id) index.add(made_place(id));
  slam::Keyframe again = made_place(13);
  stillpoint::Random random;
  for (int row = 0; row < again.features.descriptors.rows; ++row)
    for (int flipped = 0; flipped < 13; ++flipped) {
      const auto bit = static_cast<int>(random.index(256));
      again.features.descriptors.at<std::uint8_t>(row, bit / 8) ^= static_cast<std::uint8_t>(1 << (bit % 8));
    }
  EXPECT_GT(index.similarity(again).at(13), 0.5);
}

TEST(PlaceIndex, FeaturesWithoutAPointNeverEnter) {
  slam::Keyframe walker = made_place(0);
  for (std::size_t i = 0; i < walker.size(); ++i) walker.point[i] = slam::kNone;
  slam::PlaceIndex index;
  index.add(walker);
  EXPECT_EQ(index.size(), 0u);
  EXPECT_TRUE(index.similarity(walker).empty());
}

TEST(PlaceIndex, ForgetsAKeyframe) {
  slam::PlaceIndex index;
  for (slam::KeyframeId id = 0; id < 3; ++id) index.add(made_place(id));
  index.remove(1);
  index.remove(1);
  EXPECT_EQ(index.size(), 200u);
  EXPECT_EQ(index.similarity(made_place(1)).count(1), 0u);
  EXPECT_DOUBLE_EQ(index.similarity(made_place(2)).at(2), 1.0);
}

// All alike: no bit parts them.
TEST(PlaceIndex, EqualDescriptorsStayInOneLeaf) {
  slam::Keyframe blank = made_place(0);
  blank.features.descriptors.setTo(0);
  slam::PlaceIndex index;
  index.add(blank);
  EXPECT_EQ(index.size(), 100u);
  EXPECT_DOUBLE_EQ(index.similarity(blank).at(0), 1.0);
}

TEST(SemanticCue, TellsTwoDesksApart) {
  const std::vector<slam::SeenObject> screen_and_cup = {{62, 0.2, 0.5}, {41, 0.8, 0.6}};
  const std::vector<slam::SeenObject> screen_and_plant = {{62, 0.2, 0.5}, {58, 0.8, 0.6}};
  const std::vector<slam::SeenObject> mirrored = {{62, 0.8, 0.5}, {41, 0.2, 0.6}};
  EXPECT_DOUBLE_EQ(slam::semantic_similarity(screen_and_cup, screen_and_cup), 1.0);
  EXPECT_DOUBLE_EQ(slam::semantic_similarity(screen_and_cup, screen_and_plant), 0.2 + 0.8 * 0.5);
  EXPECT_DOUBLE_EQ(slam::semantic_similarity(screen_and_cup, mirrored), 0.2);
  const std::vector<slam::SeenObject> nearby = {{62, 0.5, 0.5}, {41, 0.5, 0.5}};
  EXPECT_DOUBLE_EQ(slam::semantic_similarity(screen_and_cup, nearby), 0.2 + 0.8 * 0.5);
  EXPECT_DOUBLE_EQ(slam::semantic_similarity(screen_and_cup, {}), 1.0) << "nothing was seen: nothing is known";
}

TEST(PlacePose, FindsTheCameraAmongWrongPairs) {
  const std::vector<Vector3d> points = made_points(80);
  const slam::Map map = made_map(points, 3);
  Pose truth = camera_at(0.4);
  truth.linear() = stillpoint::rotation_from_vector({0.02, 0.1, -0.05});
  slam::Frame frame = made_frame(points, truth);
  for (std::size_t i = 0; i < 30; ++i) frame.depth_m[i] += 0.5;  // what has moved
  slam::PlacePose place_pose(camera(), slam::MeasurementNoise{});
  const std::optional<Pose> found = place_pose(frame, 1, map);
  ASSERT_TRUE(found);
  EXPECT_LT((found->translation() - truth.translation()).norm(), 1e-3);
  EXPECT_LT(stillpoint::rotation_angle(found->linear() * truth.linear().transpose()), 1e-3);
}

TEST(PlacePose, AnotherPlaceHasNone) {
  const std::vector<Vector3d> points = made_points(80);
  const slam::Map map = made_map(points, 3);
  slam::PlacePose place_pose(camera(), slam::MeasurementNoise{});
  EXPECT_FALSE(place_pose(made_frame(points, camera_at(0), 99), 1, map)) << "other descriptors";
  EXPECT_FALSE(place_pose(made_frame(made_points(80, 2), camera_at(0)), 1, map)) << "other places of the same corners";
}

/// A map whose camera comes back after `between` keyframes of something else, `drift_m` away from where it was.
struct ComesBack {
  std::vector<Vector3d> points = made_points(80);
  slam::Map map = made_map(points, 2);
  slam::LoopClosing loop_closing{camera(), slam::MeasurementNoise{}};
  slam::KeyframeId newest = slam::kNone;

  ComesBack(int between, double drift_m) {
    for (slam::KeyframeId id = 0; id < 2; ++id) loop_closing.index.add(map.keyframe(id));
    for (int k = 0; k < between; ++k) add_keyframe(made_points(80, 50 + static_cast<std::uint64_t>(k)), 0, 1000, k);
    for (int k = 0; k < 2; ++k) newest = add_keyframe(points, drift_m, 7, k);
  }

  /// A keyframe with points of its own, but for those that the one before it has, too.
  slam::KeyframeId add_keyframe(const std::vector<Vector3d>& seen, double drift_m, std::uint64_t descriptors, int k) {
    slam::Frame frame = made_frame(seen, camera_at(0.05 * k),
                                   descriptors + (descriptors == 7 ? 0 : 1u) * static_cast<std::uint64_t>(k));
    frame.camera_from_world = camera_at(0.05 * k + drift_m);
    const slam::KeyframeId last = map.last_keyframe();
    const slam::KeyframeId id = map.add(frame);
    const bool is_second = descriptors == 7 && k > 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (is_second)
        map.add_observation(map.keyframe(last).point[i], id, static_cast<int>(i));
      else
        map.add_point(id, static_cast<int>(i), seen[i] + Vector3d(drift_m, 0, 0), Vector3d(0, 0, 0.01));
    }
    if (!is_second) loop_closing.index.add(map.keyframe(id));
    return id;
  }
};

TEST(LoopClosing, ClosesALoopAndMakesItsPointsOne) {
  ComesBack world(12, 0.1);
  const auto recognised = world.loop_closing.recognise(world.newest, world.map);
  ASSERT_TRUE(recognised);
  EXPECT_LT(recognised->loop.place, 2);
  EXPECT_NEAR(recognised->loop.drift_m, 0.1, 1e-3);
  const std::size_t points_before = world.map.point_count();
  world.loop_closing.close(*recognised, world.map);
  const Vector3d position = world.map.keyframe(world.newest).camera_from_world.inverse().translation();
  EXPECT_LT((position - Vector3d(0.05, 0, 0)).norm(), 0.02);
  EXPECT_LT(world.map.point_count(), points_before - 50);
}

TEST(LoopClosing, APlaceSeenJustNowIsNoLoop) {
  ComesBack world(3, 0.1);
  EXPECT_FALSE(world.loop_closing.recognise(world.newest, world.map));
}

TEST(LoopClosing, IsSwitchedOff) {
  ComesBack world(12, 0.1);
  world.loop_closing.options.closes = false;
  EXPECT_FALSE(world.loop_closing.recognise(world.newest, world.map));
}

// Two desks of the same make, one metre apart, with the same corners. What stands on them is not the same.
TEST(LoopClosing, ObjectsTellTwoEqualDesksApart) {
  for (const bool compares_objects : {false, true}) {
    ComesBack world(12, 0.1);
    // The second desk: the same descriptors and shape, elsewhere; seen by two keyframes of the middle of the path.
    const Vector3d aside(1, 0, 0);
    const slam::KeyframeId second = 5;
    slam::Keyframe& desk = world.map.keyframe(second);
    for (std::size_t i = 0; i < desk.size(); ++i) world.map.point(desk.point[i]).p_world = world.points[i] + aside;
    slam::Frame copy = made_frame(world.points, camera_at(0));
    desk.features = copy.features;
    desk.pixel = copy.pixel;
    desk.depth_m = copy.depth_m;
    desk.grid = copy.grid;
    desk.camera_from_world = camera_at(1);
    for (const slam::PointId id : desk.point) world.map.describe(id);
    world.loop_closing.index.remove(second);
    world.loop_closing.index.add(desk);
    for (const slam::KeyframeId id : {0, 1, world.newest - 1, world.newest})
      world.map.keyframe(id).objects = {{62, 0.2, 0.5}, {41, 0.8, 0.6}};
    desk.objects = {{66, 0.2, 0.5}, {58, 0.8, 0.6}};
    world.loop_closing.options.compares_objects = compares_objects;
    world.loop_closing.options.fewest_between = 8;
    const auto recognised = world.loop_closing.recognise(world.newest, world.map);
    if (compares_objects) {
      ASSERT_TRUE(recognised);
      EXPECT_LT(recognised->loop.place, 2);
    } else {
      EXPECT_FALSE(recognised) << "nobody knows which of the two it is";
    }
  }
}

TEST(LoopClosing, RelocalisesByTheSameIndex) {
  ComesBack world(2, 0.0);
  const auto found = world.loop_closing.relocalise(made_frame(world.points, camera_at(0.3)), world.map);
  ASSERT_TRUE(found);
  EXPECT_LT((found->camera_from_world.translation() - camera_at(0.3).translation()).norm(), 1e-3);
  EXPECT_FALSE(world.loop_closing.relocalise(made_frame(world.points, camera_at(0.3), 5000), world.map));
}

TEST(FeatureGrid, MissesNoneThatIsNear) {
  stillpoint::Random random;
  std::vector<Vector2d> pixels;
  for (int i = 0; i < 500; ++i) pixels.emplace_back(680 * random.uniform() - 20, 520 * random.uniform() - 20);
  const slam::FeatureGrid grid(pixels, 640, 480);
  for (int i = 0; i < 200; ++i) {
    const Vector2d pixel(680 * random.uniform() - 20, 520 * random.uniform() - 20);
    const double reach_px = 60 * random.uniform();
    std::vector<int> times(pixels.size(), 0);
    grid.near(pixel, reach_px, [&](int feature) { ++times[static_cast<std::size_t>(feature)]; });
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      EXPECT_LE(times[k], 1);
      if ((pixels[k] - pixel).cwiseAbs().maxCoeff() <= reach_px) {
        EXPECT_EQ(times[k], 1) << k;
      }
    }
  }
  int visited = 0;
  grid.near(Vector2d(std::nan(""), 3), 10, [&](int) { ++visited; });
  slam::FeatureGrid({}, 640, 480).near(Vector2d(3, 3), 10, [&](int) { ++visited; });
  EXPECT_EQ(visited, 0);
}

}  // namespace
}  // namespace slam_test
