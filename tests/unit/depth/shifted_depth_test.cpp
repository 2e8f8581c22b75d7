// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/depth/shifted_depth.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <utility>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::shifted_depth_test {
namespace {

constexpr int kWidth = 7, kHeight = 5;

/// Each pixel another depth: 1000 + 10 u + 100 v millimetres, or as many metres.
template <class Depth>
ImageBuffer ramp(PixelFormat format) {
  ImageBuffer depth;
  depth.resize(kWidth, kHeight, format);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) depth.row<Depth>(v)[u] = static_cast<Depth>(1000 + 10 * u + 100 * v);
  return depth;
}

template <class Depth>
void expect_shifted(const DepthView& depth, int right_px, int down_px) {
  ShiftedDepth shifted;
  const DepthView moved = shifted(depth, right_px, down_px);
  ASSERT_EQ(moved.image.width, kWidth);
  ASSERT_EQ(moved.image.height, kHeight);
  ASSERT_EQ(moved.image.format, depth.image.format);
  EXPECT_EQ(moved.factor, depth.factor);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const int from_u = u - right_px, from_v = v - down_px;
      const bool is_inside = from_u >= 0 && from_u < kWidth && from_v >= 0 && from_v < kHeight;
      EXPECT_EQ(moved.image.row<Depth>(v)[u], is_inside ? depth.image.row<Depth>(from_v)[from_u] : Depth{0})
          << right_px << ' ' << down_px << " at " << u << ' ' << v;
    }
}

TEST(ShiftedDepth, MovesEachPixelAndLeavesHoles) {
  const ImageBuffer whole = ramp<std::uint16_t>(PixelFormat::depth16), metres = ramp<float>(PixelFormat::depth32f);
  for (const auto& [right_px, down_px] : std::initializer_list<std::pair<int, int>>{
           {0, 0}, {2, 0}, {-3, 0}, {0, 1}, {0, -2}, {3, -1}, {-2, 2}, {6, 4}, {7, 0}, {-7, 0}, {0, 5}, {-100, 100}}) {
    expect_shifted<std::uint16_t>(DepthView::millimetres(whole.view()), right_px, down_px);
    expect_shifted<float>(DepthView(metres.view()), right_px, down_px);
  }
}

}  // namespace
}  // namespace stillpoint::shifted_depth_test
