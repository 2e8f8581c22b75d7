// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which feature belongs to which known object?   That beside whose predicted points it lies.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/movers/moving_features.hpp"
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
  /// @param point  of the feature, in the current camera
  /// @param velocity_of  `FeatureVelocity()`, asked where an object is near
  template <class VelocityOf>
  std::int32_t object_at(const Vector2f& pixel, const Vector3d& point, double sigma_m, const VelocityOf& velocity_of,
                         const std::vector<TrackedObject>& objects) const {
    std::optional<FeatureVelocity> velocity;
    const double tolerance_m = kSameSurface.at(sigma_m);
    std::int32_t nearest = kNone;
    double least = 1e30;
    grid_.within(pixel, reach_px_, [&](std::size_t k, float squared_px) {
      const Entry& entry = point_[k];
      const double apart = (static_cast<double>(entry.depth_m) - point.z()) / tolerance_m;
      if (!(apart * apart <= 1.0)) return;
      double cost = static_cast<double>(squared_px / (reach_px_ * reach_px_)) + apart * apart;
      if (!velocity) velocity = velocity_of();
      if (velocity->is_known) {
        const TrackedObject& object = objects[static_cast<std::size_t>(entry.object)];
        const Vector3d expected = object.velocity_at(point);
        const double apart_m_s = velocity->difference(expected, point), misfit = apart_m_s / object.limbs_m_s();
        if (!(misfit < 1.0)) return;
        const bool moves = expected.norm() > kMoves_m_s;  // static features before or behind it are not of it
        if (moves && !(apart_m_s < velocity->difference(Vector3d::Zero(), point))) return;
        cost += 4.0 * misfit * misfit;
      }
      if (!(cost < least)) return;
      least = cost;
      nearest = entry.object;
    });
    return nearest;
  }

 private:
  static constexpr double kMoves_m_s = 0.2;
  static constexpr DepthTolerance kSameSurface{0.06};

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
        pixel_[k] = in_front ? image_pixel(camera, point) : Vector2f(kNowhere_px, kNowhere_px);
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
