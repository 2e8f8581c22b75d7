// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Ready-made scenes, each one difficulty of dynamic places. All happen in the same kind of room.

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/movers.hpp"
#include "stillpoint/synthetic/path.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// What all scenes have in common.
struct SceneOptions {
  std::uint64_t seed = Random::kDefaultSeed;  ///< of textures, hand and sensor noise
  int frames = 150;
  int width = 640;
  int height = 480;
  double frame_rate_hz = 30.0;
};

namespace detail {

/// @throws Error unless the size is at least 16 pixels a side, and frames and their rate are at least one and more than
/// 0.
inline void require(const SceneOptions& options) {
  if (options.width < 16 || options.height < 16)
    throw Error("scene: size is " + std::to_string(options.width) + " x " + std::to_string(options.height) +
                ", expected at least 16 x 16 pixels");
  if (options.frames < 1) throw Error("scene: frames is " + std::to_string(options.frames) + ", expected at least 1");
  if (!(options.frame_rate_hz > 0) || !std::isfinite(options.frame_rate_hz))
    throw Error("scene: frame_rate_hz is " + std::to_string(options.frame_rate_hz) +
                ", expected a finite number above 0");
}

/// The room with a camera of 62 degrees across; no mover.
/// @throws Error as `require`
inline Scene stage(const char* name, const SceneOptions& options) {
  require(options);
  const double focal_px = 525.0 * options.width / 640.0;
  Scene scene;
  scene.name = name;
  scene.camera =
      Camera(focal_px, focal_px, 0.5 * (options.width - 1), 0.5 * (options.height - 1), options.width, options.height);
  scene.furniture = furnished_room(options.seed + 1);
  scene.frame_count = options.frames;
  scene.frame_rate_hz = options.frame_rate_hz;
  scene.seed = options.seed;
  return scene;
}

inline HandShake hand(const SceneOptions& options) { return {0.008, 0.006, options.seed + 2}; }

/// A camera in the hand that wanders half a metre to each side at 0.2 m/s in the mean and looks into the room.
inline CameraPath wandering_camera(const SceneOptions& options) {
  return {Path({{0.0, {-0.35, -1.45, -0.80}, 0.12, -0.20, 0.0},
                {1.5, {-0.10, -1.40, -0.62}, 0.03, -0.18, 0.02},
                {3.0, {0.25, -1.48, -0.75}, -0.08, -0.22, 0.0},
                {4.5, {0.40, -1.40, -0.50}, -0.14, -0.20, -0.02},
                {6.0, {0.05, -1.36, -0.65}, -0.02, -0.17, 0.0},
                {7.5, {-0.35, -1.45, -0.80}, 0.12, -0.20, 0.0}},
               Blend::spline),
          hand(options)};
}

inline CameraPath stationary_camera_path() { return {Path({{0.0, {0.0, -1.42, -0.80}, 0.0, -0.19, 0.0}}), {}}; }

inline Path box_path() {
  return PathBuilder({0.85, 0, 1.05}, 0.3)
      .stand(0.4)
      .slide_to({0.10, 0, 1.35}, 0.45, 0.5)
      .stand(0.5)
      .slide_to({-0.65, 0, 1.10}, 0.45, -0.7)
      .stand(0.6)
      .slide_to({0.45, 0, 1.60}, 0.5, 0.9)
      .path();
}

inline Path first_walk() {
  return PathBuilder({-1.00, 0, 1.25}, 1.5707963)
      .walk_to({0.15, 0, 1.15}, 0.75)
      .stand(0.8)
      .walk_to({0.95, 0, 1.40}, 0.7)
      .stand(0.3)
      .walk_to({-0.90, 0, 0.90}, 0.8)
      .path();
}

inline Path second_walk() {
  return PathBuilder({1.20, 0, 1.90}, -1.5707963)
      .stand(0.5)
      .walk_to({-0.10, 0, 1.90}, 0.7)
      .stand(0.9)
      .walk_to({-0.60, 0, 0.90}, 0.6)
      .stand(0.5)
      .walk_to({0.95, 0, 1.70}, 0.8)
      .path();
}

}  // namespace detail

/// Nothing moves but the camera.
inline Scene static_room(const SceneOptions& options = {}) {
  Scene scene = detail::stage("static_room", options);
  scene.camera_path = detail::wandering_camera(options);
  return scene;
}

/// Two people cross the room, each stands still now and then.
inline Scene walking_people(const SceneOptions& options = {}) {
  Scene scene = detail::stage("walking_people", options);
  scene.camera_path = detail::wandering_camera(options);
  scene.movers.push_back(walking_person(detail::first_walk(), options.seed + 10));
  scene.movers.push_back(walking_person(detail::second_walk(), options.seed + 13));
  return scene;
}

/// Two people pass each other before a stationary camera, 0.7 m apart, each at 0.8 m/s.
inline Scene crossing_people(const SceneOptions& options = {}) {
  constexpr double kQuarter_rad = 1.5707963, kSpeed_m_s = 0.8;
  Scene scene = detail::stage("crossing_people", options);
  scene.camera_path = detail::stationary_camera_path();
  const auto across = [](double z_m, double side) {
    return PathBuilder({-side, 0, z_m}, side * kQuarter_rad).slide_to({side, 0, z_m}, kSpeed_m_s).path(Blend::linear);
  };
  scene.movers.push_back(walking_person(across(1.2, 1.0), options.seed + 10));
  scene.movers.push_back(walking_person(across(1.9, -1.0), options.seed + 13));
  return scene;
}

/// One person walks at 0.8 m/s behind a pillar 0.4 m wide and is covered for about half a second; the camera is
/// stationary.
inline Scene person_behind_pillar(const SceneOptions& options = {}) {
  Scene scene = crossing_people(options);
  scene.name = "person_behind_pillar";
  scene.movers.erase(scene.movers.begin());
  const TexturePtr texture = scene.furniture.back().textures[0];
  scene.furniture.emplace_back(Shape::cuboid, Vector3d(0.2, 1.2, 0.1), Vector3d(0.05, -1.2, 0.9), texture);
  return scene;
}

/// A box that no detector knows is slid over the floor and turned, with pauses.
inline Scene pushed_box(const SceneOptions& options = {}) {
  Scene scene = detail::stage("pushed_box", options);
  scene.camera_path = detail::wandering_camera(options);
  scene.movers.push_back(printed_box(detail::box_path(), {0.32, 0.30, 0.26}, options.seed + 20));
  return scene;
}

/// A box moves slowly sideways, by default at 2 cm/s: less than a pixel per frame. With the default `MotionRule` its
/// pixels count as at rest (128); lengthen `window_frames` to have them 255.
inline Scene slow_mover(const SceneOptions& options = {}, double metres_per_s = 0.02) {
  Scene scene = detail::stage("slow_mover", options);
  scene.camera_path = detail::wandering_camera(options);
  const double seconds = options.frames / options.frame_rate_hz;
  const Path path = PathBuilder({-0.25, 0, 1.15}, 0.3)
                        .slide_to({-0.25 + metres_per_s * seconds, 0, 1.15}, metres_per_s)
                        .path(Blend::linear);
  scene.movers.push_back(printed_box(path, {0.30, 0.35, 0.22}, options.seed + 20));
  return scene;
}

/// A person sits still; after a second only a forearm waves, with a pause.
inline Scene waving_hand(const SceneOptions& options = {}) {
  Scene scene = detail::stage("waving_hand", options);
  scene.camera_path = detail::wandering_camera(options);
  const Path seat = PathBuilder({0.05, 0, 1.15}, 3.1).path();
  scene.movers.push_back(waving_person(seat, 1.0, 1.0 + options.frames / options.frame_rate_hz, options.seed + 10));
  const TexturePtr stool = scene.furniture.back().textures[0];
  scene.furniture.emplace_back(Shape::cuboid, Vector3d(0.18, 0.21, 0.18), Vector3d(0.05, -0.21, 1.15), stool);
  return scene;
}

/// A box comes straight at a stationary camera along its line of sight, stands, and goes back: hardly any motion in
/// the image, all of it in depth.
inline Scene along_the_ray(const SceneOptions& options = {}) {
  Scene scene = detail::stage("along_the_ray", options);
  scene.camera_path = detail::stationary_camera_path();
  const Pose world_from_camera = scene.camera_path.world_from_camera(0.0);
  const Vector3d sight = world_from_camera.linear().col(2), eye = world_from_camera.translation();
  const Vector3d below_centre(0, 0.25, 0);  // from the box's centre to its origin
  const Path path = PathBuilder(eye + 2.6 * sight + below_centre, 0.2)
                        .stand(0.3)
                        .slide_to(eye + 1.3 * sight + below_centre, 0.6)
                        .stand(0.5)
                        .slide_to(eye + 2.4 * sight + below_centre, 0.6)
                        .path();
  scene.movers.push_back(printed_box(path, {0.27, 0.25, 0.22}, options.seed + 20));
  return scene;
}

/// Someone stands right before a stationary camera, fills more than three quarters of its view, and sways.
inline Scene crowded_view(const SceneOptions& options = {}) {
  Scene scene = detail::stage("crowded_view", options);
  scene.camera_path = {Path({{0.0, {0.0, -1.17, -0.80}, 0.0, 0.0, 0.0}}), {}};
  PathBuilder sway({-0.03, 0, -0.22}, 0.1);
  for (int i = 0; i < 20; ++i) sway.slide_to({i % 2 == 0 ? 0.04 : -0.03, 0, -0.22}, 0.1, i % 2 == 0 ? 0.15 : -0.15);
  Mover person = walking_person(sway.path(), options.seed + 10);
  for (Part& part : person.parts) part.joint.stride_rad = 0.0;  // no steps
  scene.movers.push_back(person);
  return scene;
}

/// The camera turns about its centre without any translation, in the static room or past two walkers.
inline Scene pure_rotation(const SceneOptions& options = {}, bool with_people = false) {
  Scene scene = with_people ? walking_people(options) : detail::stage("pure_rotation", options);
  scene.name = "pure_rotation";
  scene.camera_path = {Path({{0.0, {0.0, -1.42, -0.80}, -0.25, -0.15, 0.0},
                             {1.5, {0.0, -1.42, -0.80}, 0.20, -0.22, 0.05},
                             {3.0, {0.0, -1.42, -0.80}, 0.00, -0.10, -0.04},
                             {4.5, {0.0, -1.42, -0.80}, -0.25, -0.15, 0.0}},
                            Blend::spline),
                       {}};
  return scene;
}

/// The camera stands on a tripod while two people walk.
inline Scene stationary_camera(const SceneOptions& options = {}) {
  Scene scene = walking_people(options);
  scene.name = "stationary_camera";
  scene.camera_path = detail::stationary_camera_path();
  return scene;
}

/// What the program shows first: a hand-held camera, a person who walks, a box that is pushed. Two seconds.
inline Scene demo(SceneOptions options) {
  Scene scene = detail::stage("demo", options);
  scene.camera_path = detail::wandering_camera(options);
  scene.movers.push_back(walking_person(
      PathBuilder({-0.90, 0, 1.35}, 1.5707963).slide_to({0.45, 0, 1.40}, 0.70).path(Blend::linear), options.seed + 13));
  scene.movers.push_back(
      printed_box(PathBuilder({0.80, 0, 1.00}, 0.3).stand(0.3).slide_to({0.30, 0, 0.95}, 0.45, 0.6).stand(1.0).path(),
                  {0.24, 0.22, 0.20}, options.seed + 20));
  return scene;
}
inline Scene demo() {
  SceneOptions options;
  options.frames = 60;
  return demo(options);
}

}  // namespace stillpoint::synthetic
