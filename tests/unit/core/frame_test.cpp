// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/frame.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace stillpoint::frame_test {
namespace {

TEST(DepthView, APixelOf16BitHasADepthUnlessItIsZero) {
  const std::uint16_t raw[] = {0, 1, 65535};
  const DepthView depth = DepthView::millimetres(ImageView(raw, 3, 1, sizeof raw, PixelFormat::depth16));
  EXPECT_FALSE(depth.has_depth(0, 0));
  EXPECT_TRUE(depth.has_depth(1, 0));
  EXPECT_TRUE(depth.has_depth(2, 0));
  EXPECT_EQ(depth.metres(0, 0), 0.0f);
  EXPECT_EQ(depth.metres(1, 0), 0.001f);
  EXPECT_EQ(depth.metres(2, 0), 65.535f);
}

TEST(DepthView, APixelOfFloatHasADepthIfItIsPositiveAndFinite) {
  using Limits = std::numeric_limits<float>;
  const float values_m[2][4] = {{0.0f, -1.0f, Limits::quiet_NaN(), Limits::infinity()}, {0.25f, 0.0f, 0.0f, 2.5f}};
  const DepthView depth(ImageView(values_m, 4, 2, sizeof values_m[0], PixelFormat::depth32f));
  for (int u = 0; u < 4; ++u) {
    EXPECT_FALSE(depth.has_depth(u, 0)) << u;
    EXPECT_EQ(depth.metres(u, 0), 0.0f) << u;
  }
  EXPECT_TRUE(depth.has_depth(0, 1));
  EXPECT_TRUE(depth.has_depth(3, 1));
  EXPECT_EQ(depth.metres(3, 1), 2.5f);
}

}  // namespace
}  // namespace stillpoint::frame_test
