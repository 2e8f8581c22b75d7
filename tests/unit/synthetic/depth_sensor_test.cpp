// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/depth_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace stillpoint::synthetic {
namespace {

constexpr int kWidth = 200, kHeight = 100;

struct Bench {
  ImageBuffer exact, depth;
  std::vector<float> cosine = std::vector<float>(kWidth * kHeight, 1.0f);
  NormalTable table;
  Sensor sensor;

  explicit Bench(float depth_m) {
    exact.resize(kWidth, kHeight, PixelFormat::depth32f);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) exact.row<float>(v)[u] = depth_m;
  }
  void measure(std::uint64_t seed = 1) { DepthSensor(sensor).measure(exact.view(), cosine.data(), table, seed, depth); }
  double metres(int u, int v) { return depth.row<std::uint16_t>(v)[u] / 5000.0; }
};

/// Depth between two neighbouring disparities: an eighth of a pixel, at 580 px and a baseline of 75 mm.
double disparity_step_m(double depth_m) { return depth_m * depth_m / (8.0 * 580.0 * 0.075); }

TEST(DepthSensor, NoiseHasTheMeanAndDeviationOfKinectNoise) {
  for (const float z : {0.7f, 1.2f, 2.0f, 3.0f, 4.5f}) {
    Bench bench(z);
    // A slope over several disparity steps, so that no pixel sits at a special place between two steps.
    const auto slope_m = static_cast<float>(4 * disparity_step_m(z));
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        bench.exact.row<float>(v)[u] += slope_m * (static_cast<float>(u) / kWidth - 0.5f);
    bench.measure();
    double sum = 0, squares = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const double error = bench.metres(u, v) - static_cast<double>(bench.exact.row<float>(v)[u]);
        sum += error;
        squares += error * error;
      }
    const double count = kWidth * kHeight, sigma = KinectNoise{}.sigma(z);
    // Four standard errors; z = b f / d is not linear: the mean moves by about σ² / z.
    EXPECT_NEAR(sum / count, 0.0, 4 * sigma / std::sqrt(count) + sigma * sigma / static_cast<double>(z)) << z;
    EXPECT_NEAR(std::sqrt(squares / count) / sigma, 1.0, 0.04) << z;
  }
}

TEST(DepthSensor, NoisyDepthHasOnlyTheValuesOfDisparitySteps) {
  Bench bench(2.0f);
  bench.measure();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const double steps = 8 * 580 * 0.075 / bench.metres(u, v);
      EXPECT_NEAR(steps, std::round(steps), 0.01);  // rounding to 0.2 mm: 0.1 mm · 348 / 4 m² = 0.009
    }
}

TEST(DepthSensor, IsExactWhenSwitchedOff) {
  Bench bench(0.1f);
  bench.sensor.depth_noise = bench.sensor.depth_holes = false;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) bench.exact.row<float>(v)[u] += 0.031f * static_cast<float>(u);
  bench.measure();
  for (int u = 0; u < kWidth; ++u)
    EXPECT_NEAR(bench.metres(u, 3), static_cast<double>(bench.exact.row<float>(3)[u]), 0.5001 / 5000);
}

TEST(DepthSensor, ShadowLiesLeftOfTheNearerSurfaceOnly) {
  Bench bench(3.0f);
  bench.sensor.depth_noise = false;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 80; u < 120; ++u) bench.exact.row<float>(v)[u] = 1.5f;
  bench.measure();
  int narrow = 0, wide = 0;
  for (int v = 0; v < kHeight; ++v) {
    int lost = 0;
    for (int u = 0; u < kWidth; ++u) {
      const bool none = !(bench.metres(u, v) > 0);
      if (u >= 76 && u < 80)
        lost += none;
      else
        EXPECT_FALSE(none) << u << ' ' << v;
    }
    EXPECT_GE(lost, 2);
    narrow += lost == 2;
    wide += lost == 4;
  }
  EXPECT_GT(narrow, kHeight / 6);  // 2, 3 and 4 px are equally likely
  EXPECT_GT(wide, kHeight / 6);
}

TEST(DepthSensor, RimsAreRaggedByOnePixel) {
  Bench bench(3.0f);
  bench.sensor.depth_noise = false;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 80; u < 120; ++u) bench.exact.row<float>(v)[u] = 1.5f;
  bench.measure();
  int swapped = 0;
  for (int v = 2; v < kHeight - 2; ++v) {
    swapped += bench.metres(119, v) > 2.0;
    EXPECT_LT(bench.metres(118, v), 2.0);
    EXPECT_GT(bench.metres(121, v), 2.0);
  }
  EXPECT_NEAR(swapped / (kHeight - 4.0), 1.0 / 3, 0.2);  // a third, four standard errors of 96 rows
}

TEST(DepthSensor, GrazingNearAndFarSurfacesHaveHoles) {
  Bench bench(2.0f);
  bench.cosine.assign(bench.cosine.size(), 0.09f);
  bench.measure();
  EXPECT_EQ(bench.metres(50, 50), 0.0);
  bench.cosine.assign(bench.cosine.size(), 0.22f);
  bench.measure();
  EXPECT_GT(bench.metres(50, 50), 1.9);
  for (const float z : {0.3f, 8.5f, 0.0f}) {
    Bench other(z);
    other.measure();
    EXPECT_EQ(other.metres(50, 50), 0.0) << z;
  }
}

TEST(DepthSensor, EqualSeedsGiveEqualBytes) {
  Bench first(2.0f), again(2.0f), other(2.0f);
  first.measure(5);
  again.measure(5);
  other.measure(6);
  const std::size_t bytes = kWidth * kHeight * 2;
  EXPECT_EQ(std::memcmp(first.depth.view().data, again.depth.view().data, bytes), 0);
  EXPECT_NE(std::memcmp(first.depth.view().data, other.depth.view().data, bytes), 0);
}

}  // namespace
}  // namespace stillpoint::synthetic
