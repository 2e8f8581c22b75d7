// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/verdict/weights.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "unit/verdict/told_result.hpp"

namespace stillpoint::weights_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

using told_result::label;
class Weights : public told_result::ToldResult {};

TEST_F(Weights, WeightIsOneMinusTheProbabilityOfMoving) {
  const FrameResult& result = judge({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}},
                                    {label(true, 0.25f), label(false, 0.75f), label(true, 0.0f), label(false, 1.0f),
                                     label(true, 0.875f)});  // the last as the keep-floor leaves it
  std::vector<float> found;
  weights(result, found);
  EXPECT_EQ(found, (std::vector<float>{0.75f, 0.25f, 1.0f, 0.0f, 0.125f}));
}

TEST_F(Weights, WithoutAProbabilityWhatIsKeptWeighsOneAndWhatIsDroppedNothing) {
  std::vector<float> found;
  weights(judge({{0, 0}, {1, 1}}, {label(true, kNaN), label(false, kNaN)}), found);
  EXPECT_EQ(found, (std::vector<float>{1.0f, 0.0f}));
}

// 0.75 · 0.5 at a static prior of one half; a prior near 0 counts as 0.35. A dynamic feature has no weight.
TEST_F(Weights, WhatMovedOnceWeighsLess) {
  std::vector<Label> labels = {label(true, 0.25f), label(true, 0.25f), label(true, kNaN), label(false, kNaN)};
  labels[0].static_prior = 0.5f;
  for (std::size_t i = 1; i < labels.size(); ++i) labels[i].static_prior = 0.01f;
  std::vector<float> found;
  weights(judge({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, labels), found);
  EXPECT_EQ(found, (std::vector<float>{0.375f, 0.75f * 0.35f, 0.35f, 0.0f}));
}

TEST_F(Weights, AFrameThatWasNotJudgedWeighsOneEverywhere) {
  std::vector<float> found(7, 0.5f);
  weights(filter.filter_frame(FrameView(gray, DepthView(), 1.0), std::vector<Vector2f>{{0, 0}, {1, 1}}), found);
  EXPECT_EQ(found, (std::vector<float>{1.0f, 1.0f})) << "one entry per feature, whatever was there before";
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::is_same_v<decltype(std::declval<const FrameResult&>().verdict(0)), const Label&>,
              "label(i) was verdict(i) in 0.1");
#pragma GCC diagnostic pop

}  // namespace
}  // namespace stillpoint::weights_test
