// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Smooth pieces of surface, and what older frames show in their places: a witness of the camera's motion that counts
// area, where there may be no corner at all.

#include <algorithm>
#include <cmath>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/pixel_scale.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/depth/guarded_depth.hpp"

namespace stillpoint {

/// A grid of cells over the image.
struct SurfaceSearch {
  int step_px = 24;    ///< spacing of the cells
  GuardedDepth guard;  ///< no option in files

  /// The cells of the current frame's grid where depth is smooth.
  template <class Camera, class Noise>
  void collect(const FrameView& current, const Camera& camera, const Noise& noise,
               std::vector<SurfaceCell>& surfaces) const {
    const auto point_at = [&](int u, int v) {
      const Vector2f pixel(static_cast<float>(u), static_cast<float>(v));
      return point_at_depth(camera, pixel, guard.at(current, pixel, noise));
    };
    surfaces.clear();
    const int step = scaled_step_px(camera);
    const int reach = std::max(1, scaled_px(kReach_px, camera));
    for (int v = step / 2; v < current.gray.height; v += step) {
      for (int u = step / 2; u < current.gray.width; u += step) {
        const Vector3d centre = point_at(u, v);
        if (!(centre.z() > 0)) continue;
        const Vector3d left = point_at(u - reach, v), right = point_at(u + reach, v);
        const Vector3d above = point_at(u, v - reach), below = point_at(u, v + reach);
        if (!(left.z() > 0 && right.z() > 0 && above.z() > 0 && below.z() > 0)) continue;
        const double bend_m =
            std::max(std::abs(left.z() + right.z() - 2 * centre.z()), std::abs(above.z() + below.z() - 2 * centre.z()));
        if (bend_m > kSmooth.at(noise.sigma(centre.z()))) continue;
        const Vector3d across = (right - left).cross(below - above), normal = across / across.norm();
        if (!(std::abs(normal.dot(centre / centre.norm())) > kSteepestCosine)) continue;
        const Vector2f pixel(static_cast<float>(u), static_cast<float>(v));
        surfaces.push_back({pixel, centre, normal, noise.sigma(centre.z()), 1.0f});
      }
    }
  }

  /// Spacing of the cells, in whole pixels of this camera.
  template <class Camera>
  int scaled_step_px(const Camera& camera) const noexcept {
    return std::max(1, scaled_px(step_px, camera));
  }

  /// The surface that an older frame shows where a static cell would have been.
  template <class Camera, class Noise>
  SurfaceObservation observe(const SurfaceCell& cell, const FrameView& older, const Pose& reference_from_current,
                             const Camera& camera, const Noise& noise) const {
    const Vector3d there = reference_from_current * cell.point;
    if (!(there.z() > kNearest_m)) return {};
    const Vector2f place = image_pixel(camera, there);
    if (!(older.gray.border_distance_px(place.x(), place.y()) >= -0.5f)) return {};  // else it may not fit an int
    const Vector2f pixel = rounded(place);
    const double depth_m = guard.at(older, pixel, noise);
    if (!(depth_m > 0)) return {};
    return {point_at_depth(camera, pixel, depth_m), noise.sigma(depth_m)};
  }

  static constexpr double kNearest_m = 0.1;

 private:
  static constexpr int kReach_px = 5;             // from a cell's centre to the pixels that span its normal
  static constexpr double kSteepestCosine = 0.2;  // of a surface to the line of sight; steeper ones are left out
  static constexpr DepthTolerance kSmooth{};      // a surface may bend by so much within its reach
};

template <class Visit>
void each_option(SurfaceSearch& search, Visit& visit) {
  visit("step_px", search.step_px, OptionRange{8, 512});
  if constexpr (sees_code_only<Visit>::value) visit("guard", search.guard);
}

}  // namespace stillpoint
