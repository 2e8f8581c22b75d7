// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/candidates.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion_scene.hpp"

namespace stillpoint {
namespace {

TEST(Candidates, FollowTheRuleOfThePaper) {
  Random random(1);
  Matches matches = test::make_matches(Pose::Identity(), {12}, random);
  Regions regions;
  regions.of_feature.assign(12, Membership{});
  matches.state[0] = MatchState::near_edge;
  regions.of_feature[1].edge_distance_px = 4.0f;
  regions.of_feature[2].in_dynamic = true;
  regions.of_feature[3].in_dynamic = regions.of_feature[3].in_fixed = true;
  Workspace workspace;
  const auto any = [](std::size_t) { return true; };
  const auto chosen = [&] {
    const auto found = select_candidates(matches, regions, {}, workspace, any);
    return std::vector<std::uint32_t>(found.begin(), found.end());
  };
  EXPECT_EQ(chosen(), (std::vector<std::uint32_t>{4, 5, 6, 7, 8, 9, 10, 11}));  // exactly 8 are enough
  matches.state[11] = MatchState::lost;
  EXPECT_EQ(chosen(), (std::vector<std::uint32_t>{2, 4, 5, 6, 7, 8, 9, 10}));  // 7 are not; 3 stays out
}

}  // namespace
}  // namespace stillpoint
