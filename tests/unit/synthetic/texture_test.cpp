// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stillpoint::synthetic {
namespace {

constexpr int kSize = 64;
constexpr double kTexelsPerMetre = 64;  // the tile is 1 m
constexpr float kTexel = 1.0f / 64;

Texture texture(std::uint64_t seed) {
  TextureStyle style;
  style.ground = Ground::tiles;
  style.smallest_mark_m = 0.05;
  return Texture(kSize, kTexelsPerMetre, style, seed);
}

TEST(Texture, RefusesImpossibleArguments) {
  EXPECT_THROW(Texture(100, 10, {}, 1), Error);
  EXPECT_THROW(Texture(64, 0, {}, 1), Error);
  TextureStyle colourless;
  colourless.colours.clear();
  EXPECT_THROW(Texture(64, 10, colourless, 1), Error);
}

TEST(Texture, IsEqualForEqualSeedsAndDiffersForOthers) {
  const Texture first = texture(3), again = texture(3), other = texture(4);
  int differences = 0;
  for (float x = 0; x < 1; x += 0.03f) {
    EXPECT_EQ(first.sampler(0.5f)(x, 0.4f).red, again.sampler(0.5f)(x, 0.4f).red);
    differences += first.sampler(0.5f)(x, 0.4f).red != other.sampler(0.5f)(x, 0.4f).red;
  }
  EXPECT_GT(differences, 10);
}

// Sums of all texels as g++ drew them. Where two random numbers are drawn in the arguments of one call, their order is
// the compiler's: with clang++ the sums were 617734 and 595087.
TEST(Texture, IsTheSameWithEveryCompiler) {
  const auto sum_of = [](const Texture& tile) {
    double sum = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        sum += static_cast<double>(
            tile.sampler(0)((static_cast<float>(x) + 0.5f) * kTexel, (static_cast<float>(y) + 0.5f) * kTexel).red);
    return sum;
  };
  EXPECT_NEAR(sum_of(texture(3)), 638449, 100);
  EXPECT_NEAR(sum_of(texture(4)), 590162, 100);
}

TEST(Texture, RepeatsWithoutASeam) {
  const Texture tile = texture(5);
  for (float y = 0.1f; y < 1; y += 0.07f)
    for (const float level : {0.0f, 1.5f, 3.0f}) {
      EXPECT_FLOAT_EQ(tile.sampler(level)(0.25f, y).green, tile.sampler(level)(1.25f, y).green);
      EXPECT_NEAR(tile.sampler(level)(0.999f, y).green, tile.sampler(level)(1.001f, y).green, 0.15f * 256);
    }
}

TEST(Texture, IsLinearBetweenTexelCentres) {
  const Texture tile = texture(6);
  for (int x = 3; x < 40; ++x) {
    const float centre = (static_cast<float>(x) + 0.5f) * kTexel, row = 20.5f * kTexel;
    const float here = tile.sampler(0)(centre, row).blue, next = tile.sampler(0)(centre + kTexel, row).blue;
    EXPECT_NEAR(tile.sampler(0)(centre + 0.25f * kTexel, row).blue, 0.75f * here + 0.25f * next, 1e-3f);
    // Half way between two levels: their mean.
    EXPECT_NEAR(tile.sampler(1.5f)(centre, row).blue,
                0.5f * (tile.sampler(1)(centre, row).blue + tile.sampler(2)(centre, row).blue), 1e-3f);
  }
}

TEST(Texture, LevelsAreMeansOfTheirTexels) {
  // Level 2: the texel that covers 4 × 4 of the finest. Every halving rounds by at most half a grey level.
  const Texture tile = texture(7);
  float sum = 0;
  for (int y = 8; y < 12; ++y)
    for (int x = 16; x < 20; ++x)
      sum += tile.sampler(0)((static_cast<float>(x) + 0.5f) * kTexel, (static_cast<float>(y) + 0.5f) * kTexel).red;
  EXPECT_NEAR(tile.sampler(2)(18.0f * kTexel, 10.0f * kTexel).red, sum / 16, 1.0f);
}

}  // namespace
}  // namespace stillpoint::synthetic
