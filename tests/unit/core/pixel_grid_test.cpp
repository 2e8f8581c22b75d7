// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/pixel_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint::pixel_grid_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<std::size_t> neighbours(const PixelGrid& grid, const Vector2f& pixel, float radius_px) {
  std::vector<std::size_t> found;
  grid.within(pixel, radius_px, [&](std::size_t i, float) { found.push_back(i); });
  return found;
}

bool everything(std::size_t) { return true; }

TEST(PixelGrid, FindsWhatBruteForceFinds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    std::vector<Vector2f> pixels;
    for (std::size_t i = 0, count = random.index(200); i < count; ++i)
      pixels.emplace_back(static_cast<float>(random.uniform(-20, 340)), static_cast<float>(random.uniform(-20, 260)));
    for (std::size_t i = 7; i < pixels.size(); i += 31) pixels[i].x() = i % 2 == 0 ? kNaN : kInfinity;
    const auto accept = [](std::size_t i) { return i % 5 != 3; };
    const auto cell_px = static_cast<float>(random.uniform(3, 60)),
               radius_px = static_cast<float>(random.uniform(1, 70));
    Workspace workspace;
    const PixelGrid grid(pixels, cell_px, workspace, accept);
    for (int query = 0; query < 20; ++query) {
      const Vector2f pixel(static_cast<float>(random.uniform(-60, 400)), static_cast<float>(random.uniform(-60, 300)));
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < pixels.size(); ++i)
        if (accept(i) && (pixels[i] - pixel).squaredNorm() <= radius_px * radius_px) expected.push_back(i);
      std::vector<std::size_t> found = neighbours(grid, pixel, radius_px);
      EXPECT_EQ(found, neighbours(grid, pixel, radius_px)) << "the order is fixed";
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << "seed " << seed;
    }
  }
}

TEST(PixelGrid, NearestIsThatOfBruteForce) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<Vector2f> pixels;
    for (int i = 0; i < 60; ++i)
      pixels.emplace_back(static_cast<float>(random.uniform(0, 100)), static_cast<float>(random.uniform(0, 100)));
    const auto accept = [](std::size_t i, float squared) { return i % 3 != 0 && squared > 9.0f; };
    Workspace workspace;
    const PixelGrid grid(pixels, 10.0f, workspace, everything);
    for (int query = 0; query < 20; ++query) {
      const Vector2f pixel(static_cast<float>(random.uniform(0, 100)), static_cast<float>(random.uniform(0, 100)));
      std::size_t expected = PixelGrid::kNone;
      float least = 12.0f * 12.0f;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float squared = (pixels[i] - pixel).squaredNorm();
        if (!accept(i, squared) || squared > least) continue;
        least = squared;
        expected = i;
      }
      EXPECT_EQ(grid.nearest(pixel, 12.0f, accept), expected) << "seed " << seed;
    }
  }
}

TEST(PixelGrid, OfEquallyNearPointsTheFirstIsTheNearest) {
  const std::vector<Vector2f> pixels = {{10, 10}, {14, 10}, {14, 10}, {12, 12}};
  Workspace workspace;
  const PixelGrid grid(pixels, 50.0f, workspace, everything);
  const auto any = [](std::size_t, float) { return true; };
  const std::size_t first = neighbours(grid, {12, 10}, 5.0f).front();
  EXPECT_EQ(grid.nearest({12, 10}, 5.0f, any), first) << "all are 2 px away";
  EXPECT_EQ(grid.nearest({12, 10}, 1.9f, any), PixelGrid::kNone);
}

// Ranks go cell by cell; the runs hold all that is within, and nothing twice.
TEST(PixelGrid, RunsOfRanksHoldWhatIsWithin) {
  Random random(1);
  std::vector<Vector2f> pixels;
  for (int i = 0; i < 300; ++i)
    pixels.emplace_back(static_cast<float>(random.uniform(0, 320)), static_cast<float>(random.uniform(0, 240)));
  Workspace workspace;
  const PixelGrid grid(pixels, 12.0f, workspace, [](std::size_t i) { return i % 3 != 0; });
  ASSERT_EQ(grid.size(), 200u);
  for (int query = 0; query < 50; ++query) {
    const Vector2f pixel(static_cast<float>(random.uniform(-30, 350)), static_cast<float>(random.uniform(-30, 270)));
    std::vector<std::size_t> visited;
    grid.runs_around(pixel, 25.0f, [&](std::size_t first, std::size_t last) {
      for (std::size_t rank = first; rank < last; ++rank) visited.push_back(grid.index(rank));
    });
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
    for (const std::size_t i : neighbours(grid, pixel, 25.0f))
      EXPECT_TRUE(std::binary_search(visited.begin(), visited.end(), i));
    EXPECT_LT(visited.size(), 100u) << "a part of the image, not all of it";
  }
}

TEST(PixelGrid, TellsTheSquaredDistance) {
  const std::vector<Vector2f> pixels = {{13, 14}, {10, 15}};
  Workspace workspace;
  const PixelGrid grid(pixels, 4.0f, workspace, everything);
  std::vector<float> squared(2, -1.0f);
  grid.within({10, 10}, 5.0f, [&](std::size_t i, float s) { squared[i] = s; });
  EXPECT_EQ(squared, (std::vector<float>{25.0f, 25.0f})) << "the radius itself is within";
}

TEST(PixelGrid, AnswersOddQuestionsWithNothing) {
  const std::vector<Vector2f> pixels = {{10, 10}}, none;
  Workspace workspace;
  const PixelGrid grid(pixels, 8.0f, workspace, everything), empty(none, 8.0f, workspace, everything);
  EXPECT_TRUE(neighbours(empty, {0, 0}, 100.0f).empty());
  for (const Vector2f& pixel : {Vector2f(kNaN, 10), Vector2f(10, kInfinity), Vector2f(-kInfinity, 10),
                                Vector2f(1e30f, 1e30f), Vector2f(-1e30f, 10)})
    EXPECT_TRUE(neighbours(grid, pixel, 20.0f).empty()) << pixel.transpose();
}

// A host may hand over anything: one keypoint at the end of the world costs no memory of that size.
TEST(PixelGrid, AFarPointNeitherHidesOthersNorCostsMemory) {
  std::vector<Vector2f> pixels = {{10, 10}, {1e30f, 1e30f}, {-1e30f, 4}, {99000, 99000}};
  Workspace workspace;
  const PixelGrid grid(pixels, 1.0f, workspace, everything);
  EXPECT_EQ(neighbours(grid, {12, 10}, 5.0f), std::vector<std::size_t>{0});
  EXPECT_EQ(neighbours(grid, {99000, 99001}, 5.0f), std::vector<std::size_t>{3});
}

}  // namespace
}  // namespace stillpoint::pixel_grid_test
