// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/hidden_before.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace stillpoint::hidden_before_test {
namespace {

Observation shown(float dissimilarity, float offset_px) {
  Observation observation;
  observation.state = ObservationState::seen;
  observation.dissimilarity = dissimilarity;
  observation.offset_px = offset_px;
  return observation;
}

const Observation kStands = shown(0.05f, 0.2f), kMoved = shown(0.05f, 2.0f), kUnlike = shown(0.8f, 1.0f);

using ShowsNearer = std::array<bool, 3>;

/// Which of three frames, the last one first, are occluded after the rule.
std::vector<bool> hidden(const std::vector<Observation>& observations, const ShowsNearer& shows_nearer) {
  std::vector<OlderFrame> frames(observations.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].of_feature = {Observation{}, observations[f]};
    frames[f].of_feature[1].shows_nearer = shows_nearer[f];
  }
  forget_where_hidden(1, {frames.data(), frames.size()});
  std::vector<bool> result;
  for (const OlderFrame& frame : frames) {
    const bool is_hidden = frame.of_feature[1].state == ObservationState::occluded;
    EXPECT_TRUE(!is_hidden || std::isnan(frame.of_feature[1].dissimilarity));
    result.push_back(is_hidden);
  }
  return result;
}

using Flags = std::vector<bool>;
constexpr ShowsNearer kNearer{true, true, true};

TEST(HiddenBefore, WhatTheLastFrameShowsInItsPlaceWasHiddenByWhatWasNearer) {
  EXPECT_EQ(hidden({kStands, kUnlike, kUnlike}, kNearer), (Flags{false, true, true}));
  EXPECT_EQ(hidden({kStands, kStands, kUnlike}, kNearer), (Flags{false, false, true}));
}

TEST(HiddenBefore, WhatTheLastFrameShowsElsewhereMoves) {
  EXPECT_EQ(hidden({kMoved, kUnlike, kUnlike}, kNearer), (Flags{false, false, false}));
  EXPECT_EQ(hidden({kUnlike, kUnlike, kUnlike}, kNearer), (Flags{false, false, false}));
}

// It moves slowly: the last frame is too near in time to show it, the oldest too far to find it.
TEST(HiddenBefore, WhatAFrameBetweenShowsElsewhereMoves) {
  EXPECT_EQ(hidden({kStands, kMoved, kUnlike}, kNearer), (Flags{false, false, false}));
}

TEST(HiddenBefore, WhatIsNoNearerHidesNothing) {
  EXPECT_EQ(hidden({kStands, kUnlike, kUnlike}, {true, false, true}), (Flags{false, false, false}));
  EXPECT_EQ(hidden({kStands, kUnlike, kUnlike}, {true, true, false}), (Flags{false, true, false}));
}

TEST(HiddenBefore, WhatLooksAlikeIsNoOtherSurface) {
  EXPECT_EQ(hidden({kStands, shown(0.2f, 1.0f), kStands}, kNearer), (Flags{false, false, false}));
}

TEST(HiddenBefore, AFrameThatSawNothingChangesNothing) {
  EXPECT_EQ(hidden({kStands, Observation{}, kUnlike}, kNearer)[2], true);
  EXPECT_TRUE(hidden({}, kNearer).empty());
}

}  // namespace
}  // namespace stillpoint::hidden_before_test
