// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/static_weights.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>
#include <vector>

#include "unit/observations_of.hpp"

namespace stillpoint::static_weights_test {
namespace {

// Cells of 24 px. In the first lie two features, one of them dropped: half stood still. In the second one is kept, in
// the third none is.
TEST(StaticWeights, IsTheShareOfWhatStoodStill) {
  Matches matches;
  matches.begin(std::vector<Vector2f>{{3, 3}, {20, 20}, {30, 10}});
  std::vector<Label> labels(3);
  labels[1].keep = false;
  StaticWeights weights;
  weights.assign(test::observations_of(matches), labels, 96, 48);
  EXPECT_FLOAT_EQ(weights.at({12, 12}), 0.5f);
  EXPECT_FLOAT_EQ(weights.at({40, 20}), 1.0f);
  EXPECT_FLOAT_EQ(weights.at({60, 20}), 1.0f) << "nothing is known there";
}

// Twice the focal length: cells of 48 px, as corners are twice as far apart. Half the focal length: as they are.
TEST(StaticWeights, CellsGrowWithTheFocalLength) {
  Matches matches;
  matches.begin(std::vector<Vector2f>{{3, 3}});
  std::vector<Label> labels(1);
  labels[0].keep = false;
  StaticWeights weights;
  for (const auto& [scale, inside, outside] : {std::tuple(2.0f, 47.0f, 49.0f), std::tuple(0.5f, 23.0f, 25.0f)}) {
    matches.pixel_scale = scale;
    weights.assign(test::observations_of(matches), labels, 192, 96);
    EXPECT_EQ(weights.at({inside, 3}), 0.0f);
    EXPECT_EQ(weights.at({outside, 3}), 1.0f);
  }
}

// (1 feature · prior 1 + 1/2 of a surface · prior 0.05) / (1 + 1/2). Alone, the surface's prior is all that is known.
TEST(StaticWeights, ASurfaceHasHalfOfAFeaturesVote) {
  Matches matches;
  matches.begin(std::vector<Vector2f>{{3, 3}});
  SurfaceCell beside_feature, alone;
  beside_feature.pixel = {12, 12};
  alone.pixel = {36, 12};
  beside_feature.space_static_prior = alone.space_static_prior = 0.05f;
  matches.past_observations.surfaces = {beside_feature, alone};
  StaticWeights weights;
  weights.assign(test::observations_of(matches), std::vector<Label>(1), 96, 48);
  EXPECT_FLOAT_EQ(weights.at({12, 12}), 1.025f / 1.5f);
  EXPECT_FLOAT_EQ(weights.at({36, 12}), 0.05f);
}

TEST(StaticWeights, KnowsNothingOutsideOrBeforeTheFirstFrame) {
  StaticWeights weights;
  EXPECT_EQ(weights.at({12, 12}), 1.0f);
  Matches matches;
  matches.begin(std::vector<Vector2f>{{3, 3}});
  std::vector<Label> labels(1);
  labels[0].keep = false;
  weights.assign(test::observations_of(matches), labels, 96, 48);
  EXPECT_EQ(weights.at({3, 3}), 0.0f);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (const Vector2f& outside : {Vector2f(-1, 3), Vector2f(3, 50), Vector2f(1e30f, 3), Vector2f(kNaN, kNaN)})
    EXPECT_EQ(weights.at(outside), 1.0f);
  weights.clear();
  EXPECT_EQ(weights.at({3, 3}), 1.0f);
}

}  // namespace
}  // namespace stillpoint::static_weights_test
