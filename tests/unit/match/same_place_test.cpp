// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/same_place.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace stillpoint::same_place_test {
namespace {

constexpr float kCell_px = 32;

struct Feature {
  Vector2f pixel;
  double depth_m;
};

/// For each feature the one that it shares its place with, itself where there is none. Depths are known to 0.01 m.
std::vector<std::size_t> shared(const std::vector<Feature>& features) {
  FrameFeatures table;
  table.resize(features.size());
  SamePlace same_place(kCell_px);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < features.size(); ++i) {
    table.pixel[i] = features[i].pixel;
    table.depth_m[i] = features[i].depth_m;
    if (features[i].depth_m > 0) table.depth_sigma_m[i] = 0.01;
    result.push_back(same_place.find(table, i));
  }
  return result;
}

using Indices = std::vector<std::size_t>;

TEST(SamePlace, IsWithinAPixelOfTheFirst) {
  EXPECT_EQ(shared({{{8, 8}, 2}, {{8.9f, 7.2f}, 2}, {{9, 9}, 2}, {{9.1f, 8}, 2}}), (Indices{0, 0, 0, 3}));
}

// The third is within a pixel of the second, which shares the place of the first: patches must not be handed on.
TEST(SamePlace, IsNotHandedOn) { EXPECT_EQ(shared({{{8, 8}, 2}, {{9, 8}, 2}, {{10, 8}, 2}}), (Indices{0, 0, 2})); }

TEST(SamePlace, IsOnOneSurface) {
  EXPECT_EQ(shared({{{8, 8}, 2}, {{8, 8}, 2.009}, {{8, 8}, 2.011}, {{8, 8}, 1.5}}), (Indices{0, 0, 2, 3}));
  EXPECT_EQ(shared({{{8, 8}, 2}, {{8, 8}, 0}, {{8, 8}, 0}}), (Indices{0, 1, 1})) << "without depth by itself";
}

TEST(SamePlace, IsForgottenWithItsCell) {
  EXPECT_EQ(shared({{{31.5f, 8}, 2}, {{32.5f, 8}, 2}, {{31.5f, 8}, 2}}), (Indices{0, 1, 2}));
}

// A sanitizer names a number of a cell that fits no integer.
TEST(SamePlace, MayBeFarOutsideTheImage) {
  EXPECT_EQ(shared({{{1e30f, -5}, 2}, {{1e30f, -5.5f}, 2}, {{-1e30f, 3e38f}, 2}, {{1e30f, -5}, 2}}),
            (Indices{0, 0, 2, 3}));
}

// A cell full of corners: those beyond the 64th are each looked for, the first ones are still known.
TEST(SamePlace, AFullCellIsNoError) {
  std::vector<Feature> features;
  for (int k = 0; k < 100; ++k)
    features.push_back({{static_cast<float>(3 * (k % 10)), static_cast<float>(3 * (k / 10))}, 2});
  features.push_back({{0, 0}, 2});
  const Indices found = shared(features);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(found[i], i);
  EXPECT_EQ(found[100], 0u);
}

}  // namespace
}  // namespace stillpoint::same_place_test
