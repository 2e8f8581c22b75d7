// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/movers/object_identity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace stillpoint::object_identity_test {
namespace {

constexpr double kNow_s = 5.0;

/// A person of 0.4 x 1.6 x 0.3 m, reported, who walks to the right at 0.8 m/s and was seen up to now.
TrackedObject walker(std::uint32_t id, const Vector3d& centroid) {
  TrackedObject object;
  object.mover.id = id;
  object.mover.centroid = centroid;
  object.mover.first_seen_s = 1.0;
  object.mover.last_seen_s = kNow_s;
  object.size_m = Vector3d(0.4, 1.6, 0.3);
  object.mean_velocity = Vector3d(0.8, 0, 0);
  for (int k = 0; k < 20; ++k) object.linear.correct(object.mean_velocity, 1e-4 * Matrix3d::Identity());
  object.members = 100;
  object.is_confirmed = true;
  return object;
}

TrackedObject lost(TrackedObject object, double unseen_s) {
  object.is_seen = false;
  object.mover.state = MoverState::lost;
  object.mover.last_seen_s = kNow_s - unseen_s;
  for (double past_s = 0; past_s < unseen_s; past_s += 0.1) object.linear.predict(Matrix3d::Identity(), 0.1, 1.0);
  return object;
}

/// A new object of 0.1 x 0.3 x 0.1 m.
TrackedObject strip(const Vector3d& centroid, const Vector3d& velocity, std::size_t members = 20) {
  TrackedObject object;
  object.mover.centroid = centroid;
  object.mover.first_seen_s = kNow_s - 0.1;
  object.mover.last_seen_s = kNow_s;
  object.size_m = Vector3d(0.1, 0.3, 0.1);
  object.mean_velocity = velocity;
  object.members = members;
  return object;
}

double misfit(const TrackedObject& part, const TrackedObject& object) {
  return ObjectIdentity::misfit_of_lost(part.mover.centroid, part.mean_velocity, part.appearance, object,
                                        kNow_s - object.mover.last_seen_s);
}

TEST(ObjectIdentity, AStripInTheExtentOfALostObjectIsThatObject) {
  const TrackedObject object = lost(walker(1, {0, 0, 2}), 0.5);
  // 0.7 m from the centroid, inside of the box; the leg swings, and nobody knows what it looks like: (1/2 / 0.7)².
  EXPECT_LT(misfit(strip({0.15, 0.7, 2}, {1.2, 0, 0}), object), ObjectIdentity::kMostMisfit);
  EXPECT_NEAR(misfit(strip({0.15, 0.7, 2}, {0.8, 0, 0}), object), 0.25 / 0.49, 1e-3);
}

TEST(ObjectIdentity, WhoWalksTheOtherWayOrElsewhereIsSomebodyElse) {
  const TrackedObject object = lost(walker(1, {0, 0, 2}), 0.2);
  EXPECT_GT(misfit(strip({0, 0, 2}, {-0.9, 0, 0}), object), ObjectIdentity::kMostMisfit);
  EXPECT_TRUE(std::isinf(misfit(strip({1.0, 0, 2}, {0.8, 0, 0}), object)));
}

TEST(ObjectIdentity, TheLongerItIsNotSeenTheFartherItMayBe) {
  const TrackedObject part = strip({0.6, 0, 2}, {0.8, 0, 0});
  EXPECT_TRUE(std::isinf(misfit(part, lost(walker(1, {0, 0, 2}), 0.1))));
  EXPECT_LT(misfit(part, lost(walker(1, {0, 0, 2}), 0.8)), ObjectIdentity::kMostMisfit);
}

TEST(ObjectIdentity, ALimbIsOfTheBodyThatItMovesWith) {
  const Vector3d foot(0.3, 1.2, 2);
  std::vector<TrackedObject> objects = {walker(1, {0, 0, 2}), strip(foot, {1.5, 0, 0})};
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), 0);
  objects[1].mean_velocity = Vector3d(-0.8, 0, 0);  // somebody who comes the other way
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone);
  objects[1] = strip({1.5, 0, 2}, {0.8, 0, 0});  // somebody who walks ahead
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone);
  objects[0].is_confirmed = false;
  objects[1] = strip(foot, {0.8, 0, 0});
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone);
}

// The most is 0.3 m/s + 1.5 · 0.8 m/s forward of the body's velocity, 0.3 m/s + 0.8 · 0.8 m/s in any other direction.
TEST(ObjectIdentity, ALegSwingsForwardFasterThanInAnyOtherDirection) {
  std::vector<TrackedObject> objects = {walker(1, {0, 0, 2}), strip({0.3, 1.2, 2}, {0.8 + 1.45, 0, 0})};
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), 0);
  objects[1].mean_velocity.x() = 0.8 + 1.55;
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone);
  for (const Vector3d& direction : {Vector3d(-1, 0, 0), Vector3d(0, 0, 1)}) {
    objects[1].mean_velocity = objects[0].mean_velocity + 0.9 * direction;
    EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), 0);
    objects[1].mean_velocity = objects[0].mean_velocity + 1.0 * direction;
    EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone);
  }
}

// Only the upper half of the body is seen: 0.8 m lie between it and the foot.
TEST(ObjectIdentity, AFootFarBelowItsBodyWaitsForAStride) {
  std::vector<TrackedObject> objects = {walker(1, {0, -0.5, 2}), strip({0.2, 0.85, 2}, {2.0, 0, 0})};
  objects[0].size_m.y() = 0.8;
  EXPECT_TRUE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  EXPECT_EQ(ObjectIdentity::known(objects, 1, kNow_s), ObjectIdentity::kNone) << "too far to be sure";
  objects[1].mean_velocity.x() = -2.0;  // somebody who comes the other way
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1] = strip({0.2, 1.2, 2}, {2.0, 0, 0});
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
}

TEST(ObjectIdentity, WhatMayBeALimbWaitsForAStride) {
  std::vector<TrackedObject> objects = {walker(1, {0, 0, 2}), strip({0.3, 1.2, 2}, {2.2, 0, 0})};
  EXPECT_TRUE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1].mean_velocity.x() = 2.4;  // (2.4 - 0.8) / (0.3 + 1.5 · 0.8) of what limbs do
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1].mean_velocity.x() = 2.2;
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s + 0.5));
  objects[1].members = 60;  // a foot with as many features as the shirt
  EXPECT_TRUE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1].size_m.y() = 0.9;  // more than half of a person
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1].members = 20;
  EXPECT_TRUE(ObjectIdentity::may_be_limb(objects, 1, kNow_s)) << "of few features, however long";
  objects[0].mean_velocity.setZero();  // what stands has no limbs that swing
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
}

// He has just passed behind somebody, of whom 13 features were left at the end. His foot comes out first.
TEST(ObjectIdentity, AFootThatComesOutBeforeItsBodyWaitsToo) {
  const TrackedObject walks = walker(1, {0, 0, 2});
  std::vector<TrackedObject> objects = {lost(walks, 0.1), strip({0.3, 1.1, 2}, {2.0, 0, 0})};
  objects[0].members = 13;
  EXPECT_TRUE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects[1].size_m.y() = 0.9;  // more than half of a person
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s));
  objects = {lost(walks, 0.6), strip({0.3, 1.1, 2}, {2.0, 0, 0})};
  EXPECT_FALSE(ObjectIdentity::may_be_limb(objects, 1, kNow_s)) << "nobody knows where he is by now";
}

// A foot that was reported by itself, 0.05 m below the body's box, swings at 1.5 m/s where the body walks at 0.8 m/s:
// 0.7 / (0.3 + 1.5 · 0.8) of what limbs do. Once it is lost it is the body's; as long as it is seen, or where it went
// the other way, or lies elsewhere, or the body is lost as well, it is itself.
TEST(ObjectIdentity, ALostLimbIsItsBodys) {
  TrackedObject foot = strip({0, 1.0, 2}, {1.5, 0, 0});
  foot.is_confirmed = true;
  const auto body_of = [](const TrackedObject& part, const TrackedObject& body) {
    return ObjectIdentity::body_of_lost({body, part}, 1);
  };
  const TrackedObject body = walker(1, {0, 0, 2});
  EXPECT_EQ(body_of(lost(foot, 0.1), body), 0);
  EXPECT_EQ(body_of(foot, body), ObjectIdentity::kNone);
  EXPECT_EQ(body_of(lost(foot, 0.1), lost(body, 0.1)), ObjectIdentity::kNone);
  EXPECT_EQ(body_of(lost(foot, 0.1), walker(1, {1.0, 0, 2})), ObjectIdentity::kNone) << "0.75 m away";
  TrackedObject behind = foot;
  behind.mover.centroid.y() += 0.15;
  EXPECT_EQ(body_of(lost(behind, 0.1), body), ObjectIdentity::kNone) << "0.2 m away: it may be somebody behind it";
  TrackedObject back = foot;
  back.mean_velocity = Vector3d(-0.8, 0, 0);
  EXPECT_EQ(body_of(lost(back, 0.1), body), ObjectIdentity::kNone);
  TrackedObject child = foot;
  child.members = 60;
  EXPECT_EQ(body_of(lost(child, 0.1), body), ObjectIdentity::kNone) << "more than half of the body's features";
  child = foot;
  child.size_m.y() = 0.9;
  EXPECT_EQ(body_of(lost(child, 0.1), body), ObjectIdentity::kNone) << "more than half of its length";
  TrackedObject rumour = body;
  rumour.is_confirmed = false;
  EXPECT_EQ(body_of(lost(foot, 0.1), rumour), ObjectIdentity::kNone) << "it has no identity to give";
}

TEST(ObjectIdentity, WhatComesBackTakesOverTheIdentifier) {
  std::vector<TrackedObject> objects = {lost(walker(7, {0, 0, 2}), 0.5), walker(9, {3, 0, 2}),
                                        strip({0.1, 0, 2}, {0.8, 0, 0})};
  objects[2].points.add({0.1, 0, 2});
  std::vector<std::int32_t> object_of = {0, 1, 2, 2, -1};
  ObjectIdentity::unite(objects, 0, 2, object_of);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].mover.id, 7u);
  EXPECT_EQ(objects[0].mover.first_seen_s, 1.0);
  EXPECT_TRUE(objects[0].is_confirmed);
  EXPECT_TRUE(objects[0].is_seen);
  EXPECT_EQ(objects[0].mover.centroid, Vector3d(0.1, 0, 2));
  EXPECT_EQ(objects[0].points.size(), 1u);  // where it was predicted is forgotten
  EXPECT_EQ(objects[1].mover.id, 9u);
  EXPECT_EQ(object_of, (std::vector<std::int32_t>{0, 1, 0, 0, -1}));
}

}  // namespace
}  // namespace stillpoint::object_identity_test
