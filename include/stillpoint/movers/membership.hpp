// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which feature belongs to which known object?   That beside whose predicted points it lies.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// The points of all objects, where they are predicted to be. Lives in the workspace.
class PredictedPoints {
 public:
  static constexpr std::int32_t kNone = -1;
  static constexpr float kReach_px = 16.0f;  // for a focal length of 525 px: a support corner's cell

  template <class Camera>
  PredictedPoints(const std::vector<TrackedObject>& objects, const Camera& camera, float pixel_scale,
                  Workspace& workspace)
      : reach_px_(kReach_px * pixel_scale),
        count_(count(objects)),
        pixel_(workspace.take<Vector2f>(count_, Vector2f::Zero())),
        point_(workspace.take<Entry>(count_)),
        grid_(fill(objects, camera), reach_px_, workspace, [](std::size_t) { return true; }) {}

  /// The object that has the nearest point in image, depth and motion; `kNone` where none is near.
  /// @param velocity  of the feature relative to the world, m/s; nullptr where it is not known
  std::int32_t object_at(const Vector2f& pixel, double depth_m, double sigma_m, const Vector3d* velocity,
                         const std::vector<TrackedObject>& objects) const {
    const double tolerance_m = kSameSurface.at(sigma_m);
    std::int32_t nearest = kNone;
    double least = 1e30;
    grid_.within(pixel, reach_px_, [&](std::size_t k, float squared_px) {
      const Entry& entry = point_[k];
      const double apart = (static_cast<double>(entry.depth_m) - depth_m) / tolerance_m;
      if (!(apart * apart <= 1.0)) return;
      double cost = static_cast<double>(squared_px / (reach_px_ * reach_px_)) + apart * apart;
      if (velocity != nullptr) {
        const Vector3d& known = objects[static_cast<std::size_t>(entry.object)].linear.velocity();
        const double limbs_m_s = kLimbs_m_s + kLimbs * known.norm(), apart_m_s = (*velocity - known).norm();
        if (!(apart_m_s < limbs_m_s)) return;
        cost += 4 * apart_m_s * apart_m_s / (limbs_m_s * limbs_m_s);
      }
      if (!(cost < least)) return;
      least = cost;
      nearest = entry.object;
    });
    return nearest;
  }

 private:
  static constexpr DepthTolerance kSameSurface{0.06};
  static constexpr double kLimbs_m_s = 0.4, kLimbs = 0.8;  // limbs differ so much from their object's velocity

  struct Entry {
    float depth_m = 0;
    std::int32_t object = kNone;
  };

  static std::size_t count(const std::vector<TrackedObject>& objects) {
    std::size_t sum = 0;
    for (const TrackedObject& object : objects) sum += object.points.size();
    return sum;
  }

  template <class Camera>
  span<const Vector2f> fill(const std::vector<TrackedObject>& objects, const Camera& camera) {
    constexpr double kNearest_m = 0.05;
    constexpr float kNowhere_px = -1e6f;
    std::size_t k = 0;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      for (const Vector3d& point : objects[o].points) {
        const bool in_front = point.z() > kNearest_m;
        pixel_[k] = in_front ? Vector2f(camera.distort(camera.project(point)).template cast<float>())
                             : Vector2f::Constant(kNowhere_px);
        point_[k++] = {static_cast<float>(point.z()), static_cast<std::int32_t>(o)};
      }
    }
    return {pixel_.data(), pixel_.size()};
  }

  float reach_px_;
  std::size_t count_;
  span<Vector2f> pixel_;
  span<Entry> point_;
  PixelGrid grid_;
};

}  // namespace stillpoint
