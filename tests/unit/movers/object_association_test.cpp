// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Which object a group of features is of, which objects are one, and what an object's mean velocity is.

#include "stillpoint/movers/object_association.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/movers/object_update.hpp"

namespace stillpoint::object_association_test {
namespace {

const Camera kCamera(525, 525, 320, 240, 640, 480);
constexpr double kElapsed_s = 1.0 / 30;

/// Reported and seen, of points 5 cm apart from the top to the bottom, 2 m ahead.
TrackedObject upright(std::uint32_t id, double x, double top, double bottom, const Vector3d& mean_velocity) {
  TrackedObject object;
  object.mover.id = id;
  object.mover.centroid = Vector3d(x, 0.5 * (top + bottom), 2);
  for (double y = top; y < bottom; y += 0.05) object.points.add({x, y, 2});
  object.size_m = Vector3d(0.1, bottom - top, 0.1);
  object.mean_velocity = object.long_velocity = mean_velocity;
  object.members = object.points.size();
  object.is_confirmed = true;
  return object;
}

/// A group of 10 features on a line of 0.4 m beside x = 0.1.
std::int32_t touched_by(const Vector3d& velocity, const TrackedObject& object) {
  Workspace workspace;
  DynamicPoints points(10, workspace);
  std::vector<std::uint32_t> members;
  for (std::uint32_t k = 0; k < 10; ++k) {
    const Vector3d point(0.1, 0.04 * k, 2);
    points.pair[k] = WhitenedPair(point - kElapsed_s * velocity, 0.005, point, 0.005, 0.5, kCamera);
    points.has_step[k] = 1;
    members.push_back(k);
  }
  points.size = 10;
  const LooseGroup group(points, members, kElapsed_s, workspace);
  const std::vector<std::uint8_t> is_seen = {1};
  return ObjectAssociation::touched(group, points, {object}, is_seen);
}

TEST(ObjectAssociation, AGroupIsOfTheObjectThatItTouchesAndMovesWith) {
  const TrackedObject object = upright(1, 0, -0.5, 0.8, {0.8, 0, 0});
  EXPECT_EQ(touched_by({0.8, 0, 0}, object), 0);
  EXPECT_EQ(touched_by({-0.9, 0, 0}, object), ObjectAssociation::kNone);
  EXPECT_EQ(touched_by({0.8, 0, 0}, upright(1, 1.0, -0.5, 0.8, {0.8, 0, 0})), ObjectAssociation::kNone);
}

// The mean of the last third of a second still says 0.8 m/s, the filter of this frame says that it stands.
TEST(ObjectAssociation, WhoHasJustStoppedKeepsWhatStandsWithHim) {
  TrackedObject object = upright(1, 0, -0.5, 0.8, {0.8, 0, 0});
  object.linear.set_velocity(Vector3d::Zero());
  EXPECT_EQ(touched_by(Vector3d::Zero(), object), 0);
  object.linear.set_velocity({0.8, 0, 0});
  EXPECT_EQ(touched_by(Vector3d::Zero(), object), ObjectAssociation::kNone);
}

std::size_t count_after_merging(const TrackedObject& one, const TrackedObject& other, std::uint32_t first_id) {
  std::vector<TrackedObject> objects = {one, other};
  std::vector<std::int32_t> object_of = {0, 1};
  ObjectAssociation::merge(objects, object_of);
  EXPECT_EQ(objects[0].mover.id, first_id);
  return objects.size();
}

// A body of 1.2 m, and 0.4 m below it a foot of 0.2 m: nothing of the leg is seen.
TEST(ObjectAssociation, AFootThatWasReportedIsOneWithItsBody) {
  const Vector3d walks(0.8, 0, 0);
  const TrackedObject body = upright(1, 0, -0.6, 0.6, walks), foot = upright(2, 0.1, 1.0, 1.2, 1.1 * walks);
  EXPECT_EQ(count_after_merging(body, foot, 1), 1u);
  EXPECT_EQ(count_after_merging(foot, body, 1), 1u);
  EXPECT_EQ(count_after_merging(body, upright(2, 0.1, 1.0, 1.2, -walks), 1), 2u) << "of somebody who comes towards him";
  EXPECT_EQ(count_after_merging(body, upright(2, 1.0, 1.0, 1.2, walks), 1), 2u) << "of somebody ahead";
}

TEST(ObjectAssociation, WhoIsSeenInPartIsNoLimb) {
  const Vector3d walks(0.8, 0, 0);
  TrackedObject hidden = upright(2, 0.4, 0, 0.2, walks);
  EXPECT_EQ(count_after_merging(upright(1, 0, -0.6, 0.6, walks), hidden, 1), 1u);
  hidden.size_m = Vector3d(0.4, 1.6, 0.3);  // remembered
  EXPECT_EQ(count_after_merging(upright(1, 0, -0.6, 0.6, walks), hidden, 1), 2u);
}

/// An object of 20 features that go to the right.
void see(TrackedObject& object, double metres_per_s) {
  Workspace workspace;
  Matches matches;
  std::vector<Vector2f> pixels;
  for (int k = 0; k < 20; ++k)
    pixels.emplace_back(300.0f + 10.0f * static_cast<float>(k % 5), 200.0f + 10.0f * static_cast<float>(k / 5));
  matches.begin(pixels);
  matches.elapsed_s = kElapsed_s;
  constexpr double kDepth_m = 2.0, kSigma_m = 0.005;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    matches.state[i] = MatchState::matched;
    matches.current.undistorted[i] = pixels[i].cast<double>();
    matches.reference.undistorted[i] =
        pixels[i].cast<double>() - Vector2d(kCamera.fx() * kElapsed_s * metres_per_s / kDepth_m, 0);
    matches.current.set_depth(i, kDepth_m, kSigma_m, kCamera);
    matches.reference.set_depth(i, kDepth_m, kSigma_m, kCamera);
  }
  const FrameView frame;
  const Pose stands = Pose::Identity();
  std::vector<Label> labels(pixels.size());
  for (Label& label : labels) label.verdict = Verdict::dynamic;
  std::vector<std::int32_t> object_of(pixels.size(), 0);
  const MovingFeatures<Camera> features{frame, matches, labels, stands, kCamera, 0.5, object_of};
  ObjectUpdate::run(object, 0, features, 8, workspace);
}

TEST(ObjectUpdate, MeanVelocitiesOfFewFramesArePlainMeans) {
  TrackedObject object;
  see(object, 0.6);
  EXPECT_NEAR(object.mean_velocity.x(), 0.6, 1e-6);
  see(object, 1.2);
  EXPECT_NEAR(object.mean_velocity.x(), 0.9, 1e-6);
  EXPECT_NEAR(object.long_velocity.x(), 0.9, 1e-6);
  for (int k = 0; k < 30; ++k) see(object, 1.2);  // a second: of the 0.6 m/s the longer mean remembers more
  EXPECT_NEAR(object.mean_velocity.x(), 1.2, 0.02);
  EXPECT_LT(object.long_velocity.x(), object.mean_velocity.x() - 0.002);
}

}  // namespace
}  // namespace stillpoint::object_association_test
