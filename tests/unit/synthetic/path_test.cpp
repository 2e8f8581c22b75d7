// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stillpoint::synthetic {
namespace {

constexpr double kRounding = 1e-12;  // sums of a few doubles of size 1
constexpr double kPi = 3.141592653589793;

Path two_metres_in_two_seconds(Blend blend) { return Path({{1.0, {0, 0, 0}}, {3.0, {2, 0, 0}}}, blend); }

TEST(Path, StandsStillBeforeTheFirstAndAfterTheLastWaypoint) {
  for (const Blend blend : {Blend::linear, Blend::eased, Blend::spline}) {
    const Path path = two_metres_in_two_seconds(blend);
    EXPECT_NEAR(path.world_from_object(-5.0).translation().x(), 0.0, kRounding);
    EXPECT_NEAR(path.world_from_object(99.0).translation().x(), 2.0, kRounding);
  }
}

TEST(Path, LinearLegHasConstantSpeed) {
  const Path path = two_metres_in_two_seconds(Blend::linear);
  for (double t = 1.0; t < 3.0; t += 0.1) EXPECT_NEAR(path.world_from_object(t).translation().x(), t - 1.0, kRounding);
}

TEST(Path, EasedLegFollowsTheSmoothStep) {
  // A quarter of the time: s = 0.25, s² (3 − 2 s) = 0.0625 · 2.5 = 0.15625, of 2 m: 0.3125 m.
  const Path path = two_metres_in_two_seconds(Blend::eased);
  EXPECT_NEAR(path.world_from_object(1.5).translation().x(), 0.3125, kRounding);
  EXPECT_NEAR(path.distance_m(1.5), 0.3125, kRounding);
  EXPECT_NEAR(path.world_from_object(2.0).translation().x(), 1.0, kRounding);
}

TEST(Path, SplineMeetsItsWaypointsWithoutAJumpInSpeed) {
  const Path path({{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}, 0.4}, {3.0, {1, 2, 0}, -0.2}, {3.5, {0, 2, 1}}}, Blend::spline);
  constexpr double kStep = 1e-6;
  for (const Waypoint& waypoint : path.waypoints()) {
    const auto at = [&](double t) { return Vector3d(path.world_from_object(t).translation()); };
    EXPECT_LT((at(waypoint.time_s) - waypoint.position).norm(), kRounding);
    const Vector3d before = (at(waypoint.time_s) - at(waypoint.time_s - kStep)) / kStep;
    const Vector3d after = (at(waypoint.time_s + kStep) - at(waypoint.time_s)) / kStep;
    EXPECT_LT((before - after).norm(), 1e-4);  // finite differences of accelerations of some m/s²
  }
}

TEST(Path, YawTurnsToTheRightAndPitchLooksUp) {
  const Vector3d ahead = Vector3d::UnitZ();
  EXPECT_LT((Path({{0.0, {0, 0, 0}, kPi / 2}}).world_from_object(0) * ahead - Vector3d::UnitX()).norm(), kRounding);
  EXPECT_LT((Path({{0.0, {0, 0, 0}, 0, kPi / 2}}).world_from_object(0) * ahead + Vector3d::UnitY()).norm(), kRounding);
}

TEST(Path, RefusesWaypointsThatMakeNoPath) {
  EXPECT_THROW(Path(std::vector<Waypoint>{}), Error);
  EXPECT_THROW(Path({{1.0, {0, 0, 0}}, {1.0, {1, 0, 0}}}), Error);
  EXPECT_THROW(Path({{0.0, {std::numeric_limits<double>::quiet_NaN(), 0, 0}}}), Error);
  EXPECT_THROW(Path({{0.0, {0, 0, 0}}, {std::numeric_limits<double>::quiet_NaN(), {1, 0, 0}}}), Error);
}

TEST(PathBuilder, WalkerTurnsToWhereItGoesThenGoes) {
  // Turn from z to x: a quarter turn in 0.4 s; then 1.5 m at 0.5 m/s: 3 s.
  const Path path = PathBuilder({0, 0, 0}).stand(1.0).walk_to({1.5, 0, 0}, 0.5).path();
  EXPECT_NEAR(path.waypoints().back().time_s, 4.4, kRounding);
  EXPECT_NEAR(path.waypoints().back().yaw, kPi / 2, kRounding);
  EXPECT_NEAR(path.world_from_object(1.4).translation().norm(), 0.0, kRounding);
  EXPECT_NEAR(path.distance_m(99), 1.5, kRounding);
}

TEST(PathBuilder, WalkerTurnsTheShortWay) {
  // From 170 degrees to −170 degrees are 20 degrees to the right, not 340 to the left.
  const double yaw = 170 * kPi / 180;
  const Path path = PathBuilder({0, 0, 0}, yaw).walk_to({-std::sin(kPi / 18), 0, -std::cos(kPi / 18)}, 1.0).path();
  EXPECT_NEAR(path.waypoints().back().yaw - yaw, kPi / 9, 1e-9);
}

TEST(HandShake, IsEqualForEqualSeedsAndDiffersForOthers) {
  const HandShake first(0.01, 0.01, 7), again(0.01, 0.01, 7), other(0.01, 0.01, 8);
  EXPECT_EQ(first.steady_from_shaken(1.3).matrix(), again.steady_from_shaken(1.3).matrix());
  EXPECT_NE(first.steady_from_shaken(1.3).matrix(), other.steady_from_shaken(1.3).matrix());
  EXPECT_EQ(HandShake().steady_from_shaken(1.3).matrix(), Pose::Identity().matrix());
}

TEST(HandShake, HasTheGivenRootMeanSquareInTheLongRun) {
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HandShake shake(0.01, 0.0, seed);
    for (double t = 0; t < 60; t += 0.05, ++count)
      squares += shake.steady_from_shaken(t).translation().squaredNorm() / 3;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 0.0005);  // close frequencies beat: 5 % over a minute
}

}  // namespace
}  // namespace stillpoint::synthetic
