// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which surfaces a projector beside the camera sees: where it sees none, a structured-light camera has no depth.
// The same holds for the second camera of a stereo pair.

#include <algorithm>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/synthetic/ray_caster.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// A projector to the right of the camera that looks where the camera looks. It lights everything it sees.
class Projector {
 public:
  /// Begins a new moment: forgets all solids.
  /// @param baseline_m  from the camera to the right
  void start(const Pose& world_from_camera, double baseline_m) {
    projector_from_camera_ = Pose(Eigen::Translation3d(-baseline_m, 0.0, 0.0));
    world_from_projector_ = world_from_camera * projector_from_camera_.inverse();
    baseline_m_ = static_cast<float>(baseline_m);
    obstacles_.clear();
  }

  /// A solid that hides what is behind it.
  void add(const Solid& solid, const Pose& camera_from_solid) {
    if (solid.shape == Shape::room) return;  // all else is inside
    constexpr double kNearest_m = 0.02;
    Obstacle obstacle{PlacedSolid(solid, projector_from_camera_ * camera_from_solid, world_from_projector_), {}, {}};
    int behind = 0;
    for (const Vector3d& corner : obstacle.placed.corners()) {
      if (!(corner.z() > kNearest_m)) {
        ++behind;
        continue;
      }
      obstacle.x.widen(static_cast<float>(corner.x() / corner.z()));
      obstacle.y.widen(static_cast<float>(corner.y() / corner.z()));
    }
    if (behind == 8) return;
    if (behind > 0) obstacle.x = obstacle.y = {-1e30f, 1e30f};
    obstacles_.push_back(obstacle);
  }

  /// Whether nothing is in the way from the projector to the surface that the camera sees.
  /// @param ray  of the camera   @param depth_m  at which the ray meets the surface
  bool lights(const Ray& ray, float depth_m) const noexcept {
    constexpr float kOwnSurface_m = 0.003f;  // a surface does not hide itself
    const Ray beam{ray.x - baseline_m_ / depth_m, ray.y};
    Hit hit;
    for (const Obstacle& obstacle : obstacles_)
      if (obstacle.x.contains(beam.x) && obstacle.y.contains(beam.y) &&
          obstacle.placed.meets(beam, depth_m - kOwnSurface_m, hit))
        return false;
    return true;
  }

 private:
  struct Range {
    float low = 1e30f, high = -1e30f;
    void widen(float value) noexcept {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    bool contains(float value) const noexcept { return value >= low && value <= high; }
  };
  struct Obstacle {
    PlacedSolid placed;
    Range x, y;  ///< of the beams that can meet it
  };

  Pose projector_from_camera_ = Pose::Identity(), world_from_projector_ = Pose::Identity();
  float baseline_m_ = 0.0f;
  std::vector<Obstacle> obstacles_;
};

}  // namespace stillpoint::synthetic
