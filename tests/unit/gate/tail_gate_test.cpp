// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/gate/tail_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stillpoint/core/policy_traits.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

static_assert(is_gate<TailGate>::value);

TailGate gate(double rate) {
  TailGate gate;
  gate.options.false_positive_rate = rate;
  gate.options.level_of_one_percent = 4.0;
  gate.options.decay = 1.3;
  return gate;
}

double level(double rate) {
  Workspace workspace;
  return gate(rate).threshold({}, Regions{}, workspace).level;
}

// 4 − 1.3 ln(rate / 0.01): ln 5 = 1.609438, ln 0.1 = −2.302585.
TEST(TailGate, LevelIsThatOfTheWantedRate) {
  EXPECT_NEAR(level(0.01), 4.0, 1e-12);
  EXPECT_NEAR(level(0.05), 1.907731, 1e-6);
  EXPECT_NEAR(level(0.001), 6.993361, 1e-6);
}

TEST(TailGate, RatesAreHeldWithinSense) {
  EXPECT_EQ(level(0.0), level(1e-6));
  EXPECT_EQ(level(-1.0), level(1e-6));
  EXPECT_EQ(level(1.0), level(0.5));
  EXPECT_TRUE(std::isfinite(level(0.0)));
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
      above += 4.0 - 1.3 * std::log(tail / 0.01) > limit;
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

}  // namespace
}  // namespace stillpoint
