// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The cast of the ready-made scenes: people of ellipsoids and boxes, and a printed box.

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/texture.hpp"

namespace stillpoint::synthetic {

/// Textures of a person's clothes and skin.
struct Wardrobe {
  TexturePtr shirt, trousers, skin, hair, shoes;
};

inline Wardrobe wardrobe(std::uint64_t seed) {
  Random random(seed);
  const Bgr shirts[] = {{60, 60, 190}, {170, 110, 40}, {80, 150, 70}, {60, 150, 210}, {150, 90, 150}};
  const Bgr shirt = shirts[seed % 5];  // neighbouring seeds do not dress alike
  const auto cloth = [&random](Ground ground, std::vector<Bgr> colours, double cell_m, double mark_m, double coverage) {
    TextureStyle style;
    style.ground = ground;
    style.colours = std::move(colours);
    style.cell_m = cell_m;
    style.largest_mark_m = mark_m;
    style.smallest_mark_m = 0.006;
    style.coverage = coverage;
    return paint(256, 400, style, random.bits());
  };
  Wardrobe clothes;
  clothes.shirt = cloth(Ground::stripes, {shirt, {235, 235, 235}, {50, 40, 40}, {120, 190, 220}}, 0.08, 0.1, 0.2);
  clothes.trousers =
      cloth(Ground::blocks, {{110, 80, 56}, {160, 128, 100}, {56, 36, 24}, {220, 200, 180}}, 0.06, 0.06, 0.2);
  clothes.skin =
      cloth(Ground::plain, {{140, 168, 214}, {110, 136, 186}, {160, 186, 226}, {90, 106, 150}}, 0.1, 0.03, 0.12);
  clothes.hair = cloth(Ground::stripes, {{36, 50, 70}, {20, 28, 40}, {60, 84, 110}}, 0.02, 0.03, 0.3);
  clothes.shoes = cloth(Ground::plain, {{50, 50, 56}, {200, 200, 204}, {30, 30, 34}}, 0.1, 0.05, 0.2);
  return clothes;
}

namespace detail {

constexpr double kBlackAlbedo = 0.05;  // of hair and black shoes in infrared light: a Kinect has no depth there

inline Part black(Part part) {
  part.solid.infrared_albedo = kBlackAlbedo;
  return part;
}

inline Part ellipsoid(const Vector3d& half, const Vector3d& centre, const TexturePtr& texture,
                      const Joint& joint = {}) {
  return {Solid(Shape::ellipsoid, half, centre, texture), joint};
}

inline void add_trunk(double lift, const Wardrobe& clothes, std::vector<Part>& parts) {
  parts.push_back(ellipsoid({0.215, 0.36, 0.14}, {0, -1.16 + lift, 0}, clothes.shirt));
  parts.push_back(ellipsoid({0.250, 0.110, 0.105}, {0, -1.37 + lift, 0}, clothes.shirt));  // shoulders
  parts.push_back(ellipsoid({0.185, 0.17, 0.135}, {0, -0.92 + lift, 0}, clothes.trousers));
  parts.push_back(ellipsoid({0.060, 0.10, 0.060}, {0, -1.50 + lift, 0}, clothes.skin));
  parts.push_back(ellipsoid({0.085, 0.120, 0.100}, {0, -1.63 + lift, 0.01}, clothes.skin));
  parts.push_back(black(ellipsoid({0.092, 0.095, 0.100}, {0, -1.68 + lift, -0.015}, clothes.hair)));
}

/// An arm that hangs from the shoulder. @param side -1 left, 1 right
inline void add_arm(double side, double lift, const Wardrobe& clothes, const Joint& joint, std::vector<Part>& parts) {
  parts.push_back(ellipsoid({0.060, 0.19, 0.065}, {side * 0.25, -1.25 + lift, 0}, clothes.shirt, joint));
  parts.push_back(ellipsoid({0.046, 0.17, 0.050}, {side * 0.26, -0.96 + lift, 0.02}, clothes.shirt, joint));
  parts.push_back(ellipsoid({0.040, 0.09, 0.045}, {side * 0.26, -0.75 + lift, 0.03}, clothes.skin, joint));
}

}  // namespace detail

/// A person of 1.75 m who walks where the path leads, looking along its z axis; legs and arms swing with the way gone
/// and hold when it stands. Origin on the floor between the feet.
inline Mover walking_person(Path path, std::uint64_t seed) {
  const Wardrobe clothes = wardrobe(seed);
  Mover person;
  person.class_name = "person";
  person.path = std::move(path);
  detail::add_trunk(0.0, clothes, person.parts);
  for (const double side : {-1.0, 1.0}) {
    Joint hip;
    hip.pivot = {side * 0.09, -0.90, 0};
    hip.stride_rad = side * 0.42;
    person.parts.push_back(detail::ellipsoid({0.085, 0.26, 0.095}, {side * 0.095, -0.68, 0}, clothes.trousers, hip));
    person.parts.push_back(detail::ellipsoid({0.065, 0.25, 0.070}, {side * 0.095, -0.29, 0}, clothes.trousers, hip));
    person.parts.push_back(
        detail::black({Solid(Shape::cuboid, {0.045, 0.035, 0.12}, {side * 0.095, -0.035, 0.05}, clothes.shoes), hip}));
    Joint shoulder;
    shoulder.pivot = {side * 0.24, -1.42, 0};
    shoulder.stride_rad = -side * 0.35;
    detail::add_arm(side, 0.0, clothes, shoulder, person.parts);
  }
  return person;
}

/// A person who sits still on a stool, looking along the path's z axis, and waves the right forearm and hand from
/// `start_s` to `end_s`. Origin on the floor below the seat.
inline Mover waving_person(Path path, double start_s, double end_s, std::uint64_t seed) {
  constexpr double kLift = 0.42;  // the trunk is that much lower than a standing person's
  const Wardrobe clothes = wardrobe(seed);
  Mover person;
  person.class_name = "person";
  person.path = std::move(path);
  detail::add_trunk(kLift, clothes, person.parts);
  for (const double side : {-1.0, 1.0}) {
    person.parts.push_back(detail::ellipsoid({0.085, 0.085, 0.25}, {side * 0.10, -0.50, 0.20}, clothes.trousers));
    person.parts.push_back(detail::ellipsoid({0.065, 0.25, 0.070}, {side * 0.10, -0.27, 0.40}, clothes.trousers));
    person.parts.push_back(
        detail::black({Solid(Shape::cuboid, {0.045, 0.035, 0.12}, {side * 0.10, -0.035, 0.45}, clothes.shoes), {}}));
  }
  detail::add_arm(-1.0, kLift, clothes, {}, person.parts);
  Joint elbow;
  elbow.pivot = {0.27, -0.80, 0.08};
  elbow.axis = Vector3d::UnitZ();
  elbow.wave_rad = 0.55;
  elbow.wave_hz = 1.0;
  elbow.wave_start_s = start_s;
  elbow.wave_end_s = end_s;
  person.parts.push_back(detail::ellipsoid({0.060, 0.20, 0.065}, {0.27, -0.86, 0.03}, clothes.shirt));
  person.parts.push_back(detail::ellipsoid({0.050, 0.16, 0.050}, {0.29, -0.93, 0.10}, clothes.shirt, elbow));
  person.parts.push_back(detail::ellipsoid({0.055, 0.10, 0.030}, {0.31, -1.14, 0.11}, clothes.skin, elbow));
  return person;
}

/// A cuboid printed with colourful marks, class unknown to detectors. Origin in the middle of its lower face.
/// @param half_extents metres
inline Mover printed_box(Path path, const Vector3d& half_extents, std::uint64_t seed) {
  Random random(seed);
  Mover box;
  box.path = std::move(path);
  Solid solid;
  solid.half_extents = half_extents;
  solid.object_from_solid.translation() = Vector3d(0, -half_extents.y(), 0);
  const Bgr grounds[] = {{90, 170, 220},  {190, 150, 90},  {110, 180, 120},
                         {120, 110, 210}, {200, 200, 200}, {150, 90, 140}};
  for (std::size_t face = 0; face < solid.textures.size(); ++face) {
    TextureStyle style;
    style.ground = Ground::blocks;
    style.colours = {grounds[face], {40, 40, 50}, {240, 240, 240}, {40, 60, 200}, {190, 90, 40}, {60, 190, 230}};
    style.cell_m = 0.12;
    style.largest_mark_m = 0.15;
    style.smallest_mark_m = 0.008;
    style.coverage = 0.25;
    solid.textures[face] = paint(256, 420, style, random.bits());
  }
  box.parts.push_back({solid, {}});
  return box;
}

}  // namespace stillpoint::synthetic
