// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/mask.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace stillpoint {
namespace {

int dropped(const ImageBuffer& mask) {
  const ImageView view = mask.view();
  int count = 0;
  for (int v = 0; v < view.height; ++v)
    for (int u = 0; u < view.width; ++u) {
      const std::uint8_t value = view.row<std::uint8_t>(v)[u];
      EXPECT_TRUE(value == kMaskKeeps || value == kMaskDrops) << int{value};
      count += value == kMaskDrops;
    }
  return count;
}

// Pixels (u, v) with u² + v² ≤ r²: 1, 5, 13, 29 for r = 0, 1, 2, 3 (Gauss's circle problem).
TEST(Mask, DiscHasThePixelsWithinItsRadius) {
  const int expected[] = {1, 5, 13, 29};
  for (int radius_px = 0; radius_px < 4; ++radius_px) {
    ImageBuffer mask;
    keep_everywhere(20, 10, mask);
    drop_disc({7.4f, 4.6f}, radius_px, mask);
    EXPECT_EQ(dropped(mask), expected[radius_px]) << radius_px;
    EXPECT_EQ(mask.view().row<std::uint8_t>(5)[7], kMaskDrops) << "the centre is rounded";
  }
}

TEST(Mask, DiscIsCutAtTheBorder) {
  ImageBuffer mask;
  keep_everywhere(20, 10, mask);
  drop_disc({0.0f, 0.0f}, 2, mask);
  EXPECT_EQ(dropped(mask), 6) << "three in the first row, two in the second, one in the third";
  drop_disc({22.0f, 5.0f}, 2, mask);
  EXPECT_EQ(dropped(mask), 6) << "u = 20 would be the nearest, the last is 19";
  drop_disc({21.0f, 5.0f}, 2, mask);
  EXPECT_EQ(dropped(mask), 7) << "reaches in from outside";
}

TEST(Mask, NothingIsDroppedAroundAPointThatIsNotFinite) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  ImageBuffer mask;
  keep_everywhere(8, 8, mask);
  for (const Vector2f& point :
       {Vector2f(kNaN, 3), Vector2f(3, kNaN), Vector2f(kInfinity, 3), Vector2f(3, -kInfinity), Vector2f(1e30f, 1e30f)})
    drop_disc(point, 3, mask);
  EXPECT_EQ(dropped(mask), 0);
}

}  // namespace
}  // namespace stillpoint
