// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The stage of the ready-made scenes: a furnished room of 6.4 × 5.6 m, 2.7 m high.

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/texture.hpp"

namespace stillpoint::synthetic {

inline TexturePtr paint(int size_px, double texels_per_metre, const TextureStyle& style, std::uint64_t seed) {
  return std::make_shared<const Texture>(size_px, texels_per_metre, style, seed);
}

/// Table and chair legs and the like: a board on four posts, its top at `height_m` above the floor.
inline void add_table(const Vector3d& floor_centre, const Vector3d& half_top, double height_m, const TexturePtr& top,
                      const TexturePtr& post, std::vector<Solid>& solids) {
  solids.emplace_back(Shape::cuboid, half_top, floor_centre + Vector3d(0, -height_m + half_top.y(), 0), top);
  const double post_half_m = 0.5 * height_m - half_top.y();
  for (const double side : {-1.0, 1.0})
    for (const double end : {-1.0, 1.0})
      solids.emplace_back(
          Shape::cuboid, Vector3d(0.03, post_half_m, 0.03),
          floor_centre + Vector3d(side * (half_top.x() - 0.05), -post_half_m, end * (half_top.z() - 0.05)), post);
}

/// x in [-3.2, 3.2], z in [-2.0, 3.6], y in [-2.7, 0]: cameras stand near z = -0.8 and look along z. The floor between
/// x = -1.3 and 1.6, z = 0.4 and 2.3 is free for movers.
inline std::vector<Solid> furnished_room(std::uint64_t seed) {
  Random random(seed);
  const auto surface = [&random](int size_px, double texels_per_metre, Ground ground, std::vector<Bgr> colours,
                                 double cell_m, double largest_mark_m, double coverage) {
    TextureStyle style;
    style.ground = ground;
    style.colours = std::move(colours);
    style.cell_m = cell_m;
    style.largest_mark_m = largest_mark_m;
    style.coverage = coverage;
    return paint(size_px, texels_per_metre, style, random.bits());
  };
  const TexturePtr left =
      surface(1024, 256, Ground::plain,
              {{196, 208, 214}, {120, 150, 160}, {86, 112, 150}, {230, 232, 236}, {70, 84, 98}}, 0.5, 0.6, 0.1);
  const TexturePtr right =
      surface(1024, 256, Ground::stripes,
              {{186, 204, 180}, {120, 160, 110}, {214, 226, 216}, {74, 104, 84}, {140, 190, 200}}, 0.25, 0.5, 0.1);
  const TexturePtr back =
      surface(1024, 256, Ground::stripes,
              {{206, 198, 184}, {180, 150, 110}, {130, 104, 76}, {232, 228, 222}, {110, 126, 176}}, 0.4, 0.6, 0.09);
  const TexturePtr front =
      surface(512, 128, Ground::blocks, {{180, 180, 196}, {110, 110, 150}, {60, 60, 90}}, 0.5, 0.5, 0.2);
  const TexturePtr floor = surface(1024, 256, Ground::planks,
                                   {{96, 132, 168}, {60, 88, 120}, {150, 190, 222}, {30, 44, 64}}, 0.16, 0.25, 0.14);
  const TexturePtr ceiling =
      surface(512, 128, Ground::tiles, {{226, 228, 230}, {180, 182, 186}, {120, 122, 128}}, 0.6, 0.3, 0.1);
  const TexturePtr wood = surface(512, 512, Ground::planks,
                                  {{70, 110, 160}, {40, 68, 110}, {140, 186, 226}, {24, 36, 60}}, 0.12, 0.12, 0.14);
  const TexturePtr pale_wood = surface(
      512, 512, Ground::planks, {{150, 186, 210}, {96, 130, 160}, {206, 228, 240}, {50, 70, 96}}, 0.3, 0.3, 0.12);
  const TexturePtr books = surface(
      512, 512, Ground::blocks,
      {{150, 150, 150}, {40, 40, 190}, {170, 80, 40}, {60, 150, 60}, {40, 180, 210}, {230, 230, 230}, {40, 40, 40}},
      0.06, 0.12, 0.2);
  const TexturePtr cloth = surface(512, 512, Ground::stripes,
                                   {{150, 92, 70}, {200, 150, 120}, {84, 40, 26}, {226, 214, 200}}, 0.1, 0.12, 0.16);
  const TexturePtr carton = surface(512, 512, Ground::plain,
                                    {{110, 152, 190}, {70, 104, 136}, {40, 54, 70}, {226, 232, 238}}, 0.5, 0.16, 0.14);

  std::vector<Solid> solids;
  Solid room(Shape::room, {3.2, 1.35, 2.8}, {0.0, -1.35, 0.8}, back);
  room.textures = {left, right, ceiling, floor, front, back};
  solids.push_back(room);
  add_table({-1.9, 0, 2.3}, {0.75, 0.025, 0.42}, 0.74, wood, wood, solids);
  solids.emplace_back(Shape::cuboid, Vector3d(0.16, 0.12, 0.10), Vector3d(-2.25, -0.86, 2.30), carton, 0.5);
  solids.emplace_back(Shape::cuboid, Vector3d(0.11, 0.025, 0.15), Vector3d(-1.75, -0.765, 2.15), books, -0.3);
  solids.emplace_back(Shape::cuboid, Vector3d(0.10, 0.02, 0.13), Vector3d(-1.74, -0.81, 2.16), books, 0.1);
  solids.emplace_back(Shape::ellipsoid, Vector3d(0.10, 0.10, 0.10), Vector3d(-1.40, -0.84, 2.35), cloth);
  solids.emplace_back(Shape::cuboid, Vector3d(0.45, 0.95, 0.30), Vector3d(2.45, -0.95, 3.25), pale_wood);  // cupboard
  solids.emplace_back(Shape::cuboid, Vector3d(0.30, 0.95, 0.55), Vector3d(2.90, -0.95, 1.70), wood);
  solids.emplace_back(Shape::cuboid, Vector3d(0.70, 0.02, 0.14), Vector3d(0.45, -1.45, 3.46), pale_wood);  // shelf
  solids.emplace_back(Shape::cuboid, Vector3d(0.42, 0.14, 0.10), Vector3d(0.30, -1.61, 3.46), books);
  solids.emplace_back(Shape::cuboid, Vector3d(0.09, 0.09, 0.09), Vector3d(0.98, -1.56, 3.44), carton, 0.6);
  solids.emplace_back(Shape::cuboid, Vector3d(0.80, 0.22, 0.38), Vector3d(0.40, -0.22, 3.15), cloth);  // sofa
  solids.emplace_back(Shape::cuboid, Vector3d(0.80, 0.40, 0.10), Vector3d(0.40, -0.44, 3.48), cloth);
  solids.emplace_back(Shape::cuboid, Vector3d(0.24, 0.20, 0.22), Vector3d(-2.70, -0.20, 0.90), carton, 0.35);
  solids.emplace_back(Shape::cuboid, Vector3d(0.18, 0.15, 0.16), Vector3d(-2.72, -0.55, 0.92), books, -0.2);
  solids.emplace_back(Shape::cuboid, Vector3d(0.20, 0.24, 0.20), Vector3d(1.95, -0.24, 2.60), carton, -0.5);
  return solids;
}

}  // namespace stillpoint::synthetic
