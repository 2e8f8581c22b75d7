// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Scene → frames: images, depth and truth, any frame at any time and always the same bytes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/synthetic/depth_sensor.hpp"
#include "stillpoint/synthetic/noise.hpp"
#include "stillpoint/synthetic/ray_caster.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/synthetic_frame.hpp"
#include "stillpoint/synthetic/truth.hpp"
#include "stillpoint/synthetic/visible_surfaces.hpp"

namespace stillpoint::synthetic {

/// Renders a scene. Frames do not depend on one another, nor on the order in which they are rendered. One object, one
/// thread: it holds scratch memory.
class SyntheticSequence {
 public:
  /// @throws Error if the scene's numbers make no sequence or a solid lacks a texture.
  explicit SyntheticSequence(Scene scene)
      : scene_(std::move(scene)),
        grid_(scene_.camera),
        sample_width_(0.5f * kLensBlur * static_cast<float>(1.0 / scene_.camera.fx())) {
    if (scene_.frame_count < 1)
      throw Error("scene: frame_count is " + std::to_string(scene_.frame_count) + ", expected at least 1");
    if (!(scene_.frame_rate_hz > 0) || !std::isfinite(scene_.frame_rate_hz))
      throw Error("scene: frame_rate_hz is " + std::to_string(scene_.frame_rate_hz) +
                  ", expected a finite number above 0");
    if (scene_.motion_rule.window_frames < 1)
      throw Error("scene: motion_rule.window_frames is " + std::to_string(scene_.motion_rule.window_frames) +
                  ", expected at least 1");
    for (const Solid& solid : scene_.furniture) check(solid);
    for (const Mover& mover : scene_.movers)
      for (const Part& part : mover.parts) check(part.solid);
  }

  const Scene& scene() const noexcept { return scene_; }
  const Camera& camera() const noexcept { return scene_.camera; }
  int size() const noexcept { return scene_.frame_count; }

  /// Seconds since frame 0.
  double time_of(int index) const noexcept { return index / scene_.frame_rate_hz; }

  /// Fills all of `frame`. Indices at or beyond `size()` go on: the last way points hold.
  /// @throws Error if the index is negative.   Allocates only for the first frame.
  void render(int index, SyntheticFrame& frame) {
    if (index < 0) throw Error("synthetic frame index is " + std::to_string(index) + ", expected 0 or more");
    frame.index = index;
    frame.timestamp_s = scene_.start_s + time_of(index);
    frame.depth_factor = scene_.sensor.depth_factor;
    frame.world_from_camera = scene_.camera_path.world_from_camera(time_of(index));
    frame.world_from_mover.clear();
    for (const Mover& mover : scene_.movers) frame.world_from_mover.push_back(mover.world_from_object(time_of(index)));
    surfaces_.look(scene_, grid_, moment(index), sample_width_, frame.exact_depth);
    shade(frame);
    gray_from_bgr(frame.colour.view(), frame.gray);
    measure_depth(frame);
    ignore_silhouettes(frame.mover_ids.view(), columns_, frame.labels);
    find_boxes(frame.mover_ids.view(), scene_.movers, frame.boxes);
  }

 private:
  using Actor = VisibleSurfaces::Actor;
  static constexpr std::uint16_t kNothing = VisibleSurfaces::kNothing;
  /// A pixel gathers light from so many pixels' width: a lens is a little softer than its sensor, so that corners can
  /// be located to a small part of a pixel.
  static constexpr float kLensBlur = 1.4f;

  static void check(const Solid& solid) {
    if (!(solid.half_extents.minCoeff() > 0)) throw Error("scene: a solid has half_extents not above 0 m");
    for (const TexturePtr& texture : solid.textures)
      if (texture == nullptr) throw Error("scene: a solid has a face without a texture");
  }

  std::uint64_t frame_seed(int index, std::uint64_t purpose) const noexcept {
    return Random(scene_.seed + 4 * static_cast<std::uint64_t>(index) + purpose).bits();
  }

  VisibleSurfaces::Moment moment(int index) const noexcept {
    return {time_of(index), time_of(std::max(0, index - 1)),
            time_of(std::max(0, index - scene_.motion_rule.window_frames))};
  }

  void measure_depth(SyntheticFrame& frame) {
    const Sensor& sensor = scene_.sensor;
    const bool is_delayed = sensor.depth_delay_s != 0.0;
    VisibleSurfaces& surfaces = is_delayed ? delayed_surfaces_ : surfaces_;
    ImageBuffer& exact_depth = is_delayed ? delayed_depth_ : frame.exact_depth;
    if (is_delayed) {
      const double now_s = time_of(frame.index) + sensor.depth_delay_s;
      surfaces.look(scene_, grid_, {now_s, now_s, now_s}, sample_width_, exact_depth);
    }
    DepthSensor(sensor).measure(exact_depth.view(), surfaces.light(sensor, grid_, exact_depth.view()), table_,
                                frame_seed(frame.index, 1), frame.depth);
  }

  void shade(SyntheticFrame& frame) {
    const int width = scene_.camera.width(), height = scene_.camera.height();
    frame.colour.resize(width, height, PixelFormat::bgr8);
    frame.labels.resize(width, height, PixelFormat::gray8);
    frame.mover_ids.resize(width, height, PixelFormat::gray8);
    frame.furniture_ids.resize(width, height, PixelFormat::gray8);
    NormalStream normal(table_, frame_seed(frame.index, 2));
    const double flicker = Random(frame_seed(frame.index, 3)).uniform(-1.0, 1.0) * scene_.sensor.exposure_flicker;
    const auto exposure = static_cast<float>(1.0 + flicker), sigma = static_cast<float>(scene_.sensor.image_sigma);
    for (int v = 0; v < height; ++v) {
      const float* const depth = frame.exact_depth.row<float>(v);
      const std::uint16_t* const keys = surfaces_.keys(v);
      std::uint8_t* const colour = frame.colour.row<std::uint8_t>(v);
      std::uint8_t* const labels = frame.labels.row<std::uint8_t>(v);
      std::uint8_t* const mover_ids = frame.mover_ids.row<std::uint8_t>(v);
      std::uint8_t* const furniture_ids = frame.furniture_ids.row<std::uint8_t>(v);
      for (int u = 0; u < width; ++u) {
        const std::uint16_t key = keys[u];
        labels[u] = kStatic;
        mover_ids[u] = furniture_ids[u] = 0;
        if (key != kNothing) {
          const Actor& actor = surfaces_.actors()[key / 8];
          mover_ids[u] = actor.mover_id;
          furniture_ids[u] = actor.furniture_id;
          if (actor.mover_id != 0) {
            const auto p = actor.placed.point(grid_.at(u, v), depth[u]);
            labels[u] = actor.motion.moves(Eigen::Vector3f(p[0], p[1], p[2]).cast<double>()) ? kMoving : kAtRest;
          }
        }
        const Shading& shading = surfaces_.shadings(v)[u];
        const Bgr mean = within_face(u, v, key) ? face_colour(u, v, key, shading, depth[u]) : edge_colour(u, v);
        const float noise = sigma > 0.0f ? sigma * normal.next() : 0.0f;
        colour[3 * u] = rounded(exposure * mean.blue + noise);
        colour[3 * u + 1] = rounded(exposure * mean.green + noise);
        colour[3 * u + 2] = rounded(exposure * mean.red + noise);
      }
    }
  }

  static std::uint8_t rounded(float value) noexcept {
    return static_cast<std::uint8_t>(std::min(255.0f, std::max(0.0f, value)) + 0.5f);
  }

  /// Whether the four neighbours show the same face: then so does all of the pixel.
  bool within_face(int u, int v, std::uint16_t key) const noexcept {
    const int width = scene_.camera.width();
    if (key == kNothing || u < 1 || v < 1 || u + 1 >= width || v + 1 >= scene_.camera.height()) return false;
    const std::uint16_t* const here = surfaces_.keys(v) + u;
    return here[-1] == key && here[1] == key && here[-width] == key && here[width] == key;
  }

  /// Mean of 2 × 2 samples of the face.
  Bgr face_colour(int u, int v, std::uint16_t key, const Shading& shading, float depth_m) const noexcept {
    const PlacedSolid& placed = surfaces_.actors()[key / 8].placed;
    const int face = key % 8;
    const TextureSampler sampler = placed.sampler(face, shading.level);
    const RayGrid::Pixel pixel = grid_.pixel(u, v);
    Bgr sum;
    for (int i = 0; i < 4; ++i) {
      const Ray ray = pixel.beside(offset(i & 1, 2), offset(i >> 1, 2));
      add(placed.colour(ray, {placed.depth_on_face(ray, face, depth_m), face}, sampler), 0.25f * shading.lit, sum);
    }
    return sum;
  }

  /// Mean of 4 × 4 rays, each against all solids near by: edges move smoothly by parts of a pixel.
  Bgr edge_colour(int u, int v) {
    constexpr int kSide = 4;
    near_.clear();
    for (const Actor& actor : surfaces_.actors())
      if (actor.window.contains(u, v)) near_.push_back(&actor.placed);
    const RayGrid::Pixel pixel = grid_.pixel(u, v);
    Bgr sum;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Ray ray = pixel.beside(offset(i % kSide, kSide), offset(i / kSide, kSide));
      Hit first{1e9f, 0}, hit;
      const PlacedSolid* seen = nullptr;
      for (const PlacedSolid* const placed : near_)
        if (placed->meets(ray, first.depth_m, hit)) {
          first = hit;
          seen = placed;
        }
      if (seen == nullptr) continue;
      const Shading shading = seen->shading(ray, first, sample_width_);
      add(seen->colour(ray, first, seen->sampler(first.face, shading.level)), shading.lit / (kSide * kSide), sum);
    }
    return sum;
  }

  /// Of sample i out of `count` in a row, from the pixel's centre, pixels.
  static float offset(int i, int count) noexcept {
    return kLensBlur * ((static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f);
  }

  static void add(const Bgr& colour, float weight, Bgr& sum) noexcept {
    sum.blue += weight * colour.blue;
    sum.green += weight * colour.green;
    sum.red += weight * colour.red;
  }

  Scene scene_;
  RayGrid grid_;
  float sample_width_;  ///< of 2 x 2 samples in a pixel, at a depth of 1 m, metres
  NormalTable table_;
  VisibleSurfaces surfaces_, delayed_surfaces_;  ///< of the image, and of the depth where it comes at another time
  ImageBuffer delayed_depth_;
  std::vector<const PlacedSolid*> near_;
  std::vector<std::uint8_t> columns_;
};

}  // namespace stillpoint::synthetic

namespace stillpoint {
using synthetic::SyntheticFrame;
using synthetic::SyntheticSequence;
}  // namespace stillpoint
