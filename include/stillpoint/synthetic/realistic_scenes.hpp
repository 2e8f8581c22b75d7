// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Scenes in the room with the difficulties of recordings: a realistic depth sensor, few frames per second, static
// objects beside moving ones, slow movers. The street is in street.hpp.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/movers.hpp"
#include "stillpoint/synthetic/path.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::synthetic {

/// Name of the books and the magazine in `box_among_books`, for `labels_of`.
inline constexpr char kBook[] = "book";

namespace detail {

/// To and fro across the view at one distance, 0.75 to 0.95 m/s.
inline Path crossing(double lane_z_m, double end_x_m, double start_x_m, double seconds, Random& random) {
  const double metres_per_s = random.uniform(0.75, 0.95);
  const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
  PathBuilder way({start_x_m, 0, lane_z_m}, side * 1.5707963);
  const int legs = 2 + static_cast<int>(seconds * metres_per_s / (2 * end_x_m));
  for (int i = 0; i < legs; ++i) way.walk_to({(i % 2 == 0 ? side : -side) * end_x_m, 0, lane_z_m}, metres_per_s);
  return way.path(Blend::linear);
}

/// A screen on the back wall and a refined kettle on the table: neither has a depth.
inline void add_specular_objects(std::vector<Solid>& solids) {
  const TexturePtr glass = solids.back().textures[0];
  solids.emplace_back(Shape::cuboid, Vector3d(0.40, 0.24, 0.02), Vector3d(-0.95, -1.55, 3.57), glass);
  solids.back().specular = true;
  solids.emplace_back(Shape::ellipsoid, Vector3d(0.09, 0.12, 0.09), Vector3d(-1.55, -0.86, 2.10), glass);
  solids.back().specular = true;
}

/// A closed book of its own colours. @param centre in the world
inline Solid book(const Vector3d& half_extents, const Vector3d& centre, double yaw, Random& random) {
  const Bgr covers[] = {{60, 60, 170}, {150, 90, 50}, {70, 130, 70}, {50, 150, 200}, {190, 190, 190}, {120, 70, 120}};
  TextureStyle style;
  style.colours = {covers[random.index(6)], {240, 240, 240}, {40, 40, 40}, covers[random.index(6)]};
  style.cell_m = 0.1;
  style.largest_mark_m = 0.05;
  style.smallest_mark_m = 0.006;
  style.coverage = 0.2;
  Solid solid(Shape::cuboid, half_extents, centre, paint(128, 500, style, random.bits()), yaw);
  solid.name = kBook;
  solid.infrared_albedo = random.uniform(0.1, 0.8);
  return solid;
}

/// A table 0.76 m high with two stacks of books, a row of books that stand, and a magazine. Free for a box of 0.26 m
/// (x) and 0.18 m (z): the strip from x = -0.41 to 0.35, z = 0.91 to 1.09.
inline void add_table_with_books(std::uint64_t seed, std::vector<Solid>& solids) {
  constexpr double kTop_m = 0.76, kGap_m = 0.003;
  Random random(seed);
  TextureStyle wood;
  wood.ground = Ground::planks;
  wood.colours = {{120, 150, 180}, {80, 110, 140}, {170, 200, 220}, {60, 84, 110}};
  wood.cell_m = wood.largest_mark_m = 0.12;
  wood.coverage = 0.14;
  const TexturePtr top = paint(512, 400, wood, random.bits());
  add_table({0, 0, 1.0}, {0.85, 0.025, 0.45}, kTop_m, top, top, solids);
  for (const double side_x_m : {-0.41, 0.35}) {  // what the box touches before it moves, and where it stops
    const double half_x_m = 0.11, side = side_x_m < 0 ? -1.0 : 1.0;
    double height_m = kTop_m;
    for (int i = 0; i < 3; ++i) {
      const double half_height_m = random.uniform(0.012, 0.022);
      height_m += half_height_m;
      solids.push_back(book({half_x_m - 0.01 * i, half_height_m, 0.08 - 0.005 * i},
                            {side_x_m + side * (kGap_m + half_x_m), -height_m, 1.0}, 0.0, random));
      height_m += half_height_m;
    }
  }
  for (double x_m = -0.32; x_m < 0.28;) {  // the row behind the strip
    const double half_thickness_m = random.uniform(0.014, 0.024), half_height_m = random.uniform(0.095, 0.125);
    x_m += half_thickness_m;
    solids.push_back(book({half_thickness_m, half_height_m, 0.07},
                          {x_m, -kTop_m - half_height_m, 1.09 + kGap_m + 0.07 + random.uniform(0.0, 0.01)}, 0.0,
                          random));
    x_m += half_thickness_m + 0.001;
  }
  solids.push_back(book({0.105, 0.003, 0.14}, {0.03, -kTop_m - 0.003, 0.91 - kGap_m - 0.14}, 0.0, random));  // magazine
  solids.push_back(book({0.075, 0.018, 0.10}, {-0.27, -kTop_m - 0.018, 0.78}, 0.1, random));
}

}  // namespace detail

/// Five people cross to and fro, 1.8 to 3.2 m in front of a stationary camera, past each other.
inline Scene five_people(const SceneOptions& options) {
  Scene scene = detail::stage("five_people", options);
  scene.sensor = realistic_kinect();
  constexpr double kCamera_z_m = -1.85;
  scene.camera_path = {Path({{0.0, {0.0, -1.42, kCamera_z_m}, 0.0, -0.12, 0.0}}), {}};
  detail::add_specular_objects(scene.furniture);
  scene.motion_rule.window_frames = std::max(1, static_cast<int>(std::lround(options.frame_rate_hz / 6.0)));
  Random random(options.seed + 30);
  const double seconds = options.frames / options.frame_rate_hz;
  for (int i = 0; i < 5; ++i) {
    const double lane_z_m = -0.05 + 0.35 * i, end_x_m = 0.61 * (lane_z_m - kCamera_z_m) + 0.35;  // just out of view
    const double start_x_m = end_x_m * (0.4 * ((2 * i + 1) % 5) - 0.8);  // spread over the view, in another order
    scene.movers.push_back(walking_person(detail::crossing(lane_z_m, end_x_m, start_x_m, seconds, random),
                                          options.seed + 40 + static_cast<std::uint64_t>(i)));
  }
  return scene;
}
/// Eight seconds at 5 Hz: a person who walks is 0.15 to 0.25 m further in each frame.
inline Scene five_people() {
  SceneOptions options;
  options.frame_rate_hz = 5.0;
  options.frames = 40;
  return five_people(options);
}

/// A box that no detector knows is pushed over a table, to and fro, along books (`kBook`) that it touches or leaves
/// 3 mm to: stacks at both ends of its way, books that stand behind it, a magazine in front of it.
inline Scene box_among_books(const SceneOptions& options = {}) {
  Scene scene = detail::stage("box_among_books", options);
  scene.sensor = realistic_kinect();
  scene.camera_path = {Path({{0.0, {-0.10, -1.36, 0.00}, 0.08, -0.50, 0.0},
                             {1.2, {0.02, -1.34, 0.05}, 0.00, -0.49, 0.02},
                             {2.4, {0.12, -1.38, 0.00}, -0.10, -0.51, 0.0},
                             {3.6, {0.00, -1.35, -0.04}, 0.02, -0.48, -0.02},
                             {4.8, {-0.10, -1.36, 0.00}, 0.08, -0.50, 0.0}},
                            Blend::spline),
                       {0.004, 0.004, options.seed + 2}};
  detail::add_table_with_books(options.seed + 31, scene.furniture);
  scene.movers.push_back(printed_box(PathBuilder({-0.28, -0.76, 1.0})
                                         .stand(0.4)
                                         .slide_to({0.22, -0.76, 1.0}, 0.25)
                                         .stand(0.5)
                                         .slide_to({-0.10, -0.76, 1.0}, 0.25)
                                         .path(),
                                     {0.13, 0.10, 0.09}, options.seed + 20));
  return scene;
}

/// A person two metres away stands for a second and then walks across the view, by default at 0.1 m/s; the camera is in
/// the hand. `first_moving_frame` tells the frame of the first step.
inline Scene slow_walker(const SceneOptions& options = {}, double metres_per_s = 0.1) {
  Scene scene = detail::stage("slow_walker", options);
  scene.sensor = realistic_kinect();
  scene.camera_path = detail::wandering_camera(options);
  detail::add_specular_objects(scene.furniture);
  const double seconds = options.frames / options.frame_rate_hz;
  const Vector3d start(-0.15, 0, 1.25);
  scene.movers.push_back(walking_person(PathBuilder(start, 1.5707963)
                                            .stand(1.0)
                                            .slide_to(start + Vector3d(metres_per_s * seconds, 0, 0), metres_per_s)
                                            .path(Blend::linear),
                                        options.seed + 10));
  return scene;
}

}  // namespace stillpoint::synthetic
