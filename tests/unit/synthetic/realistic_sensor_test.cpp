// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What a real depth sensor does beyond noise: the options of `Sensor` that are off by default.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/depth_sensor.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::synthetic::realistic_sensor_test {
namespace {

constexpr double kFocal_px = 525.0;

/// A flat depth image with a sensor in front of it.
struct Bench {
  static constexpr int kWidth = 200, kHeight = 100;
  ImageBuffer exact, depth;
  std::vector<float> cosine = std::vector<float>(kWidth * kHeight, 1.0f);
  NormalTable table;
  Sensor sensor;

  explicit Bench(float depth_m) {
    exact.resize(kWidth, kHeight, PixelFormat::depth32f);
    fill(0, kWidth, depth_m);
  }
  void fill(int u_begin, int u_end, float depth_m) {
    for (int v = 0; v < kHeight; ++v) std::fill(exact.row<float>(v) + u_begin, exact.row<float>(v) + u_end, depth_m);
  }
  void measure(const SurfaceLight& light, std::uint64_t seed = 1) {
    DepthSensor(sensor).measure(exact.view(), light, table, seed, depth);
  }
  void measure(std::uint64_t seed = 1) { measure(SurfaceLight(cosine.data()), seed); }
  double metres(int u, int v) { return depth.row<std::uint16_t>(v)[u] / sensor.depth_factor; }
};

TexturePtr print() {
  static const TexturePtr texture = paint(64, 50, {}, 1);
  return texture;
}

/// A camera of 640 x 480 px at the origin looks along z at a wall; a cuboid is centred before it, its front at
/// `front_m`.
Scene cuboid_before_wall(double half_width_m, double front_m, double wall_m) {
  Scene scene;
  scene.furniture.emplace_back(Shape::room, Vector3d(8, 8, wall_m), Vector3d(0, 0, 0), print());
  Mover cuboid;
  cuboid.parts.push_back({Solid(Shape::cuboid, {half_width_m, 0.4, 0.005}, {0, 0, front_m + 0.005}, print()), {}});
  scene.movers.push_back(cuboid);
  scene.sensor.image_sigma = 0;
  scene.sensor.depth_noise = false;
  scene.sensor.projector_baseline_m = 0.075;
  return scene;
}

/// Pixels [begin, end) of the middle row.
struct Columns {
  int begin, end;
  bool operator==(const Columns& other) const { return begin == other.begin && end == other.end; }
};
std::ostream& operator<<(std::ostream& out, const Columns& columns) {
  return out << '[' << columns.begin << ", " << columns.end << ')';
}

/// Where the middle row has no depth.
std::vector<Columns> holes(const Scene& scene) {
  SyntheticFrame frame;
  SyntheticSequence(scene).render(0, frame);
  const std::uint16_t* const row = frame.depth.row<std::uint16_t>(240);
  std::vector<Columns> found;
  for (int u = 0; u < 640; ++u) {
    if (row[u] != 0) continue;
    if (found.empty() || found.back().end != u) found.push_back({u, u});
    ++found.back().end;
  }
  return found;
}

// The light that passes the left edge (x = -0.5 m, z = 1.5 m) meets the wall where the camera sees it
// f b (1/z1 - 1/z2) = 525 · 0.075 · (1/1.5 - 1/3) = 13.125 px left of the edge. The edge itself is seen at
// 319.5 - 525 · 0.5 / 1.5 = 144.5 px, so that the shadow covers 131.375 to 144.5: the centres of pixels 132 to 144.
TEST(ProjectorShadow, HasTheWidthOfTheHandComputation) {
  EXPECT_EQ(holes(cuboid_before_wall(0.5, 1.5, 3.0)), (std::vector<Columns>{{132, 145}}));
  Scene scene = cuboid_before_wall(0.5, 1.5, 3.0);
  scene.sensor.projector_baseline_m = 0.15;  // 26.25 px: from 118.25
  EXPECT_EQ(holes(scene), (std::vector<Columns>{{119, 145}}));
}

// A pole of 2 cm at 1 m covers 525 · 0.02 / 1 = 10.5 px: 314.25 to 324.75. Its shadow on the wall at 3 m is as wide and
// lies 525 · 0.075 · (1 - 1/3) = 26.25 px to the left: 288 to 298.5. In between, light that passes behind the pole
// reaches the wall. What compares only the order of disparities would call that a shadow, too.
TEST(ProjectorShadow, OfAPoleLiesApartFromIt) {
  EXPECT_EQ(holes(cuboid_before_wall(0.01, 1.0, 3.0)), (std::vector<Columns>{{288, 299}}));
}

TEST(ProjectorShadow, HasItsWidthAtAnyDepths) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const double front_m = random.uniform(0.8, 2.0), wall_m = random.uniform(2.5, 4.0);
    Scene scene = cuboid_before_wall(0.3, front_m, wall_m);
    scene.sensor.projector_baseline_m = random.uniform(0.03, 0.12);
    const double width_px = kFocal_px * scene.sensor.projector_baseline_m * (1 / front_m - 1 / wall_m);
    const double edge_px = 319.5 - kFocal_px * 0.3 / front_m;
    const std::vector<Columns> found = holes(scene);
    ASSERT_EQ(found.size(), 1u) << seed;
    EXPECT_EQ(found[0],
              (Columns{static_cast<int>(std::ceil(edge_px - width_px)), static_cast<int>(std::ceil(edge_px))}))
        << seed;
  }
}

TEST(ProjectorShadow, NothingShadowsItself) {
  Scene scene = cuboid_before_wall(0.5, 1.5, 3.0);
  scene.movers.clear();
  scene.furniture.emplace_back(Shape::ellipsoid, Vector3d(0.4, 0.4, 0.4), Vector3d(0, 0, 2), print());
  SyntheticFrame frame;
  SyntheticSequence(scene).render(0, frame);
  int lost = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const bool on_ball = frame.furniture_ids.row<std::uint8_t>(v)[u] == 2;
      lost += on_ball && frame.depth.row<std::uint16_t>(v)[u] == 0;
      // Away from the ball's rim all of it is lit: the projector sees half of it, as the camera does.
      if (on_ball && frame.exact_depth.row<float>(v)[u] < 1.8f) {
        EXPECT_NE(frame.depth.row<std::uint16_t>(v)[u], 0) << u << ' ' << v;
      }
    }
  EXPECT_LT(lost, 1000);  // of 34600: the left rim, which the camera sees and the projector does not
}

// With steps of 1/2 px the disparity at 1 m is 2 · 580 · 0.075 = 87 steps: depths are 87/42 = 2.0714, 87/43 = 2.0233,
// 87/44 = 1.9773, 87/45 = 1.9333 m. They change half way between the disparities: at 87/44.5 = 1.95506 m (column 10),
// at 87/43.5 = 2 m (column 100) and at 87/42.5 = 2.04706 m (column 194). The deviation of the steps alone, 46 mm / √12
// = 13 mm, exceeds that of the model, 6 mm: no noise is added.
TEST(DisparitySteps, AreThoseOfTheHandComputation) {
  Bench bench(0.0f);
  bench.sensor.disparity_step_px = 0.5;
  bench.sensor.depth_holes = false;
  for (int u = 0; u < Bench::kWidth; ++u) bench.fill(u, u + 1, 1.95f + 0.0005f * (static_cast<float>(u) + 0.5f));
  bench.measure();
  constexpr double kHalfUnit_m = 0.5001 / 5000;
  for (int u = 0; u < Bench::kWidth; ++u) {
    const double disparity_steps = u < 10 ? 45 : u < 100 ? 44 : u < 194 ? 43 : 42;
    EXPECT_NEAR(bench.metres(u, 50), 87.0 / disparity_steps, kHalfUnit_m) << u;
  }
}

TEST(DisparitySteps, OfAKinectAreAnEighthOfAPixel) {
  // 8 · 580 · 0.075 = 348 steps at 1 m; at 2 m the 174th, its neighbours 348/175 = 1.98857 and 348/173 = 2.01156 m.
  Bench bench(2.0f);
  bench.measure();
  std::set<int> steps;
  for (int v = 0; v < Bench::kHeight; ++v)
    for (int u = 0; u < Bench::kWidth; ++u) steps.insert(static_cast<int>(std::lround(348.0 / bench.metres(u, v))));
  EXPECT_EQ(steps.count(173) + steps.count(174) + steps.count(175), 3u);
  EXPECT_LE(steps.size(), 7u);  // 3.7 deviations of 6 mm are two steps
  bench.sensor.disparity_step_px = 0.0;
  bench.measure();
  std::set<int> values;
  for (int u = 0; u < Bench::kWidth; ++u) values.insert(bench.depth.row<std::uint16_t>(50)[u]);
  EXPECT_GT(values.size(), 50u);
}

/// A surface at 1.5 m from column 80 to 119 before one at 3 m: 78 to 81 and 118 to 121 are within 2 px of an edge.
Bench edges(double share) {
  Bench bench(3.0f);
  bench.fill(80, 120, 1.5f);
  bench.sensor.depth_noise = false;
  bench.sensor.flying_pixel_share = share;
  bench.sensor.projector_baseline_m = 1e-9;  // no shadow
  return bench;
}
bool is_near_edge(int u) { return (u >= 78 && u <= 81) || (u >= 118 && u <= 121); }

TEST(FlyingPixels, AreHalfOfThoseWithinTwoPixelsOfAnEdge) {
  const std::vector<std::uint8_t> lit(Bench::kWidth * Bench::kHeight, 1);
  constexpr int kNear = 8 * Bench::kHeight;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Bench bench = edges(0.5);
    SurfaceLight light(bench.cosine.data());
    light.lit = lit.data();
    bench.measure(light, seed);
    int flying = 0;
    double sum_m = 0;
    for (int v = 0; v < Bench::kHeight; ++v)
      for (int u = 0; u < Bench::kWidth; ++u) {
        const double exact = u >= 80 && u < 120 ? 1.5 : 3.0, found = bench.metres(u, v);
        if (std::abs(found - exact) < 1e-4) continue;
        ASSERT_TRUE(is_near_edge(u)) << u;
        ASSERT_TRUE(found >= 1.5 && found <= 3.0) << found;
        ++flying;
        sum_m += found;
      }
    // 800 draws of a half: deviation √800 / 2 = 14. Weights are uniform: mean 2.25 m, deviation 1.5 / √12 / √400.
    EXPECT_NEAR(flying, kNear / 2, 4 * 14.2) << seed;
    EXPECT_NEAR(sum_m / flying, 2.25, 4 * 0.0217) << seed;
  }
}

TEST(FlyingPixels, FollowTheirShare) {
  const std::vector<std::uint8_t> lit(Bench::kWidth * Bench::kHeight, 1);
  for (const double share : {0.1, 1.0}) {
    Bench bench = edges(share);
    SurfaceLight light(bench.cosine.data());
    light.lit = lit.data();
    bench.measure(light);
    int flying = 0;
    for (int v = 0; v < Bench::kHeight; ++v)
      for (int u = 0; u < Bench::kWidth; ++u)
        flying += std::abs(bench.metres(u, v) - (u >= 80 && u < 120 ? 1.5 : 3.0)) >= 1e-4;
    EXPECT_NEAR(flying, 800 * share, 4 * std::sqrt(800 * share * (1 - share)) + 2) << share;
  }
}

// Ten deviations at 1.535 m: 10 · (0.0012 + 0.0019 · 1.135²) = 36.5 mm. 35 mm are no edge, 38 mm are one.
TEST(FlyingPixels, NeedAnEdgeOfTenDeviations) {
  for (const float far_m : {1.535f, 1.538f}) {
    Bench bench(far_m);
    bench.fill(0, 100, 1.5f);
    bench.sensor.depth_noise = false;
    bench.sensor.flying_pixel_share = 1.0;
    bench.measure();
    int flying = 0;
    for (int v = 0; v < Bench::kHeight; ++v)
      for (const int u : {98, 99, 100, 101})
        flying += std::abs(bench.metres(u, v) - static_cast<double>(u < 100 ? 1.5f : far_m)) > 2e-4;
    EXPECT_EQ(flying > 0, far_m > 1.536f) << far_m;
  }
}

TEST(LeastReturn, IsAlbedoTimesCosine) {
  Bench bench(2.0f);
  bench.sensor.least_return = 0.08;
  std::vector<float> returned(Bench::kWidth * Bench::kHeight, 0.0799f);
  SurfaceLight light(bench.cosine.data());
  light.returned = returned.data();
  bench.measure(light);
  EXPECT_EQ(bench.metres(50, 50), 0.0);
  returned.assign(returned.size(), 0.0801f);
  bench.measure(light);
  EXPECT_GT(bench.metres(50, 50), 1.9);
}

// The camera is 0.3 m above a floor of albedo 0.5: cos = 0.3 / distance, and 0.5 cos > 0.08 up to a distance of
// 0.5 · 0.3 / 0.08 = 1.875 m. That is an angle of acos(0.16) = 80.8 degrees.
TEST(LeastReturn, LeavesNoDepthAtGrazingAngles) {
  Scene scene;
  Solid floor(Shape::cuboid, {50, 0.1, 50}, {0, 0.4, 0}, print());
  scene.furniture.push_back(floor);
  scene.sensor.depth_noise = false;
  scene.sensor.least_return = 0.08;
  SyntheticFrame frame;
  SyntheticSequence(scene).render(0, frame);
  int near = 0, grazing = 0;
  for (int v = 245; v < 480; v += 2)
    for (int u = 0; u < 640; u += 5) {
      const Vector3d ray((u - 319.5) / kFocal_px, (v - 239.5) / kFocal_px, 1.0);
      const double distance_m = 0.3 / ray.y() * ray.norm(), depth_m = 0.3 / ray.y();
      if (depth_m < 0.41 || std::abs(distance_m - 1.875) < 0.02) continue;
      const bool has_depth = frame.depth.row<std::uint16_t>(v)[u] != 0;
      EXPECT_EQ(has_depth, distance_m < 1.875) << u << ' ' << v;
      ++(has_depth ? near : grazing);
    }
  EXPECT_GT(near, 1000);
  EXPECT_GT(grazing, 1000);
}

TEST(LeastReturn, LeavesNoDepthOnDarkAndShinySurfaces) {
  struct Case {
    double albedo;
    bool is_specular, has_depth;
  };
  for (const Case& surface : {Case{0.5, false, true}, {0.09, false, true}, {0.07, false, false}, {0.9, true, false}}) {
    Scene scene = cuboid_before_wall(0.5, 1.5, 3.0);
    scene.sensor.least_return = 0.08;
    scene.movers[0].parts[0].solid.infrared_albedo = surface.albedo;
    scene.movers[0].parts[0].solid.specular = surface.is_specular;
    SyntheticFrame frame;
    SyntheticSequence(scene).render(0, frame);
    EXPECT_EQ(frame.depth.row<std::uint16_t>(240)[320] != 0, surface.has_depth) << surface.albedo;
    EXPECT_NE(frame.depth.row<std::uint16_t>(240)[600], 0) << "the wall";
    EXPECT_NEAR(static_cast<double>(frame.exact_depth.row<float>(240)[320]), 1.5, 1e-5);
  }
}

// The cuboid goes to the right at 1 m/s: after 0.1 s its left edge is seen 525 · 0.1 / 1.5 = 35 px further right.
TEST(DepthDelay, ShowsTheDepthOfAnotherInstant) {
  Scene scene = cuboid_before_wall(0.5, 1.5, 3.0);
  scene.sensor.depth_holes = false;
  scene.movers[0].path = Path({{0, {0, 0, 0}}, {2, {2, 0, 0}}}, Blend::linear);
  SyntheticFrame sharp, delayed;
  SyntheticSequence(scene).render(6, sharp);  // 0.2 s: from 144.5 + 70 px
  for (const double delay_s : {0.1, -0.1}) {
    scene.sensor.depth_delay_s = delay_s;
    SyntheticSequence(scene).render(6, delayed);
    const int edge = delay_s > 0 ? 250 : 180;
    const auto depth_m = [&](int u) { return delayed.depth.row<std::uint16_t>(240)[u] / 5000.0; };
    EXPECT_NEAR(depth_m(edge - 1), 3.0, 1e-3);
    EXPECT_NEAR(depth_m(edge), 1.5, 1e-3);
    EXPECT_NEAR(static_cast<double>(delayed.exact_depth.row<float>(240)[214]), 3.0, 1e-3);
    EXPECT_NEAR(static_cast<double>(delayed.exact_depth.row<float>(240)[215]), 1.5, 1e-3);
    EXPECT_EQ(std::memcmp(sharp.colour.view().data, delayed.colour.view().data, 640 * 480 * 3), 0);
    EXPECT_EQ(std::memcmp(sharp.labels.view().data, delayed.labels.view().data, 640 * 480), 0);
    EXPECT_EQ(sharp.world_from_camera.matrix(), delayed.world_from_camera.matrix());
  }
}

TEST(DepthDelay, ChangesNothingWhereNothingMoves) {
  Scene scene = cuboid_before_wall(0.5, 1.5, 3.0);
  scene.sensor.depth_noise = true;
  SyntheticFrame sharp, delayed;
  SyntheticSequence(scene).render(6, sharp);
  scene.sensor.depth_delay_s = 0.05;
  SyntheticSequence(scene).render(6, delayed);
  EXPECT_EQ(std::memcmp(sharp.depth.view().data, delayed.depth.view().data, 640 * 480 * 2), 0);
}

// At 20 m the disparity of f 360 px and 0.54 m is 9.72 px; z = f b / d.
TEST(StereoNoiseOfSensor, IsGaussianInTheDisparity) {
  Bench bench(20.0f);
  bench.sensor.stereo_noise = StereoNoise{360.0, 0.54, 0.3};
  bench.sensor.depth_factor = 500.0;
  bench.sensor.farthest_m = 100.0;
  bench.measure();
  double sum_px = 0, squares = 0;
  for (int v = 0; v < Bench::kHeight; ++v)
    for (int u = 0; u < Bench::kWidth; ++u) {
      const double error_px = 360 * 0.54 / bench.metres(u, v) - 9.72;
      sum_px += error_px;
      squares += error_px * error_px;
    }
  constexpr double kCount = Bench::kWidth * Bench::kHeight;
  EXPECT_NEAR(sum_px / kCount, 0.0, 4 * 0.3 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.3, 0.01);
}

TEST(RealisticKinect, EveryEffectIsOffByDefault) {
  const Sensor plain, real = realistic_kinect();
  EXPECT_EQ(plain.projector_baseline_m, 0.0);
  EXPECT_EQ(plain.least_return, 0.0);
  EXPECT_EQ(plain.flying_pixel_share, 0.0);
  EXPECT_EQ(plain.depth_delay_s, 0.0);
  EXPECT_FALSE(plain.stereo_noise);
  EXPECT_EQ(real.projector_baseline_m, 0.075);
  EXPECT_EQ(real.disparity_step_px, 0.125);
  EXPECT_EQ(real.flying_pixel_share, 0.5);
  EXPECT_GT(real.least_return, 0.0);
  EXPECT_GT(real.depth_delay_s, 0.0);
}

TEST(RealisticKinect, EqualSeedsGiveEqualBytesInAnyOrder) {
  SceneOptions options;
  options.width = 320;
  options.height = 240;
  for (const std::uint64_t seed : {1u, 2u}) {
    options.seed = seed;
    Scene scene = walking_people(options);
    scene.sensor = realistic_kinect();
    SyntheticSequence sequence(scene), again(scene);
    SyntheticFrame frame, repeated;
    sequence.render(20, frame);
    again.render(40, repeated);
    again.render(20, repeated);
    EXPECT_EQ(std::memcmp(frame.depth.view().data, repeated.depth.view().data, 320 * 240 * 2), 0);
    scene.seed += 100;
    SyntheticSequence(scene).render(20, repeated);
    EXPECT_NE(std::memcmp(frame.depth.view().data, repeated.depth.view().data, 320 * 240 * 2), 0);
  }
}

}  // namespace
}  // namespace stillpoint::synthetic::realistic_sensor_test
