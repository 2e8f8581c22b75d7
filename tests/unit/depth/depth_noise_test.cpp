// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/depth/depth_noise.hpp"

#include <gtest/gtest.h>

#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint::depth_noise_test {
namespace {

constexpr double kRounding = 1e-15;

static_assert(is_depth_noise<KinectNoise>::value && is_depth_noise<StereoNoise>::value);
static_assert(is_depth_noise<TimeOfFlightNoise>::value && is_depth_noise<AnyDepthNoise>::value);
struct NoNoise {};
static_assert(!is_depth_noise<NoNoise>::value);

TEST(KinectNoise, FollowsNguyen) {
  EXPECT_NEAR(KinectNoise{}.sigma(0.4), 0.0012, kRounding);
  EXPECT_NEAR(KinectNoise{}.sigma(1.4), 0.0031, kRounding);  // 0.0012 + 0.0019 · 1²
  EXPECT_NEAR(KinectNoise{}.sigma(4.4), 0.0316, kRounding);  // 0.0012 + 0.0019 · 4²
  EXPECT_NEAR(KinectNoise{}.sigma(0.1), 0.0012, kRounding);  // nearer than its limit: as at the limit
}

TEST(StereoNoise, FollowsTheDerivativeOfDisparity) {
  // f b = 50: σ(1 m) = 0.3 / 50 = 0.006, σ(5 m) = 25 · 0.006
  EXPECT_NEAR(StereoNoise{}.sigma(1.0), 0.006, kRounding);
  EXPECT_NEAR(StereoNoise{}.sigma(5.0), 0.15, kRounding);
  const StereoNoise noise{700.0, 0.25, 0.5};
  // By finite differences: z(d) = f b / d, one σ of disparity to either side.
  const double z = 4.0, disparity = 700.0 * 0.25 / z, h = 1e-4;
  const double slope = (700.0 * 0.25 / (disparity - h) - 700.0 * 0.25 / (disparity + h)) / (2 * h);
  EXPECT_NEAR(noise.sigma(z), slope * 0.5, 1e-9);
}

TEST(TimeOfFlightNoise, GrowsLinearly) {
  EXPECT_NEAR(TimeOfFlightNoise{}.sigma(0.0), 0.005, kRounding);
  EXPECT_NEAR(TimeOfFlightNoise{}.sigma(3.0), 0.011, kRounding);
}

TEST(AnyDepthNoise, AsksTheModelItHolds) {
  AnyDepthNoise noise;
  EXPECT_DOUBLE_EQ(noise.sigma(2.0), KinectNoise{}.sigma(2.0));
  noise = StereoNoise{};
  EXPECT_DOUBLE_EQ(noise.sigma(2.0), StereoNoise{}.sigma(2.0));
  noise = TimeOfFlightNoise{};
  EXPECT_DOUBLE_EQ(noise.sigma(2.0), TimeOfFlightNoise{}.sigma(2.0));
}

TEST(FunctorNoise, CallsTheUsersFunction) {
  const FunctorNoise noise{[](double z) { return 0.01f * static_cast<float>(z); }};
  static_assert(is_depth_noise<decltype(noise)>::value);
  EXPECT_NEAR(noise.sigma(2.0), 0.02, 1e-8);  // a float function
}

}  // namespace
}  // namespace stillpoint::depth_noise_test
