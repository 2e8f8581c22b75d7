// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/depth/depth_jumps.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::depth_jumps_test {
namespace {

/// Where the jump round pixel 8 of a row lies, by depths in millimetres from pixel 6 to 10; 3 m beside them on the
/// right, 1.5 m on the left, or the other way round.
float jump_at(const std::vector<std::uint16_t>& around_mm, bool nearer_is_left) {
  ImageBuffer depth;
  depth.resize(16, 1, PixelFormat::depth16);
  for (int u = 0; u < 16; ++u) depth.row<std::uint16_t>(0)[u] = (u < 8) == nearer_is_left ? 1500 : 3000;
  for (std::size_t k = 0; k < around_mm.size(); ++k) depth.row<std::uint16_t>(0)[6 + k] = around_mm[k];
  return depth_jump_at(DepthView::millimetres(depth.view()), 8, 0);
}

TEST(DepthJump, LiesBetweenTheTwoSurfaces) {
  EXPECT_EQ(jump_at({1500, 1500, 3000, 3000, 3000}, true), 7.5f);
  EXPECT_EQ(jump_at({1500, 1500, 1500, 1500, 3000}, true), 9.5f);
  EXPECT_EQ(jump_at({3000, 1500, 1500, 1500, 1500}, false), 6.5f);
}

// The farther surface has no depth where the nearer one hides it from the sensor's other eye.
TEST(DepthJump, AHoleBelongsToTheFartherSurface) {
  EXPECT_EQ(jump_at({1500, 1500, 0, 3000, 3000}, true), 7.5f);
  EXPECT_EQ(jump_at({1500, 0, 0, 0, 3000}, true), 6.5f);
  EXPECT_EQ(jump_at({3000, 0, 0, 1500, 1500}, false), 8.5f);
  EXPECT_EQ(jump_at({3000, 0, 0, 0, 1500}, false), 9.5f);
}

}  // namespace
}  // namespace stillpoint::depth_jumps_test
