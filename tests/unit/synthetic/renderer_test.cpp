// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "stillpoint/synthetic/scenes.hpp"
#include "unit/counted_allocations.hpp"

namespace stillpoint::synthetic::renderer_test {
namespace {

SceneOptions small(std::uint64_t seed = 1) {
  SceneOptions options;
  options.seed = seed;
  options.width = 320;
  options.height = 240;
  return options;
}

TexturePtr print(std::uint64_t seed) {
  TextureStyle style;
  style.colours = {{120, 120, 120}, {30, 30, 30}, {230, 230, 230}, {60, 90, 200}};
  style.smallest_mark_m = 0.025;  // 4 px on the wall: in finer marks the bilinear reading of `align` errs by itself
  return paint(512, 200, style, seed);
}

/// A camera at the origin looks along z at a wall 3 m ahead; a cube of 1 m hangs centred before it, its front at 1.5 m.
Scene cube_before_wall() {
  Scene scene;
  scene.furniture.emplace_back(Shape::room, Vector3d(4, 4, 3), Vector3d(0, 0, 0), print(1));
  Mover cube;
  cube.parts.push_back({Solid(Shape::cuboid, {0.5, 0.5, 0.5}, {0, 0, 2}, print(2)), {}});
  scene.movers.push_back(cube);
  scene.sensor.image_sigma = 0;
  scene.sensor.depth_noise = scene.sensor.depth_holes = false;
  return scene;
}

std::vector<std::uint8_t> bytes(const ImageView& image) {
  return {image.data, image.data + image.stride_bytes * static_cast<std::size_t>(image.height)};
}

float exact_m(const SyntheticFrame& frame, int u, int v) { return frame.exact_depth.view().row<float>(v)[u]; }
int label(const SyntheticFrame& frame, int u, int v) { return frame.labels.view().row<std::uint8_t>(v)[u]; }

/// Grey level between pixels.
double gray_at(const ImageView& gray, double u, double v) {
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  const double a = u - left, b = v - top;
  const auto* const upper = gray.row<std::uint8_t>(top) + left;
  const auto* const lower = gray.row<std::uint8_t>(top + 1) + left;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

/// Where the patch of 15 × 15 pixels around (u, v) of one picture lies in another, by Gauss and Newton from the same
/// place; false where the patch has no corner.
bool align(const ImageView& from, const ImageView& to, int u, int v, Vector2d& found) {
  constexpr int kHalf = 7;
  constexpr double kCorner = 100.0;  // smaller eigenvalue of the mean squared slopes, (grey levels / px)²
  found = Vector2d(u, v);
  for (int iteration = 0; iteration < 12; ++iteration) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Vector2d right = Vector2d::Zero();
    for (int dv = -kHalf; dv <= kHalf; ++dv)
      for (int du = -kHalf; du <= kHalf; ++du) {
        const double x = found.x() + du, y = found.y() + dv;
        const Vector2d slope(0.5 * (gray_at(to, x + 1, y) - gray_at(to, x - 1, y)),
                             0.5 * (gray_at(to, x, y + 1) - gray_at(to, x, y - 1)));
        normal += slope * slope.transpose();
        right += slope * (gray_at(from, u + du, v + dv) - gray_at(to, x, y));
      }
    const double mean = 0.5 * normal.trace();
    if (!(mean - std::sqrt(std::max(0.0, mean * mean - normal.determinant())) > kCorner * 225)) return false;
    found += normal.inverse() * right;
  }
  return true;
}

TEST(SyntheticSequence, CubeBeforeWallHasTheDepthAndOutlineOfTheHandComputation) {
  // Half an edge of 0.5 m at 1.5 m: 525 · 0.5 / 1.5 = 175 px around the principal point 319.5, 239.5.
  SyntheticSequence sequence(cube_before_wall());
  SyntheticFrame frame;
  sequence.render(0, frame);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const bool on_cube = u >= 145 && u <= 494 && v >= 65 && v <= 414;
      ASSERT_NEAR(exact_m(frame, u, v), on_cube ? 1.5 : 3.0, 1e-6) << u << ' ' << v;
      ASSERT_EQ(frame.mover_ids.view().row<std::uint8_t>(v)[u], on_cube ? 1 : 0);
      ASSERT_NEAR(frame.view().depth.metres(u, v), on_cube ? 1.5 : 3.0, 1e-4);  // half a step of the 16-bit image
    }
  EXPECT_EQ(label(frame, 300, 200), kAtRest);
  EXPECT_EQ(label(frame, 143, 200), kIgnored);
  EXPECT_EQ(label(frame, 146, 200), kIgnored);
  EXPECT_EQ(label(frame, 142, 200), kStatic);
  EXPECT_EQ(label(frame, 147, 200), kAtRest);
  ASSERT_EQ(frame.boxes.size(), 1u);
  EXPECT_EQ(frame.boxes[0].x, 141);
  EXPECT_EQ(frame.boxes[0].y, 61);
  EXPECT_EQ(frame.boxes[0].width, 358);
  EXPECT_EQ(frame.boxes[0].visible_pixels, 350 * 350);
}

TEST(SyntheticSequence, NearerSolidsHideFartherOnesInAnyOrder) {
  Scene scene = cube_before_wall();
  scene.movers.push_back(scene.movers[0]);
  scene.movers[1].parts[0].solid.object_from_solid.translation().z() = 2.2;  // later in the list, and behind
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  sequence.render(0, frame);
  EXPECT_EQ(frame.mover_ids.view().row<std::uint8_t>(240)[320], 1);
  EXPECT_NEAR(exact_m(frame, 320, 240), 1.5, 1e-6);
}

TEST(SyntheticSequence, PictureLiesOnItsDepth) {
  // The outline falls between pixels 144 and 145 on the left, 494 and 495 on the right: a bright cube before a dark
  // wall must look the same from both sides. A picture a quarter of a pixel beside its depth would differ by 50 grey
  // levels.
  constexpr double kGrain = 3.0;  // the material's grain, averaged over the rows
  Scene scene = cube_before_wall();
  TextureStyle dark, bright;
  dark.colours = {{40, 40, 40}};
  bright.colours = {{200, 200, 200}};
  dark.coverage = bright.coverage = 0;
  scene.furniture[0].textures.fill(paint(64, 50, dark, 1));
  scene.movers[0].parts[0].solid.textures.fill(paint(64, 50, bright, 1));
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  sequence.render(0, frame);
  for (const int u : {143, 144, 145, 146}) {
    double across = 0, down = 0;
    for (int i = 0; i < 200; ++i) {
      const auto gray = [&](int x, int y) { return int{frame.gray.view().row<std::uint8_t>(y)[x]}; };
      across += (gray(u, 140 + i) - gray(639 - u, 140 + i)) / 200.0;
      down += (gray(220 + i, u - 80) - gray(220 + i, 479 - (u - 80))) / 200.0;
    }
    EXPECT_NEAR(across, 0.0, kGrain) << u;
    EXPECT_NEAR(down, 0.0, kGrain) << u;
  }
}

TEST(SyntheticSequence, LabelsFollowParkedMovingParked) {
  Scene scene = cube_before_wall();
  // At rest for 1 s, 0.3 m/s for 1 s (10 mm a frame), at rest. Frame 30 is the last that has not moved; five frames
  // after the last motion (frame 60) all is at rest.
  scene.movers[0].path = Path({{1.0, {0, 0, 0}}, {2.0, {0.3, 0, 0}}}, Blend::linear);
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  for (const auto& [index, expected] : {std::pair(0, kAtRest),
                                        {30, kAtRest},
                                        {31, kMoving},
                                        {45, kMoving},
                                        {60, kMoving},
                                        {63, kMoving},
                                        {65, kAtRest}}) {
    sequence.render(index, frame);
    EXPECT_EQ(label(frame, 330, 240), expected) << index;
    EXPECT_EQ(label(frame, 20, 240), kStatic);
  }
  EXPECT_NEAR(frame.world_from_mover[0].translation().x(), 0.3, 1e-12);
}

TEST(SyntheticSequence, EllipsoidIsNearestInItsMiddleAndHidesWhatIsBehind) {
  Scene scene = cube_before_wall();
  scene.movers[0].parts[0].solid.shape = Shape::ellipsoid;
  scene.movers[0].parts[0].solid.half_extents = {0.4, 0.2, 0.3};
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  sequence.render(0, frame);
  EXPECT_NEAR(exact_m(frame, 320, 240), 1.7, 1e-4);  // half a pixel beside the axis
  // Every point seen lies on (x / 0.4)² + (y / 0.2)² + ((z − 2) / 0.3)² = 1.
  int seen = 0;
  for (int v = 0; v < 480; v += 3)
    for (int u = 0; u < 640; u += 3) {
      if (frame.mover_ids.view().row<std::uint8_t>(v)[u] == 0) continue;
      const Vector3d p = sequence.camera().back_project(Vector2d(u, v), static_cast<double>(exact_m(frame, u, v)));
      EXPECT_NEAR((p - Vector3d(0, 0, 2)).cwiseQuotient(Vector3d(0.4, 0.2, 0.3)).norm(), 1.0, 1e-4);
      ++seen;
    }
  // A little less than the ellipse of 0.4 × 0.2 m at 2 m: π · 105 · 52.5 / 9 = 1924 samples; nearer, thus some more.
  EXPECT_NEAR(seen, 1924, 100);
}

TEST(SyntheticSequence, StaticPixelsMeetThemselvesInOtherFrames) {
  Scene scene = walking_people(small());
  scene.sensor.image_sigma = 0;
  SyntheticSequence sequence(scene);
  SyntheticFrame first, second;
  sequence.render(20, first);
  sequence.render(32, second);
  const Pose second_from_first = second.world_from_camera.inverse() * first.world_from_camera;
  ASSERT_GT(second_from_first.translation().norm(), 0.02);
  const Camera& camera = sequence.camera();
  int agree = 0, hidden_by_movers = 0, hidden = 0, seen_through = 0;
  double difference = 0, unrelated = 0;
  for (int v = 2; v < 238; v += 2)
    for (int u = 2; u < 318; u += 2) {
      if (label(first, u, v) != kStatic) continue;
      const Vector3d p =
          second_from_first * camera.back_project(Vector2d(u, v), static_cast<double>(exact_m(first, u, v)));
      const Vector2d pixel = camera.project(p);
      if (!(pixel.x() >= 1 && pixel.y() >= 1 && pixel.x() < 318 && pixel.y() < 238)) continue;
      const int left = static_cast<int>(pixel.x()), top = static_cast<int>(pixel.y());
      const auto [nearest, farthest] =
          std::minmax({exact_m(second, left, top), exact_m(second, left + 1, top), exact_m(second, left, top + 1),
                       exact_m(second, left + 1, top + 1)});
      constexpr double kSlack = 0.002;  // a plane's depth is convex between pixels: less than 2 mm here
      if (p.z() > static_cast<double>(farthest) + kSlack) {
        const auto* const upper = second.mover_ids.view().row<std::uint8_t>(top) + left;
        const auto* const lower = second.mover_ids.view().row<std::uint8_t>(top + 1) + left;
        ++((upper[0] | upper[1] | lower[0] | lower[1]) != 0 ? hidden_by_movers : hidden);
      } else if (p.z() < static_cast<double>(nearest) - kSlack) {
        ++seen_through;
      } else {
        ++agree;
        const double gray = first.gray.view().row<std::uint8_t>(v)[u];
        difference += std::abs(gray - gray_at(second.gray.view(), pixel.x(), pixel.y()));
        unrelated += std::abs(gray - gray_at(second.gray.view(), 317 - pixel.x(), pixel.y()));
      }
    }
  EXPECT_GT(agree, 10000);
  EXPECT_LT(seen_through, agree / 500);  // single pixels beside an edge
  EXPECT_LT(hidden, agree / 50);         // furniture before furniture
  EXPECT_GT(hidden, 0);
  EXPECT_GT(hidden_by_movers, 500);    // the walkers have moved on by a third of a metre
  EXPECT_LT(difference / agree, 7.0);  // interpolation of a picture full of edges
  EXPECT_GT(unrelated, 4 * difference);
}

TEST(SyntheticSequence, CornersMoveByPartsOfAPixel) {
  // Mover and wall shift alike in the picture by a known part of a pixel: camera and cube go sideways so that the wall
  // (3 m) moves by −s px and the cube's front (1.5 m) by +s px.
  constexpr double kLargestError = 0.1, kMeanError = 0.03;  // px; interpolation in `align` alone costs about 0.01
  Scene scene = cube_before_wall();
  SyntheticFrame first, moved;
  SyntheticSequence(scene).render(0, first);
  double sum = 0;
  int count = 0;
  for (const double shift : {0.13, 0.25, 0.37, 0.5, 0.71, 0.9}) {
    const double camera_m = shift * 3.0 / 525.0;
    scene.camera_path.path = Path({{0, {camera_m, 0, 0}}});
    scene.movers[0].path = Path({{0, {camera_m + shift * 1.5 / 525.0, 0, 0}}});
    SyntheticSequence(scene).render(0, moved);
    for (int v = 40; v < 440; v += 25)
      for (int u = 40; u < 600; u += 25) {
        const bool cube = u > 165 && u < 475 && v > 85 && v < 395;
        const bool wall = u < 125 || u > 515 || v < 45 || v > 435;
        if (!cube && !wall) continue;
        Vector2d found;
        if (!align(first.gray.view(), moved.gray.view(), u, v, found)) continue;
        const Vector2d error = found - Vector2d(u + (cube ? shift : -shift), v);
        EXPECT_LT(error.norm(), kLargestError) << u << ' ' << v << ' ' << shift;
        sum += error.norm();
        ++count;
      }
  }
  ASSERT_GT(count, 300);
  EXPECT_LT(sum / count, kMeanError);
  RecordProperty("patches", count);
}

TEST(SyntheticSequence, DistortedLensSeesTheCubesCornersWhereItsModelSays) {
  Scene scene = cube_before_wall();
  AnyDistortion lens;
  lens.model = BrownConrady{-0.2, 0.05, 0.001, -0.001, 0};
  scene.camera = Camera(525, 525, 319.5, 239.5, 640, 480, lens);
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  sequence.render(0, frame);
  const auto id = [&](const Vector3d& p) {
    const Vector2d pixel = scene.camera.distort(scene.camera.project(p));
    return static_cast<int>(
        frame.mover_ids.view().row<std::uint8_t>(static_cast<int>(std::lround(pixel.y())))[std::lround(pixel.x())]);
  };
  constexpr double kPixel = 1.5 / 525;  // metres at the cube's front
  for (const double x : {-1.0, 1.0})
    for (const double along : {-0.49, -0.2, 0.0, 0.35, 0.49}) {
      EXPECT_EQ(id({x * (0.5 - kPixel), along, 1.5}), 1);
      EXPECT_EQ(id({x * (0.5 + kPixel), along, 1.5}), 0);
      EXPECT_EQ(id({along, x * (0.5 - kPixel), 1.5}), 1);
      EXPECT_EQ(id({along, x * (0.5 + kPixel), 1.5}), 0);
    }
}

TEST(SyntheticSequence, ImageNoiseHasItsDeviationAndGrayIsTheColoursLuma) {
  Scene scene = cube_before_wall();
  SyntheticFrame clean, noisy;
  SyntheticSequence(scene).render(3, clean);
  scene.sensor.image_sigma = 2.0;
  SyntheticSequence(scene).render(3, noisy);
  double sum = 0, squares = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const double error = noisy.gray.view().row<std::uint8_t>(v)[u] - clean.gray.view().row<std::uint8_t>(v)[u];
      sum += error;
      squares += error * error;
    }
  const double count = 640 * 480;
  EXPECT_NEAR(sum / count, 0.0, 0.05);                 // rounding and the ends of the range
  EXPECT_NEAR(std::sqrt(squares / count), 2.0, 0.15);  // both pictures are rounded: √(4 + 2 / 12) = 2.04
  ImageBuffer luma;
  gray_from_bgr(noisy.colour.view(), luma);
  EXPECT_EQ(bytes(luma.view()), bytes(noisy.gray.view()));
}

TEST(SyntheticSequence, FlickerChangesBrightnessWithinItsBound) {
  Scene scene = cube_before_wall();
  scene.sensor.exposure_flicker = 0.1;
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  double lowest = 1e9, highest = 0;
  for (int i = 0; i < 12; ++i) {
    sequence.render(i, frame);
    double sum = 0;
    for (const std::uint8_t value : bytes(frame.gray.view())) sum += value;
    lowest = std::min(lowest, sum);
    highest = std::max(highest, sum);
  }
  EXPECT_GT(highest / lowest, 1.05);
  EXPECT_LT(highest / lowest, 1.1 / 0.9);
}

TEST(SyntheticSequence, EqualSeedsGiveEqualBytesInAnyOrder) {
  SyntheticSequence sequence(demo(small(5))), again(demo(small(5))), other(demo(small(6)));
  SyntheticFrame frame, repeated, different;
  sequence.render(7, frame);
  again.render(30, repeated);
  again.render(7, repeated);  // into a used frame, after another one
  other.render(7, different);
  EXPECT_EQ(bytes(frame.gray.view()), bytes(repeated.gray.view()));
  EXPECT_EQ(bytes(frame.colour.view()), bytes(repeated.colour.view()));
  EXPECT_EQ(bytes(frame.depth.view()), bytes(repeated.depth.view()));
  EXPECT_EQ(bytes(frame.exact_depth.view()), bytes(repeated.exact_depth.view()));
  EXPECT_EQ(bytes(frame.labels.view()), bytes(repeated.labels.view()));
  EXPECT_EQ(frame.world_from_camera.matrix(), repeated.world_from_camera.matrix());
  EXPECT_NE(bytes(frame.gray.view()), bytes(different.gray.view()));
  EXPECT_NE(bytes(frame.depth.view()), bytes(different.depth.view()));
}

TEST(SyntheticSequence, NoiseDiffersFromFrameToFrame) {
  SyntheticSequence sequence(stationary_camera(small()));
  SyntheticFrame first, second;
  sequence.render(0, first);
  sequence.render(1, second);
  EXPECT_NE(bytes(first.depth.view()), bytes(second.depth.view()));
  EXPECT_NE(bytes(first.gray.view()), bytes(second.gray.view()));
}

TEST(SyntheticSequence, RenderingAgainAllocatesNothing) {
  SyntheticSequence sequence(walking_people(small()));
  SyntheticFrame frame;
  sequence.render(40, frame);
  const std::uint8_t* const pixels = frame.gray.view().data;
  EXPECT_EQ(counted_allocations::count_in([&] { sequence.render(41, frame); }), 0u);
  EXPECT_EQ(frame.gray.view().data, pixels);
}

TEST(SyntheticSequence, RenderingAgainWithARealisticSensorAllocatesNothing) {
  Scene scene = walking_people(small());
  scene.sensor = realistic_kinect();
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  sequence.render(40, frame);
  EXPECT_EQ(counted_allocations::count_in([&] { sequence.render(41, frame); }), 0u);
}

TEST(SyntheticSequence, FurnitureIdsAreThoseOfWhatIsSeen) {
  Scene scene = cube_before_wall();
  scene.furniture.emplace_back(Shape::cuboid, Vector3d(0.1, 0.1, 0.1), Vector3d(-0.9, 0, 2), print(3));
  SyntheticFrame frame;
  SyntheticSequence(scene).render(0, frame);
  const std::uint8_t* const row = frame.furniture_ids.row<std::uint8_t>(240);
  EXPECT_EQ(row[320], 0);                 // the cube, a mover
  EXPECT_EQ(row[600], 1);                 // the wall
  EXPECT_EQ(row[319 - 525 * 9 / 19], 2);  // the small cuboid: its front at z = 1.9 m
}

TEST(SyntheticSequence, TimestampsCountFromOneSecondAtTheFrameRate) {
  SceneOptions options = small();
  SyntheticFrame frame;
  SyntheticSequence(static_room(options)).render(45, frame);
  EXPECT_DOUBLE_EQ(frame.timestamp_s, 2.5);
  EXPECT_DOUBLE_EQ(frame.view().timestamp_s, 2.5);
  options.frame_rate_hz = 10;
  SyntheticSequence(static_room(options)).render(45, frame);
  EXPECT_DOUBLE_EQ(frame.timestamp_s, 5.5);
}

TEST(SyntheticSequence, ViewHandsOutAllImages) {
  SyntheticSequence sequence(static_room(small()));
  SyntheticFrame frame;
  sequence.render(0, frame);
  const FrameView view = frame.view();
  EXPECT_EQ(view.gray.format, PixelFormat::gray8);
  EXPECT_EQ(view.colour.format, PixelFormat::bgr8);
  EXPECT_EQ(view.depth.image.format, PixelFormat::depth16);
  EXPECT_EQ(view.gray.width, 320);
  EXPECT_DOUBLE_EQ(view.depth.factor, 5000.0);
}

TEST(SyntheticSequence, RefusesScenesThatMakeNoSequence) {
  const auto refused = [](auto spoil) {
    Scene scene = cube_before_wall();
    spoil(scene);
    EXPECT_THROW(SyntheticSequence{scene}, Error);
  };
  refused([](Scene& scene) { scene.frame_count = 0; });
  refused([](Scene& scene) { scene.frame_rate_hz = std::nan(""); });
  refused([](Scene& scene) { scene.motion_rule.window_frames = 0; });
  refused([](Scene& scene) { scene.movers[0].parts[0].solid.half_extents.x() = 0; });
  refused([](Scene& scene) { scene.furniture[0].textures[3] = nullptr; });
  SyntheticSequence sequence(cube_before_wall());
  SyntheticFrame frame;
  EXPECT_THROW(sequence.render(-1, frame), Error);
}

}  // namespace
}  // namespace stillpoint::synthetic::renderer_test
