// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace stillpoint {
namespace {

// χ² stays below mean + 5 standard deviations of its distribution in all but about one of 10⁵ seeds; the seeds are
// fixed, so that the tests don't flicker.
double chi_squared_limit(std::size_t cells) {
  const auto degrees = static_cast<double>(cells - 1);
  return degrees + 5.0 * std::sqrt(2.0 * degrees);
}

template <class Counts>
double chi_squared(const Counts& counts, double expected) {
  double sum = 0;
  for (const auto count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// Computed with an implementation of SplitMix64 and xoshiro256** in Python whose generator gives the authors' sequence
// 11520, 0, 1509978240, 1215971899390074240 from the state {1, 2, 3, 4}.
TEST(Random, GivesThePublishedGeneratorsSequence) {
  struct Golden {
    std::uint64_t seed;
    std::array<std::uint64_t, 4> bits;
  };
  const Golden cases[] = {
      {0, {0x99ec5f36cb75f2b4, 0xbf6e1f784956452a, 0x1a5f849d4933e6e0, 0x6aa594f1262d2d2c}},
      {1, {0xb3f2af6d0fc710c5, 0x853b559647364cea, 0x92f89756082a4514, 0x642e1c7bc266a3a7}},
      {42, {0x15780b2e0c2ec716, 0x6104d9866d113a7e, 0xae17533239e499a1, 0xecb8ad4703b360a1}},
      {Random::kDefaultSeed, {0xdc7f8f06f3fd55b5, 0xcdfb638ab88332ff, 0xb1f31f1becdea3dd, 0x1239ce7019db05f6}}};
  for (const Golden& golden : cases) {
    Random random(golden.seed);
    for (const std::uint64_t expected : golden.bits) EXPECT_EQ(random.bits(), expected) << "seed " << golden.seed;
  }
}

TEST(Random, EqualSeedsGiveEqualSequencesAndCopiesFork) {
  Random a(7), b(7), other(8);
  bool all_equal_to_other = true;
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t bits = a.bits();
    ASSERT_EQ(bits, b.bits());
    all_equal_to_other = all_equal_to_other && bits == other.bits();
  }
  EXPECT_FALSE(all_equal_to_other);
  Random copy = a;
  EXPECT_EQ(copy.bits(), a.bits());
}

TEST(Random, UniformIsTheTop53BitsOfADraw) {
  // Seed 0: 0x99ec5f36cb75f2b4 >> 11 = 0x133d8be6d96ebe, times 2⁻⁵³.
  EXPECT_EQ(Random(0).uniform(), static_cast<double>(0x133d8be6d96ebeu) * 0x1.0p-53);
  EXPECT_EQ(Random(0).uniform(-2.0, 6.0), -2.0 + 8.0 * Random(0).uniform());
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double draw = random.uniform();
    ASSERT_GE(draw, 0.0);
    ASSERT_LT(draw, 1.0);
  }
}

TEST(Random, IndexIsUniformOverItsBound) {
  for (const std::size_t bound : {1u, 2u, 3u, 7u, 10u, 64u, 1000u}) {
    Random random(bound);
    std::vector<double> counts(bound, 0.0);
    const std::size_t draws = 200 * bound + 2000;
    for (std::size_t i = 0; i < draws; ++i) {
      const std::size_t index = random.index(bound);
      ASSERT_LT(index, bound);
      ++counts[index];
    }
    const double expected = static_cast<double>(draws) / static_cast<double>(bound);
    EXPECT_LE(chi_squared(counts, expected), chi_squared_limit(bound)) << "bound " << bound;
  }
}

// With bound = 3 · 2⁶², plain `bits() % bound` would give values below 2⁶² twice as often as others: half of all draws
// instead of a third.
TEST(Random, IndexHasNoModuloBias) {
  constexpr std::uint64_t bound = std::uint64_t{3} << 62;
  Random random(11);
  std::array<double, 3> thirds{};
  constexpr int draws = 30000;
  for (int i = 0; i < draws; ++i) ++thirds[random.index(bound) >> 62];
  EXPECT_LE(chi_squared(thirds, draws / 3.0), chi_squared_limit(3));
}

// All 10 subsets of 3 out of 5, all 15 of 2 out of 6, all 4 of 3 out of 4.
TEST(Random, DistinctDrawsEverySubsetEquallyOften) {
  struct Case {
    std::size_t k, population, subsets;
  };
  for (const Case c : {Case{3, 5, 10}, Case{2, 6, 15}, Case{3, 4, 4}}) {
    Random random(17);
    std::map<unsigned, double> count_of_subset;
    const int draws = 1000 * static_cast<int>(c.subsets);
    std::vector<std::size_t> sample(c.k);
    for (int i = 0; i < draws; ++i) {
      random.distinct(sample, c.population);
      unsigned subset = 0;
      for (const std::size_t member : sample) {
        ASSERT_LT(member, c.population);
        ASSERT_EQ(subset >> member & 1u, 0u) << "an index was drawn twice";
        subset |= 1u << member;
      }
      ++count_of_subset[subset];
    }
    ASSERT_EQ(count_of_subset.size(), c.subsets);
    std::vector<double> counts;
    for (const auto& [subset, count] : count_of_subset) counts.push_back(count);
    EXPECT_LE(chi_squared(counts, 1000.0), chi_squared_limit(c.subsets)) << c.k << " of " << c.population;
  }
}

TEST(Random, DistinctOfAllIsAPermutationAndOfNoneIsNothing) {
  Random random(5);
  std::array<std::size_t, 8> all{};
  random.distinct(all, 8);
  unsigned seen = 0;
  for (const std::size_t index : all) seen |= 1u << index;
  EXPECT_EQ(seen, 0xffu);
  random.distinct(span<std::size_t>(), 8);
  random.distinct(span<std::size_t>(), 0);
}

TEST(Random, GaussianHasTheMomentsOfTheNormalDistribution) {
  Random random(23);
  constexpr int draws = 200000;
  double sum = 0, squares = 0, cubes = 0, fourths = 0;
  int beyond_two = 0;
  for (int i = 0; i < draws; ++i) {
    const double g = random.gaussian();
    ASSERT_TRUE(std::isfinite(g));
    sum += g;
    squares += g * g;
    cubes += g * g * g;
    fourths += g * g * g * g;
    beyond_two += std::abs(g) > 2.0;
  }
  // Standard errors of the four moments: sqrt(1, 2, 15, 96 / draws); five of them each.
  const double n = draws;
  EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(cubes / n, 0.0, 5.0 * std::sqrt(15.0 / n));
  EXPECT_NEAR(fourths / n, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(beyond_two / n, 0.0455, 5.0 * std::sqrt(0.0455 * 0.9545 / n));  // 2 (1 − Φ(2))
}

}  // namespace
}  // namespace stillpoint
