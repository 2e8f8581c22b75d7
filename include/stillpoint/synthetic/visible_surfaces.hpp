// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Scene and moment → what each pixel shows: which face of which solid, at what depth, and how it is lit.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/synthetic/depth_sensor.hpp"
#include "stillpoint/synthetic/projector.hpp"
#include "stillpoint/synthetic/ray_caster.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/truth.hpp"

namespace stillpoint::synthetic {

/// A scene seen at one moment. Holds scratch memory that the next moment reuses.
class VisibleSurfaces {
 public:
  /// A solid of the scene. Identifiers: 0 none, k + 1 the k-th; those beyond 254 share 255.
  struct Actor {
    PlacedSolid placed;
    RayGrid::Window window;
    PartMotion motion;
    std::uint8_t mover_id, furniture_id;
  };

  /// Seconds since frame 0: now, and the moments that now is compared with.
  struct Moment {
    double now_s, last_s, window_start_s;
  };

  /// A key is 8 · actor + face.
  static constexpr std::uint16_t kNothing = 0xffff;

  /// @param sample_width  distance between two samples of the image at a depth of 1 m, metres
  /// @param exact_depth   gets the depth of the ray through each pixel's centre, depth32f, metres, 0 = nothing there
  /// @throws Error if the scene has more than 8190 solids.
  void look(const Scene& scene, const RayGrid& grid, const Moment& moment, float sample_width,
            ImageBuffer& exact_depth) {
    width_ = scene.camera.width();
    height_ = scene.camera.height();
    world_from_camera_ = scene.camera_path.world_from_camera(moment.now_s);
    place(scene, grid, moment);
    cast(grid, exact_depth);
    shade(grid, sample_width, exact_depth);
  }

  const std::vector<Actor>& actors() const noexcept { return actors_; }
  const std::uint16_t* keys(int v) const noexcept { return keys_.data() + begin(v); }
  const Shading* shadings(int v) const noexcept { return shadings_.data() + begin(v); }

  /// What a depth sensor needs to know. Valid until the next moment.
  /// @param exact_depth  as `look` filled it
  SurfaceLight light(const Sensor& sensor, const RayGrid& grid, const ImageView& exact_depth) {
    cosines_.resize(shadings_.size());
    for (std::size_t at = 0; at < shadings_.size(); ++at) cosines_[at] = shadings_[at].cosine;
    SurfaceLight light(cosines_.data());
    if (sensor.least_return > 0) light.returned = find_returned();
    if (sensor.projector_baseline_m > 0) light.lit = find_lit(sensor.projector_baseline_m, grid, exact_depth);
    return light;
  }

 private:
  std::ptrdiff_t begin(int v) const noexcept { return static_cast<std::ptrdiff_t>(v) * width_; }

  void place(const Scene& scene, const RayGrid& grid, const Moment& moment) {
    const Pose camera_from_world = world_from_camera_.inverse();
    actors_.clear();
    const auto add = [&](const Solid& solid, const Pose& world_from_solid, const PartMotion& motion) -> Actor& {
      const PlacedSolid placed(solid, camera_from_world * world_from_solid, world_from_camera_);
      actors_.push_back({placed, grid.window(placed), motion, 0, 0});
      return actors_.back();
    };
    const auto identifier = [](std::size_t k) { return static_cast<std::uint8_t>(std::min<std::size_t>(k + 1, 255)); };
    for (std::size_t k = 0; k < scene.furniture.size(); ++k)
      add(scene.furniture[k], scene.furniture[k].object_from_solid, {}).furniture_id = identifier(k);
    for (std::size_t k = 0; k < scene.movers.size(); ++k) {
      const Mover& mover = scene.movers[k];
      for (const Part& part : mover.parts)
        add(part.solid, mover.world_from_part(part, moment.now_s),
            PartMotion(mover, part, moment.now_s, moment.last_s, moment.window_start_s, scene.motion_rule))
            .mover_id = identifier(k);
    }
    if (actors_.size() >= kNothing / 8) throw Error("scene: more than 8190 solids");
  }

  /// What the ray through each pixel's centre meets first.
  void cast(const RayGrid& grid, ImageBuffer& exact_depth) {
    exact_depth.resize(width_, height_, PixelFormat::depth32f);
    keys_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNothing);
    for (int v = 0; v < height_; ++v) std::fill_n(exact_depth.row<float>(v), width_, 1e9f);
    for (std::size_t i = 0; i < actors_.size(); ++i) {
      const Actor& actor = actors_[i];
      for (int v = actor.window.v_begin; v < actor.window.v_end; ++v) {
        float* const depth = exact_depth.row<float>(v);
        std::uint16_t* const keys = keys_.data() + begin(v);
        const Ray* const rays = &grid.at(0, v);
        for (int u = actor.window.u_begin; u < actor.window.u_end; ++u) {
          Hit hit;
          if (!actor.placed.meets(rays[u], depth[u], hit)) continue;
          depth[u] = hit.depth_m;
          keys[u] = static_cast<std::uint16_t>(8 * i + static_cast<std::size_t>(hit.face));
        }
      }
    }
  }

  void shade(const RayGrid& grid, float sample_width, ImageBuffer& exact_depth) {
    shadings_.assign(keys_.size(), Shading{});
    for (int v = 0; v < height_; ++v) {
      float* const depth = exact_depth.row<float>(v);
      for (int u = 0; u < width_; ++u) {
        const std::uint16_t key = keys(v)[u];
        if (key == kNothing)
          depth[u] = 0.0f;
        else
          shadings_[static_cast<std::size_t>(begin(v) + u)] =
              actors_[key / 8].placed.shading(grid.at(u, v), {depth[u], key % 8}, sample_width);
      }
    }
  }

  const float* find_returned() {
    returned_.resize(keys_.size());
    for (std::size_t at = 0; at < keys_.size(); ++at) {
      if (keys_[at] == kNothing) {
        returned_[at] = 0.0f;
        continue;
      }
      const Solid& solid = actors_[keys_[at] / 8].placed.solid();
      returned_[at] = solid.specular ? 0.0f : static_cast<float>(solid.infrared_albedo) * shadings_[at].cosine;
    }
    return returned_.data();
  }

  const std::uint8_t* find_lit(double baseline_m, const RayGrid& grid, const ImageView& exact_depth) {
    lit_.assign(keys_.size(), 0);
    projector_.start(world_from_camera_, baseline_m);
    for (const Actor& actor : actors_) projector_.add(actor.placed.solid(), actor.placed.camera_from_solid());
    for (int v = 0; v < height_; ++v) {
      const float* const depth = exact_depth.row<float>(v);
      for (int u = 0; u < width_; ++u)
        if (depth[u] > 0.0f && projector_.lights(grid.at(u, v), depth[u]))
          lit_[static_cast<std::size_t>(begin(v) + u)] = 1;
    }
    return lit_.data();
  }

  int width_ = 0, height_ = 0;
  Pose world_from_camera_ = Pose::Identity();
  std::vector<Actor> actors_;
  std::vector<std::uint16_t> keys_;
  std::vector<Shading> shadings_;
  std::vector<float> cosines_, returned_;
  std::vector<std::uint8_t> lit_;
  Projector projector_;
};

}  // namespace stillpoint::synthetic
