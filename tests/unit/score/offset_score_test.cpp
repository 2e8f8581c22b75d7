// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/score/offset_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::offset_score_test {
namespace {

static_assert(is_scorer<OffsetScore, Camera>::value);
struct Mute {};
static_assert(!is_scorer<Mute, Camera>::value);

const double kPi = std::acos(-1.0);
constexpr double kRounding = 1e-14;
const Camera kCamera(500, 400, 320, 230, 640, 480);

/// One feature seen at `before` and `now`, pixels, with the two depths (0: none).
Matches one_feature(const Vector2d& before, double before_m, const Vector2d& now, double now_m) {
  const std::vector<Vector2f> pixels = {now.cast<float>()};
  Matches matches;
  matches.begin(pixels);
  matches.state[0] = MatchState::matched;
  matches.reference.undistorted[0] = before;
  matches.reference.set_depth(0, before_m, 0.01, kCamera);
  matches.current.undistorted[0] = now;
  matches.current.set_depth(0, now_m, 0.01, kCamera);
  return matches;
}

float score_of(const Matches& matches, const Motion& motion) {
  std::vector<FeatureScore> scores(matches.size());
  OffsetScore{}.score(test::observations_of(matches), motion, kCamera, span<FeatureScore>(scores));
  return scores[0].value;
}

TEST(OffsetScore, AngleByHand) {
  const OffsetScore meant;
  EXPECT_NEAR(meant.angle({1, 0, 0}, {0, 2, 0}), kPi / 2, kRounding);
  EXPECT_NEAR(meant.angle({1, 0, 0}, {1, 1, 0}), kPi / 4, kRounding);
  EXPECT_NEAR(meant.angle({1, 0, 0}, {-1, 1, 0}), 3 * kPi / 4, kRounding);
  EXPECT_NEAR(meant.angle({1, 0, 0}, {-3, 0, 0}), kPi, kRounding);
  EXPECT_EQ(meant.angle({1, 2, 3}, {2, 4, 6}), 0.0) << "parallel rays have no angle";
}

TEST(OffsetScore, SmallAnglesKeepTheirDigits) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12})
    EXPECT_NEAR(OffsetScore{}.angle({0, 0, 3}, {2 * std::sin(angle), 0, 2 * std::cos(angle)}), angle, 1e-9 * angle);
}

// Eq. 8 as printed, |arctan(dot / cross)|: the complement of the angle.
TEST(OffsetScore, PrintedAngleIsTheComplement) {
  OffsetScore printed;
  printed.options.printed_eq8 = true;
  EXPECT_NEAR(printed.angle({1, 0, 0}, {2, 0, 0}), kPi / 2, kRounding) << "as printed, parallel rays have the most";
  EXPECT_NEAR(printed.angle({1, 0, 0}, {-2, 0, 0}), kPi / 2, kRounding);
  EXPECT_NEAR(printed.angle({1, 0, 0}, {0, 2, 0}), 0.0, kRounding);
  EXPECT_NEAR(printed.angle({1, 0, 0}, {-1, 1, 0}), kPi / 4, kRounding);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d a(random.gaussian(), random.gaussian(), 3.0), b(random.gaussian(), random.gaussian(), 3.0);
    EXPECT_NEAR(printed.angle(a, b), std::abs(kPi / 2 - OffsetScore{}.angle(a, b)), 1e-12);
  }
}

TEST(OffsetScore, AddsAngleAndLengthByTheirWeights) {
  // P = (0, 0, 2), Q = (2, 0, 2): θ = π/4, l = 2, Th = 0.7 π/4 + 0.3 · 2 (Eq. 7 to 9).
  OffsetScore scorer;
  EXPECT_NEAR(scorer.offset({0, 0, 2}, {2, 0, 2}), 0.7 * kPi / 4 + 0.6, kRounding);
  // Along the ray there is length only: 0.3 · 1.
  EXPECT_NEAR(scorer.offset({0, 0, 2}, {0, 0, 3}), 0.3, kRounding);
  scorer.options.angle_weight = 2.0;
  scorer.options.length_weight = 5.0;
  EXPECT_NEAR(scorer.offset({0, 0, 2}, {2, 0, 2}), kPi / 2 + 10.0, kRounding);
}

// Eq. 4 to 9 from pixels and depths. Before: pixel (320, 230) at 2 m is P = (0, 0, 2). The camera turns a quarter about
// y and moves: P^C = R P + t = (2, 0, 0) + (0, 0, 2) = (2, 0, 2). Now: pixel (320, 230) at 2 m is Q = (0, 0, 2).
TEST(OffsetScore, ScoresAFeatureFromPixelsAndDepths) {
  Motion motion;
  motion.current_from_reference.linear() = rotation_from_vector({0, kPi / 2, 0});
  motion.current_from_reference.translation() = Vector3d(0, 0, 2);
  const Matches matches = one_feature({320, 230}, 2.0, {320, 230}, 2.0);
  EXPECT_NEAR(score_of(matches, motion), 0.7 * kPi / 4 + 0.3 * 2.0, 1e-7);  // scores are floats
}

TEST(OffsetScore, IsZeroForStandingPointsUnderAnyMotion) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Motion motion;
    motion.current_from_reference.linear() =
        rotation_from_vector(0.1 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian()));
    motion.current_from_reference.translation() = 0.1 * Vector3d(random.gaussian(), random.gaussian(), 0.5);
    const Vector2d before(random.uniform(0, 640), random.uniform(0, 480));
    const double before_m = random.uniform(1.0, 5.0);
    const Vector3d now = motion.current_from_reference * kCamera.back_project(before, before_m);
    const Matches matches = one_feature(before, before_m, kCamera.project(now), now.z());
    EXPECT_NEAR(score_of(matches, motion), 0.0f, 1e-6f);
    Motion inverted = motion;
    inverted.current_from_reference = motion.current_from_reference.inverse();
    EXPECT_GT(score_of(matches, inverted), 1e-4f) << "the direction of the motion matters";
  }
}

TEST(OffsetScore, WithoutAMatchOrADepthThereIsNoScore) {
  Matches matches = one_feature({320, 230}, 2.0, {320, 230}, 2.0);
  EXPECT_FALSE(std::isnan(score_of(matches, Motion{})));
  matches.state[0] = MatchState::near_edge;
  EXPECT_FALSE(std::isnan(score_of(matches, Motion{})));
  matches.state[0] = MatchState::lost;
  EXPECT_TRUE(std::isnan(score_of(matches, Motion{})));
  matches.state[0] = MatchState::outside;
  EXPECT_TRUE(std::isnan(score_of(matches, Motion{})));
  EXPECT_TRUE(std::isnan(score_of(one_feature({320, 230}, 0.0, {320, 230}, 2.0), Motion{})));
  EXPECT_TRUE(std::isnan(score_of(one_feature({320, 230}, 2.0, {320, 230}, 0.0), Motion{})));
}

}  // namespace
}  // namespace stillpoint::offset_score_test
