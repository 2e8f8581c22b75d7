// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What both of the small trackers must do, whatever their features.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "backends/descriptor_match.hpp"
#include "backends/klt_odometry.hpp"
#include "backends/orb_odometry.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace trackers_test {
namespace {

using examples::KltOdometry;
using examples::OrbOdometry;
using stillpoint::Pose;

// Whatever the order in which features come: the second best is that of the best's octave, found before it or after.
TEST(DescriptorMatch, TheRivalIsOfTheBestsOctave) {
  std::vector<std::pair<int, int>> octave_bits = {{2, 40}, {2, 42}, {3, 41}};
  do {
    examples::DescriptorMatch match;
    for (const auto& [octave, bits] : octave_bits) match.compare(bits, octave, bits);
    EXPECT_EQ(match.feature, 40);
    EXPECT_EQ(match.bits, 40);
    EXPECT_EQ(match.second_bits(), 42);
  } while (std::next_permutation(octave_bits.begin(), octave_bits.end()));
  examples::DescriptorMatch alone;
  EXPECT_EQ(alone.feature, -1);
  alone.compare(7, 5, 30);
  EXPECT_EQ(alone.second_bits(), examples::kDescriptorBits);
}

/// One frame of the static room, and what the tracker is given of it.
struct Step {
  int index;
  std::size_t features = 10000;  ///< at most
  bool has_depth = true;
};

struct Tracked {
  std::optional<Pose> world_from_camera;
  double error_m = 0.0;  ///< of the position, by the camera of the first frame
};

template <class Backend>
std::vector<Tracked> track(const std::vector<Step>& steps) {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::static_room());
  stillpoint::SyntheticFrame frame;
  Backend backend(sequence.camera());
  std::vector<Tracked> tracked;
  Pose first_from_world = Pose::Identity();
  for (const Step& step : steps) {
    sequence.render(step.index, frame);
    if (tracked.empty()) first_from_world = frame.world_from_camera.inverse();
    stillpoint::FrameView view(frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor),
                               frame.timestamp_s);
    if (!step.has_depth) view.depth = {};
    auto features = backend.extract(view);
    std::vector<std::uint8_t> keep(features.keypoints.size(), 1);
    for (std::size_t i = step.features; i < keep.size(); ++i) keep[i] = 0;
    features.compact(keep);
    Tracked result{backend.track(view, features)};
    if (result.world_from_camera) {
      const Pose truth = first_from_world * frame.world_from_camera;
      result.error_m = (truth.translation() - result.world_from_camera->translation()).norm();
    }
    tracked.push_back(result);
  }
  return tracked;
}

template <class Backend>
class Trackers : public testing::Test {};
using Backends = testing::Types<KltOdometry, OrbOdometry>;
TYPED_TEST_SUITE(Trackers, Backends);

// The depth of a point at 2 m is 6 mm uncertain (KinectNoise), its pixel 0.7 px or 2.7 mm; a pose from a hundred of
// them a tenth of both. A second of motion takes at most some five keyframes, whose errors add up.
constexpr double kDrift_m = 5 * 0.1 * (0.006 + 0.0027);

TYPED_TEST(Trackers, FollowTheCamera) {
  std::vector<Step> steps;
  for (int i = 0; i < 20; ++i) steps.push_back({i});
  for (const Tracked& tracked : track<TypeParam>(steps)) {
    ASSERT_TRUE(tracked.world_from_camera);
    EXPECT_LT(tracked.error_m, kDrift_m);
  }
}

TYPED_TEST(Trackers, FramesWithFewFeaturesHaveNoPose) {
  for (const std::size_t left : {std::size_t{0}, std::size_t{11}}) {
    const std::vector<Tracked> tracked = track<TypeParam>({{0}, {1}, {2, left}});
    EXPECT_TRUE(tracked[1].world_from_camera);
    EXPECT_FALSE(tracked[2].world_from_camera);
  }
}

TYPED_TEST(Trackers, BeginWithTheFirstFrameThatHasDepth) {
  const std::vector<Tracked> tracked = track<TypeParam>({{0, 10000, false}, {1, 10000, false}, {2}, {3}});
  EXPECT_FALSE(tracked[0].world_from_camera);
  EXPECT_FALSE(tracked[1].world_from_camera);
  ASSERT_TRUE(tracked[2].world_from_camera);
  EXPECT_TRUE(tracked[2].world_from_camera->matrix().isIdentity());
  EXPECT_TRUE(tracked[3].world_from_camera);
}

// Sixteen frames without a pose are more than they wait for: then the world begins anew where it was left.
TYPED_TEST(Trackers, BeginAnewWhereTheyWereLost) {
  std::vector<Step> steps = {{0}, {1}};
  for (int i = 0; i < 16; ++i) steps.push_back({2, 0});
  steps.push_back({2});
  const std::vector<Tracked> tracked = track<TypeParam>(steps);
  for (std::size_t i = 2; i < 18; ++i) EXPECT_FALSE(tracked[i].world_from_camera) << i;
  ASSERT_TRUE(tracked[18].world_from_camera);
  EXPECT_LT(tracked[18].error_m, 0.02);  // what the camera moves in a frame
}

TEST(OrbOdometry, FindsItsWayBackAfterAFrameWithoutFeatures) {
  const std::vector<Tracked> tracked = track<OrbOdometry>({{0}, {1}, {2, 0}, {20}, {21}});
  EXPECT_FALSE(tracked[2].world_from_camera);
  for (const std::size_t i : {std::size_t{3}, std::size_t{4}}) {
    ASSERT_TRUE(tracked[i].world_from_camera);
    EXPECT_LT(tracked[i].error_m, 2 * kDrift_m);
  }
}

TYPED_TEST(Trackers, EqualFramesGiveEqualBytes) {
  const std::vector<Step> steps = {{0}, {1}, {2}, {10}, {11}};
  const std::vector<Tracked> first = track<TypeParam>(steps), second = track<TypeParam>(steps);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].world_from_camera.has_value(), second[i].world_from_camera.has_value());
    if (first[i].world_from_camera) {
      EXPECT_TRUE(first[i].world_from_camera->matrix() == second[i].world_from_camera->matrix());
    }
  }
}

/// The first frame of the static room.
struct Room {
  stillpoint::SyntheticSequence sequence{stillpoint::synthetic::static_room()};
  stillpoint::SyntheticFrame frame;
  stillpoint::FrameView view(int index) {
    sequence.render(index, frame);
    return {frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor), frame.timestamp_s};
  }
};

TEST(OrbOdometry, KeepsItsBudgetOfFeatures) {
  Room room;
  for (const int features : {50, 300}) {
    OrbOdometry::Options options;
    options.orb.features = features;
    OrbOdometry odometry(room.sequence.camera(), options);
    const examples::OrbFeatures found = odometry.extract(room.view(0));
    EXPECT_EQ(found.keypoints.size(), static_cast<std::size_t>(features));
    EXPECT_EQ(found.descriptors.rows, features);
  }
}

TEST(KltOdometry, ADroppedTrackNeverComesBack) {
  Room room;
  KltOdometry odometry(room.sequence.camera());
  stillpoint::FrameView view = room.view(0);
  examples::TrackedPoints points = odometry.extract(view);
  std::vector<std::uint8_t> keep(points.ids.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = i % 2;
  const std::vector<std::uint64_t> all = points.ids;
  points.compact(keep);
  odometry.track(view, points);
  view = room.view(1);
  const std::vector<std::uint64_t> ids = odometry.extract(view).ids;
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  std::size_t carried = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_there = std::binary_search(ids.begin(), ids.end(), all[i]);
    carried += is_there;
    if (keep[i] == 0) {
      EXPECT_FALSE(is_there) << all[i];
    }
  }
  EXPECT_GT(carried, all.size() / 4);  // of the half that was kept
}

}  // namespace
}  // namespace trackers_test
