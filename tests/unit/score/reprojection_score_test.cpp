// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/score/reprojection_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::reprojection_score_test {
namespace {

static_assert(is_scorer<ReprojectionScore, Camera>::value);

/// One feature straight ahead at 2 m; a camera of 500 px. A patch that looks just alike has half of 2 px, so that σ = 1
/// px.
class ReprojectionScoreTest : public testing::Test {
 protected:
  ReprojectionScoreTest() {
    scorer_.options.pixel_sigma = 2.0;
    scorer_.options.depth_sigmas = 0.92;
    scorer_.options.most_from_place = 8.0;
    scorer_.options.most_from_look = 6.0;
    scorer_.options.most_from_depth = 7.0;
    const std::vector<Vector2f> pixel = {{320, 240}};
    matches_.begin(pixel);
    matches_.current.undistorted[0] = {320, 240};
    matches_.current.set_depth(0, 2.0, 0.03, camera_);
  }

  /// Another older frame in which the feature was found `away` from its place, at a depth.
  Observation& seen(const Vector2f& away, float dissimilarity, float depth_m = 0.0f, double elapsed_s = 0.0) {
    OlderFrame& frame = matches_.past_observations.add(1);
    matches_.past_observations.point[0] = point_;
    matches_.past_observations.inverse_depth_sigma[0] = inverse_depth_sigma_;
    frame.reference_from_current = reference_from_current_;
    frame.elapsed_s = elapsed_s;
    Observation& observation = frame.of_feature[0];
    observation.state = ObservationState::seen;
    observation.dissimilarity = dissimilarity;
    observation.found = Vector2f(320, 240) + away;
    observation.depth_m = depth_m;
    observation.depth_sigma_m = 0.04f;
    return observation;
  }

  float score() {
    std::vector<FeatureScore> scores(1);
    scorer_.score(test::observations_of(matches_), motion_, camera_, scores);
    return scores[0].value;
  }

  /// Two equal observations: their mean is the evidence of one.
  float evidence(const Vector2f& away, float dissimilarity, float depth_m = 0.0f, double elapsed_s = 0.0) {
    matches_.past_observations.clear();
    seen(away, dissimilarity, depth_m, elapsed_s);
    seen(away, dissimilarity, depth_m, elapsed_s);
    return score();
  }

  Camera camera_{500, 500, 320, 240, 640, 480};
  Vector3d point_{0, 0, 2};
  double inverse_depth_sigma_ = 0;
  Pose reference_from_current_ = Pose::Identity();
  ReprojectionScore scorer_;
  Matches matches_;
  Motion motion_;
};

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kRounding = 1e-4f;

// 2 px away is d² = 4, two nats; 0.12 unlike is one nat, and then σ = 2 px; 2.5 nats are expected.
TEST_F(ReprojectionScoreTest, PlaceAndLookAddUp) {
  EXPECT_NEAR(evidence({2, 0}, 0.0f), 2.0f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({0, 4}, 0.12f), 2.0f + 1.0f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({0, 0}, 0.0f), -2.5f, kRounding) << "a perfect observation speaks for standing still";
}

// An alike patch has half of the noise, 1 px, one that is half as unlike as the scale of 0.12 three quarters, 1.5 px: 2
// px are then d² = 4, d² = (2 / 1.5)² = 16 / 9, and d² = 1.
TEST_F(ReprojectionScoreTest, APatchThatLooksAlikeIsLocatedBetter) {
  EXPECT_NEAR(evidence({2, 0}, 0.0f), 2.0f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({2, 0}, 0.06f), 8.0f / 9.0f + 0.5f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({2, 0}, 0.12f), 0.5f + 1.0f - 2.5f, kRounding);
}

// The older camera stood 0.1 m to the left: a point at 2 m is seen 500 · 0.1 / 2 = 25 px to the right there, and a
// tenth of its inverse depth, 0.05 / m, is 500 · 0.1 · 0.05 = 2.5 px along the row. 5 px along it are then 25 / (1
// + 2.5²) = 3.448, across it 25.
TEST_F(ReprojectionScoreTest, ASupposedDepthLeavesTheDistanceFromTheEpipolarLine) {
  reference_from_current_.translation().x() = 0.1;
  EXPECT_NEAR(evidence({25, 3}, 0.0f), 4.5f - 2.5f, kRounding) << "a known depth: 3 px";
  inverse_depth_sigma_ = 0.05;
  EXPECT_NEAR(evidence({30, 0}, 0.0f), 0.5f * 25.0f / 7.25f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({25, 3}, 0.0f), 4.5f - 2.5f, kRounding);
  inverse_depth_sigma_ = 1e6;
  EXPECT_NEAR(evidence({90, 3}, 0.0f), 4.5f - 2.5f, 1e-3f) << "all but unknown: only the row counts";
}

// σ = 0.92 √(0.03² + 0.04²) + 0.004 = 0.05 m; 0.1 m of difference is d² = 4, two nats, of which one is expected.
TEST_F(ReprojectionScoreTest, DepthCountsInItsOwnNoise) {
  EXPECT_NEAR(evidence({0, 0}, 0.0f, 2.1f), -2.5f + 2.0f - 1.0f, kRounding);
  EXPECT_NEAR(evidence({0, 0}, 0.0f, 1.9f), -2.5f + 2.0f - 1.0f, kRounding);
  EXPECT_NEAR(evidence({0, 0}, kNaN, 2.1f), 2.0f - 1.0f, kRounding) << "depth alone, where no patch could be compared";
  scorer_.options.depth_sigmas = 1.92;  // σ = 0.1: half a nat
  EXPECT_NEAR(evidence({0, 0}, kNaN, 2.1f), 0.5f - 1.0f, kRounding);
  scorer_.options.depth_sigmas = 0.92;
  motion_.depth_noise = 2.0;  // σ = 0.1, as the motion has measured
  EXPECT_NEAR(evidence({0, 0}, kNaN, 2.1f), 0.5f - 1.0f, kRounding);
  motion_.depth_noise = 1.0;
  scorer_.options.depth_sigmas = 0.0;  // 4 mm are left
  EXPECT_NEAR(evidence({0, 0}, kNaN, 2.004f), 0.5f - 1.0f, 1e-3f);
}

TEST_F(ReprojectionScoreTest, EvidenceSaturates) {
  EXPECT_NEAR(evidence({100, 0}, 0.0f), 8.0f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({0, 0}, 2.0f), 6.0f - 2.5f, kRounding);
  EXPECT_NEAR(evidence({0, 0}, kNaN, 6.0f), 7.0f - 1.0f, kRounding);
}

// σ = 1 + 1 · 1 = 2 px after a second: 4 px away is d² = 4.
TEST_F(ReprojectionScoreTest, TheChainedPoseDriftsWithTime) {
  EXPECT_NEAR(evidence({4, 0}, 0.0f, 0.0f, 1.0), 2.0f - 2.5f, kRounding);
}

// σ_ω = 0.002 rad and σ_v = 0.004 m at 2 m are each 1 px at f = 500: the variance is 1 + 1 + 1, 6 px² / 3 / 2 = 1 nat.
TEST_F(ReprojectionScoreTest, ThePosesOwnErrorIsNoEvidence) {
  motion_.covariance.topLeftCorner<3, 3>() = 4e-6 * Matrix3d::Identity();
  motion_.covariance.bottomRightCorner<3, 3>() = 16e-6 * Matrix3d::Identity();
  EXPECT_NEAR(evidence({std::sqrt(6.0f), 0}, 0.0f), 1.0f - 2.5f, 1e-3f);
  motion_.correlation = 2.0;  // twice as large as that of independent constraints: the variance is 1 + 2 / 2
  EXPECT_NEAR(evidence({std::sqrt(6.0f), 0}, 0.0f), 1.5f - 2.5f, 1e-3f);
}

// An equidistant lens at 45 degrees: a pixel of the image is 1 + tan² 45 = 2 on the plane. 4 px are then d² = 4.
TEST_F(ReprojectionScoreTest, TheLensStretchesTheNoise) {
  camera_ = Camera(500, 500, 320, 240, 640, 480, EquidistantFisheye{});
  point_ = {2, 0, 2};
  EXPECT_NEAR(evidence({500, 4}, 0.0f), 2.0f - 2.5f, 0.02f);
  camera_ = Camera(500, 500, 320, 240, 640, 480);
  EXPECT_NEAR(evidence({500, 4}, 0.0f), 8.0f - 2.5f, kRounding);
}

TEST_F(ReprojectionScoreTest, WhatAStaticPatchScoresIsTakenOff) {
  scorer_.expected_patch = 1.0;
  EXPECT_NEAR(evidence({2, 0}, 0.0f), 2.0f - 1.0f, kRounding);
}

// ---- The motion says how exact its matches are ----

// 3.2 times 0.625 px are the 2 px of the options: no more is ever assumed.
TEST_F(ReprojectionScoreTest, AnOrdinaryMotionLeavesTheNoiseAsItIs) {
  for (const double pixel_sigma : {0.0, 0.625, 0.7, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    motion_.pixel_sigma = pixel_sigma;
    EXPECT_NEAR(evidence({2, 0}, 0.0f), 2.0f - 2.5f, kRounding) << pixel_sigma;
    EXPECT_NEAR(evidence({4, 0}, 0.0f, 0.0f, 1.0), 2.0f - 2.5f, kRounding) << pixel_sigma;
  }
}

// 3.2 · 0.3125 = 1 px is half of the noise, which is 1 px, or 1 + 1 = 2 px after a second: half of the displacement is
// worth as much.
TEST_F(ReprojectionScoreTest, WithExactMatchesHalfOfTheDisplacementSaysAsMuch) {
  motion_.pixel_sigma = 0.3125;
  EXPECT_NEAR(evidence({1, 0}, 0.0f), 2.0f - 2.5f, kRounding) << "2 px without";
  EXPECT_NEAR(evidence({0, 1.5f}, 0.06f), 2.0f + 0.5f - 2.5f, kRounding) << "3 px without; the look counts as ever";
  EXPECT_NEAR(evidence({2, 0}, 0.0f, 0.0f, 1.0), 2.0f - 2.5f, kRounding) << "4 px without: the drift shrinks, too";
  EXPECT_NEAR(evidence({0, 0}, kNaN, 2.1f), 2.0f - 1.0f, kRounding) << "a depth has no pixels";
}

// A noise of pixel_sigma = 4 px is what the measured one is compared with: 3.2 · 0.625 / 4 is half of it, 1 px where
// patches look alike.
TEST_F(ReprojectionScoreTest, TheMeasuredNoiseReplacesTheSupposed) {
  scorer_.options.pixel_sigma = 4.0;
  motion_.pixel_sigma = 0.625;
  EXPECT_NEAR(evidence({2, 0}, 0.0f), 2.0f - 2.5f, kRounding);
}

// 3.2 · 0.1875 / 2 is the floor of 0.3: 0.6 px are d² = 4, however exact the matches are.
TEST_F(ReprojectionScoreTest, NoMatchesAreSoExactThatNothingIsLeft) {
  for (const double pixel_sigma : {0.1875, 0.05, 1e-6}) {
    motion_.pixel_sigma = pixel_sigma;
    EXPECT_NEAR(evidence({0.6f, 0}, 0.0f), 2.0f - 2.5f, 1e-3f) << pixel_sigma;
    EXPECT_NEAR(evidence({0, 1.2f}, 0.0f, 0.0f, 1.0), 2.0f - 2.5f, 1e-3f) << pixel_sigma;
  }
}

TEST_F(ReprojectionScoreTest, OneObjectionAloneIsHalfAnObjection) {
  seen({4, 0}, 0.0f);  // 8 nats less 2.5
  EXPECT_NEAR(score(), 0.7f * 5.5f, kRounding) << "what one frame alone saw counts less";
  seen({0, 0}, 0.0f);
  EXPECT_NEAR(score(), 0.5f * (5.5f - 2.5f), kRounding);
  seen({2, 0}, 0.0f);
  EXPECT_NEAR(score(), 0.5f * (5.5f - 0.5f), kRounding) << "the two that object most";
}

TEST_F(ReprojectionScoreTest, WhatWasNotSeenIsNotScored) {
  EXPECT_TRUE(std::isnan(score())) << "no older frame";
  seen({50, 0}, 2.0f, 5.0f).state = ObservationState::occluded;
  seen({50, 0}, 2.0f, 5.0f).state = ObservationState::none;
  EXPECT_TRUE(std::isnan(score())) << "hidden or out of view: nothing is known";
  seen({0, 0}, 0.0f);
  EXPECT_NEAR(score(), 0.7f * -2.5f, kRounding);
}

// Four nats for a view that saw through the feature's place, eight for two and more, on top of what frames say.
TEST_F(ReprojectionScoreTest, WhatCameWhereSpaceWasFreeMoves) {
  const float plain = evidence({2, 0}, 0.0f);
  for (const auto& [views, nats] : {std::pair(1, 4.0f), std::pair(2, 8.0f), std::pair(5, 8.0f)}) {
    matches_.past_observations.views_through[0] = static_cast<std::uint8_t>(views);
    EXPECT_NEAR(score(), plain + nats, kRounding) << views;
    for (OlderFrame& frame : matches_.past_observations.frames()) frame.of_feature[0].state = ObservationState::none;
    EXPECT_NEAR(score(), nats, kRounding) << "it needs no match";
    for (OlderFrame& frame : matches_.past_observations.frames()) frame.of_feature[0].state = ObservationState::seen;
  }
}

// The older camera stood 0.1 m to the left: the point is seen 25 px to the right there.
TEST_F(ReprojectionScoreTest, ObservationsAreComparedWhereTheMotionPutsThem) {
  for (int i = 0; i < 2; ++i) {
    seen({25, 0}, 0.0f);
    matches_.past_observations.frames()[static_cast<std::size_t>(i)].reference_from_current.translation().x() = 0.1;
  }
  EXPECT_NEAR(score(), -2.5f, kRounding);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::is_same_v<SightingScore, ReprojectionScore>, "the name of 0.1");
#pragma GCC diagnostic pop

}  // namespace
}  // namespace stillpoint::reprojection_score_test
