// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/score/sampson_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint {
namespace {

static_assert(is_scorer<SampsonScore, Camera>::value);

/// A camera that went one unit to the left: what stands goes to the right along its row, by f / z pixels.
class SampsonScoreTest : public testing::Test {
 protected:
  SampsonScoreTest() {
    motion.status = Status::ok;
    motion.metric = false;
    motion.current_from_reference.translation() = Vector3d(1, 0, 0);
    for (int i = 0; i < 30; ++i) add({100.0 + 10 * i, 50.0 + 13 * i}, {10, 0});  // what stands, 50 units away
  }

  std::size_t add(const Vector2d& from, const Vector2d& step, float static_prior = 1.0f) {
    const std::size_t i = matches.size();
    matches.resize(i + 1);
    matches.state[i] = MatchState::matched;
    matches.reference.undistorted[i] = from;
    matches.current.undistorted[i] = from + step;
    matches.space_static_prior[i] = static_prior;
    return i;
  }
  float score_of(std::size_t i) {
    std::vector<FeatureScore> scores(matches.size());
    scorer.score(test::observations_of(matches), motion, camera, scores);
    return scores[i].value;
  }

  Camera camera{500, 500, 319.5, 239.5, 640, 480};
  SampsonScore scorer;  // the least noise is 0.5 px, and here it is less
  Motion motion;
  Matches matches;
};

TEST_F(SampsonScoreTest, WhatStandsScoresBelowZero) {
  EXPECT_NEAR(score_of(0), -0.5, 1e-6);
  EXPECT_NEAR(score_of(29), -0.5, 1e-6);
}

// A pixel across the line is shared by both ends: 1 / √2. Half of its square over 0.5² is 1, less 0.5.
TEST_F(SampsonScoreTest, PixelAcrossTheLineIsSharedByBothEnds) {
  EXPECT_NEAR(score_of(add({300, 200}, {10, 1})), 0.5, 1e-4);
}

// Two pixels to the left are an inverse depth of −2 / f; its deviation is √2 · 0.5 px / f. Half of (2 / 0.7071)² is 4.
TEST_F(SampsonScoreTest, WhatGoesBeyondInfinityIsBehindTheCamera) {
  EXPECT_NEAR(score_of(add({300, 239.5}, {-2, 0})), 3.5, 1e-4);
  EXPECT_NEAR(score_of(add({300, 200}, {0, 0})), -0.5, 1e-6) << "at infinity";
}

TEST_F(SampsonScoreTest, WhatGoesAlongItsLineLooksLikeSomethingNear) {
  EXPECT_NEAR(score_of(add({300, 200}, {60, 0})), -0.5, 1e-6);
}

TEST_F(SampsonScoreTest, EvidenceOfOneFrameSaturates) { EXPECT_EQ(score_of(add({300, 200}, {10, 300})), 7.5f); }

// A deviation of 0.01 rad about z turns the point 100 px right of the middle by 1 px across its line; of 1 / √2 of
// that, the distance that both ends share: variance 0.25 + 0.5. Half of 0.5 / 0.75 is a third.
TEST_F(SampsonScoreTest, MotionThatIsNotSureMakesLessOfIt) {
  motion.covariance(2, 2) = 1e-4;
  EXPECT_NEAR(score_of(add({409.5, 239.5}, {10, 1})), 1.0 / 3.0 - 0.5, 0.02);
}

// Where the camera turned only, a pixel may be parallax: of two one is left, half of (1 / 0.5)² is 2.
TEST_F(SampsonScoreTest, AfterATurnAPointIsExpectedWhereItTakesIt) {
  for (std::size_t i = 0; i < matches.size(); ++i) matches.current.undistorted[i] = matches.reference.undistorted[i];
  motion.warnings = Warning::rotation_only;
  motion.current_from_reference.translation().setZero();
  EXPECT_NEAR(score_of(add({300, 200}, {0, 2})), 1.5, 1e-4);
  EXPECT_NEAR(score_of(add({300, 200}, {0.5, 0.5})), -0.5, 1e-6);
}

TEST_F(SampsonScoreTest, NothingIsScoredWhereTheMotionDoesNotExplainTheFrame) {
  for (std::size_t i = 0; i < matches.size(); ++i) matches.current.undistorted[i].y() += i % 2 == 0 ? 5.0 : -5.0;
  EXPECT_TRUE(std::isnan(score_of(0)));
}

TEST_F(SampsonScoreTest, ALowStaticPriorDoesNotSayHowNoisyTheFrameIs) {
  for (int i = 0; i < 100; ++i) add({300, 200}, {10, 20}, 0.1f);
  EXPECT_NEAR(score_of(0), -0.5, 1e-6);
}

TEST_F(SampsonScoreTest, TooFewMatchesAndUnmatchedFeaturesAreNotScored) {
  matches.state[3] = MatchState::lost;
  EXPECT_TRUE(std::isnan(score_of(3)));
  EXPECT_FALSE(std::isnan(score_of(4)));
  for (std::size_t i = 19; i < matches.size(); ++i) matches.state[i] = MatchState::lost;
  EXPECT_TRUE(std::isnan(score_of(4)));
}

// With noise of 0.7 px, measured, static points score −0.5 + E[½ min(χ²₁, …)] = 0 on average.
TEST_F(SampsonScoreTest, NoiseIsMeasured) {
  Random random(3);
  for (int i = 0; i < 3000; ++i)
    add({random.uniform(50, 550), random.uniform(50, 400)},
        {10.0 + random.gaussian(), std::sqrt(2.0) * 0.7 * random.gaussian()});
  std::vector<FeatureScore> scores(matches.size());
  scorer.score(test::observations_of(matches), motion, camera, scores);
  double sum = 0;
  for (std::size_t i = 30; i < scores.size(); ++i) sum += static_cast<double>(scores[i].value);
  EXPECT_NEAR(sum / 3000, 0.0, 0.05);
}

}  // namespace
}  // namespace stillpoint
