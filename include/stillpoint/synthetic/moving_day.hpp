// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A scene in which moving objects fill half of the view: an odometry without the filter follows them.

#include <cstdint>
#include <utility>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/movers.hpp"
#include "stillpoint/synthetic/path.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::synthetic {

/// A trolley of 1.3 x 0.65 m with five cartons on it, 1.5 m high. Origin on the floor below its middle.
inline Mover loaded_trolley(Path path, std::uint64_t seed) {
  Random random(seed);
  const auto surface = [&random](const Bgr& ground) {
    TextureStyle style;
    style.colours = {ground, {70, 104, 136}, {40, 54, 70}, {226, 232, 238}};
    style.cell_m = 0.5;
    style.largest_mark_m = 0.22;
    style.smallest_mark_m = 0.012;
    style.coverage = 0.04;
    return paint(512, 420, style, random.bits());
  };
  struct Carton {
    Vector3d half_extents, centre;
    double yaw;
    Bgr colour;
  };
  const Carton cartons[] = {{{0.30, 0.24, 0.26}, {-0.31, -0.44, 0.00}, 0.02, {110, 152, 190}},
                            {{0.29, 0.24, 0.25}, {0.31, -0.44, 0.01}, -0.03, {126, 166, 200}},
                            {{0.28, 0.20, 0.24}, {-0.28, -0.88, 0.00}, -0.06, {100, 140, 176}},
                            {{0.30, 0.22, 0.25}, {0.32, -0.90, 0.00}, 0.04, {120, 160, 196}},
                            {{0.34, 0.20, 0.22}, {-0.12, -1.29, 0.00}, 0.05, {140, 176, 206}}};
  Mover trolley;
  trolley.path = std::move(path);
  for (const Carton& carton : cartons)
    trolley.parts.push_back(
        {Solid(Shape::cuboid, carton.half_extents, carton.centre, surface(carton.colour), carton.yaw), {}});
  const Solid board(Shape::cuboid, {0.66, 0.02, 0.32}, {0, -0.17, 0}, surface({60, 60, 64}));
  trolley.parts.push_back({board, {}});
  return trolley;
}

/// Somebody pushes a loaded trolley across the view of a hand-held camera, somebody else walks behind it. No detector
/// knows the trolley. The odometry of examples/ is off by half a metre without the filter, by a few millimetres with
/// it.
inline Scene moving_day(const SceneOptions& options) {
  Scene scene = detail::stage("moving_day", options);
  scene.camera_path = detail::wandering_camera(options);
  const auto across = [](double ahead_m, double yaw) {
    constexpr double kMetresPerSecond = 0.6;
    return PathBuilder({-1.9 + ahead_m, 0, 1.1}, yaw)
        .stand(0.1)
        .slide_to({1.9 + ahead_m, 0, 1.2}, kMetresPerSecond)
        .path();
  };
  constexpr double kToTheRight = 1.5707963;
  scene.movers.push_back(loaded_trolley(across(0.0, 0.0), options.seed + 20));
  scene.movers.push_back(walking_person(across(-0.95, kToTheRight), options.seed + 10));
  scene.movers.push_back(walking_person(PathBuilder({0.75, 0, 1.9}, -kToTheRight)
                                            .slide_to({-0.9, 0, 1.9}, 0.6)
                                            .walk_to({1.0, 0, 1.8}, 0.7)
                                            .path(Blend::linear),
                                        options.seed + 13));
  return scene;
}
/// Five seconds.
inline Scene moving_day() { return moving_day(SceneOptions{}); }

}  // namespace stillpoint::synthetic
