// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/synthetic/stereo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::synthetic {
namespace {

constexpr double kBaseline_m = 0.2;

Scene small_walk() {
  SceneOptions options;
  options.frames = 30;
  options.width = 160;
  options.height = 120;
  return walking_people(options);
}

TEST(SyntheticStereo, RightCameraIsABaselineToTheRight) {
  const Scene left = small_walk(), right = right_of(left, kBaseline_m);
  for (const double time_s : {0.0, 0.37, 0.9}) {
    const Pose left_from_right =
        left.camera_path.world_from_camera(time_s).inverse() * right.camera_path.world_from_camera(time_s);
    EXPECT_TRUE(left_from_right.isApprox(Pose(Eigen::Translation3d(kBaseline_m, 0, 0)), 1e-12)) << time_s;
  }
  EXPECT_EQ(error_of([&] { right_of(left, 0.0); }), "scene: baseline is 0.000000 m, expected a positive number");
}

TEST(SyntheticStereo, ASecondCameraSitsOnTheFirst) {
  Pose left_from_right = Pose::Identity();
  left_from_right.linear() = rotation_from_vector({0.1, -0.2, 0.3});
  left_from_right.translation() = Vector3d(0.3, 0.1, -0.1);
  const Scene left = small_walk(), twice = seen_from(seen_from(left, left_from_right), left_from_right);
  EXPECT_TRUE((left.camera_path.world_from_camera(0.5) * left_from_right * left_from_right)
                  .isApprox(twice.camera_path.world_from_camera(0.5), 1e-12));
}

// A point at depth z of the left image stands f b / z pixels further left in the right one, at the same depth, unless
// something nearer hides it; right of a rim by a pixel, rounding meets the other surface.
TEST(SyntheticStereo, ExactDepthsOfBothImagesAgree) {
  const Scene scene = small_walk();
  SyntheticFrame left, right;
  SyntheticSequence(scene).render(20, left);
  SyntheticSequence(right_of(scene, kBaseline_m)).render(20, right);
  EXPECT_EQ(left.timestamp_s, right.timestamp_s);
  int same = 0, nearer = 0, all = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const float z = left.exact_depth.row<float>(v)[u];
      const double there = u - scene.camera.fx() * kBaseline_m / static_cast<double>(z);
      if (there < 0) continue;
      const float z_there = right.exact_depth.row<float>(v)[std::lround(there)];
      ++all;
      same += std::abs(z_there - z) < 0.03f * z ? 1 : 0;
      nearer += z_there < 0.97f * z ? 1 : 0;
    }
  ASSERT_GT(all, 15000);
  EXPECT_GT(same, 0.9 * all);
  EXPECT_GT(same + nearer, 0.98 * all);
}

TEST(SyntheticStereo, EachCameraHasNoiseOfItsOwn) {
  Scene left = small_walk();
  left.camera_path = {};  // stands
  const Scene right = seen_from(left, Pose::Identity());
  SyntheticFrame one, other;
  SyntheticSequence(left).render(0, one);
  SyntheticSequence(right).render(0, other);
  int differing = 0;
  for (int u = 0; u < 160; ++u)
    differing += one.gray.row<std::uint8_t>(60)[u] != other.gray.row<std::uint8_t>(60)[u] ? 1 : 0;
  EXPECT_GT(differing, 80);
  EXPECT_EQ(one.exact_depth.row<float>(60)[80], other.exact_depth.row<float>(60)[80]);
}

}  // namespace
}  // namespace stillpoint::synthetic
