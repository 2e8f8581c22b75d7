// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/gate/tail_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint {
namespace {

static_assert(is_gate<TailGate>::value);

TailGate gate(double rate) {
  TailGate gate;
  gate.options.false_positive_rate = rate;
  return gate;
}

double level(double rate) {
  Workspace workspace;
  return gate(rate).threshold({}, Regions{}, workspace).level;
}

// 2.3 − 0.8 ln(rate / 0.01): ln 5 = 1.609438, ln 0.1 = −2.302585.
TEST(TailGate, LevelIsThatOfTheWantedRate) {
  EXPECT_NEAR(level(0.01), 2.3, 1e-12);
  EXPECT_NEAR(level(0.05), 1.012450, 1e-6);
  EXPECT_NEAR(level(0.001), 4.142068, 1e-6);
}

// Scores drawn from the tail that the gate assumes: the share above its level is the wanted one. 4 standard deviations
// of a share of 200 000 draws: 4 √(p (1 − p) / n).
TEST(TailGate, HoldsTheRateOnItsOwnModel) {
  constexpr int kDraws = 200000;
  for (const double rate : {0.01, 0.005, 0.001}) {
    Random random(1);
    const double limit = level(rate);
    int above = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double tail = 1.0 - random.uniform();  // P(score > s)
      above += 2.3 - 0.8 * std::log(tail / 0.01) > limit;
    }
    EXPECT_NEAR(above / double{kDraws}, rate, 4.0 * std::sqrt(rate * (1 - rate) / kDraws)) << rate;
  }
}

TEST(TailGate, DoesNotLookAtTheScores) {
  std::vector<FeatureScore> scores(5);
  scores[0].value = 1e6f;
  Workspace workspace;
  EXPECT_EQ(gate(0.01).threshold(scores, Regions{}, workspace).level, level(0.01))
      << "a view full of movers must not raise its own threshold";
}

// What a frame of features looks like to a gate that learns.
struct Frame {
  Observations observations;
  std::vector<Label> labels;

  /// @param exceeding  of the features that stood until now
  Frame(std::size_t known, std::size_t exceeding) : labels(known) {
    observations.matches.begin(std::vector<Vector2f>(known, Vector2f(1, 1)));
    observations.remembered.begin(observations.matches);
    for (std::size_t i = 0; i < known; ++i) {
      observations.remembered.log_odds[i] = -3.0f;
      labels[i].log_odds = i < exceeding ? 0.5f : -1.0f;
    }
  }
};

// One step is gain × (min(share / rate, most) − 1): 2 of 100 at a rate of 1 % are twice the rate, 0.01 × 1; ten are as
// many as the bound of two allows.
TEST(TailGate, RisesWhereMoreThanTheRateOfWhatStandsExceeds) {
  TailGate learner = gate(0.01);
  const Frame twice(100, 2), often(100, 10);
  learner.learn(twice.observations, twice.labels);
  EXPECT_NEAR(learner.raised(), 0.01, 1e-12);
  learner.learn(often.observations, often.labels);
  EXPECT_NEAR(learner.raised(), 0.02, 1e-12);
  Workspace workspace;
  EXPECT_NEAR(learner.threshold({}, Regions{}, workspace).level, 2.32, 1e-12);
  learner.reset();
  EXPECT_EQ(learner.threshold({}, Regions{}, workspace).level, 2.3);
}

TEST(TailGate, SinksBackToThePriorAndNoLower) {
  TailGate learner = gate(0.01);
  const Frame loud(100, 50), quiet(100, 0);
  for (int i = 0; i < 1000; ++i) learner.learn(loud.observations, loud.labels);
  EXPECT_EQ(learner.raised(), 3.0) << "nats";
  learner.learn(quiet.observations, quiet.labels);
  EXPECT_NEAR(learner.raised(), 3.0 - 0.01, 1e-12);
  for (int i = 0; i < 1000; ++i) learner.learn(quiet.observations, quiet.labels);
  EXPECT_EQ(learner.raised(), 0.0);
}

TEST(TailGate, LearnsOnlyFromWhatIsKnownToStand) {
  TailGate learner = gate(0.01);
  Frame moving(100, 100), moved_before(100, 100), corners(100, 100);
  Frame few(49, 40);  // 50 are needed
  for (float& log_odds : moving.observations.remembered.log_odds) log_odds = -1.0f;
  for (float& prior : moved_before.observations.remembered.static_prior) prior = 0.9f;
  corners.observations.matches.host_count = 0;  // the matcher's own
  for (Frame* frame : {&moving, &moved_before, &corners, &few}) learner.learn(frame->observations, frame->labels);
  EXPECT_EQ(learner.raised(), 0.0);
}

// A world whose tail is longer than the prior's: evidence of a static feature exceeds the level with the probability
// P(level) = exp(−(level − 2.3) / 0.8) × 5 %. It is the rate of 1 % where the level is 2.3 + 0.8 ln 5 = 3.59. The
// tolerance is four standard deviations of what is measured at the end, 100 frames of 300 features, in nats: 0.8 /
// √300.
TEST(TailGate, FindsTheLevelOfALongerTail) {
  TailGate learner = gate(0.01);
  Random random(3);
  double sum = 0;
  for (int f = 0; f < 1500; ++f) {
    std::size_t exceeding = 0;
    const double probability = 0.05 * std::exp(-learner.raised() / 0.8);
    for (int i = 0; i < 300; ++i) exceeding += random.uniform() < probability;
    const Frame frame(300, exceeding);
    learner.learn(frame.observations, frame.labels);
    if (f >= 1400) sum += learner.raised() / 100;
  }
  EXPECT_NEAR(sum, 0.8 * std::log(5.0), 4 * 0.8 / std::sqrt(300.0));
}

}  // namespace
}  // namespace stillpoint
