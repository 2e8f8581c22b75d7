// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Support is by area: of the host's matches in one cell, one speaks.

#include "stillpoint/motion/rigid/area_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint::area_support_test {
namespace {

/// Three matches in the cell of 24 px at the origin, of which the last has depths, one in the cell beside it, and one
/// near the border.
Matches some_matches() {
  Matches matches;
  matches.begin(std::vector<Vector2f>{{3, 4}, {20, 10}, {10, 20}, {30, 10}, {60, 60}});
  matches.host_supports = true;
  std::fill(matches.state.begin(), matches.state.end(), MatchState::matched);
  matches.state[4] = MatchState::near_edge;
  for (FrameFeatures* features : {&matches.current, &matches.reference}) {
    features->depth_m.assign(5, 0.0);
    features->depth_m[2] = 2.0;
  }
  return matches;
}

std::vector<int> speaking(const Matches& matches, float cell_px) {
  Workspace workspace;
  const span<const std::uint8_t> flags = area_support(matches, cell_px, workspace);
  return {flags.begin(), flags.end()};
}

TEST(AreaSupport, OneMatchOfACellSpeaksRatherOneWithDepths) {
  EXPECT_EQ(speaking(some_matches(), 24.0f), (std::vector<int>{0, 0, 1, 1, 0}));
}

TEST(AreaSupport, WithoutDepthsTheFirstSpeaks) {
  Matches matches = some_matches();
  matches.current.depth_m[2] = 0.0;
  EXPECT_EQ(speaking(matches, 24.0f), (std::vector<int>{1, 0, 0, 1, 0}));
}

TEST(AreaSupport, SpreadCornersAllSpeak) {
  Matches matches = some_matches();
  matches.host_supports = false;
  EXPECT_EQ(speaking(matches, 24.0f), (std::vector<int>{1, 1, 1, 1, 1}));
}

// 60 px in cells of a millionth of a pixel would be 3.6e15 cells.
TEST(AreaSupport, CellsBelowOnePixelAreNone) {
  for (const float cell_px : {0.0f, 1e-6f, 0.5f, -1.0f})
    EXPECT_EQ(speaking(some_matches(), cell_px), (std::vector<int>{1, 1, 1, 1, 1})) << cell_px;
}

}  // namespace
}  // namespace stillpoint::area_support_test
