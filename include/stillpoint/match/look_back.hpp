// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What do older frames show where a standing feature should be?   Features with depth, the motion → sightings
//
// A test per frame pair sees fast movers only; a slow one is found against a frame that is old enough for its step to
// exceed the noise.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame_history.hpp"
#include "stillpoint/core/guarded_depth.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/match/patch.hpp"

namespace stillpoint {

/// Looks for every feature with a depth at the places where a standing point would have been in older frames.
class LookBack {
 public:
  struct Options {
    double slowest_m_s = 0.03;       ///< a mover of this speed should be seen against the oldest frame …
    double detectable_sigmas = 3.0;  ///< … by a step of this many standard deviations
    double pixel_sigma = 0.7;        ///< of a found patch, pixels
    double longest_s = 0.5;          ///< but no frame is older than this
    float fewest_pixels = 25;        ///< of a patch's 64 that must lie on the feature's surface
    DepthTolerance same_surface;
    double occlusion_m = 0.15;      ///< a surface this much nearer hides the point …
    double occlusion_sigmas = 4.0;  ///< … and this many standard deviations of both depths more
    int surface_step_px = 16;       ///< spacing of the surface cells
    int surface_reach_px = 5;       ///< from a cell's centre to the pixels that span its normal
    double steepest_cosine = 0.2;   ///< of a surface to the line of sight; steeper ones are left out
    PatchSearch search = {3};       ///< a standing point is not three pixels away: more steps only find look-alikes
  };
  Options options;
  GuardedDepth guard;  ///< which depth of an older frame belongs to a pixel?

  template <class Camera, class Noise>
  void look_back(const FrameHistory& history, const FrameView& current, const Pose& filter_from_current,
                 const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) const {
    Sightings& sightings = matches.sightings;
    sightings.clear();
    const Ages ages = choose_ages(history, current, camera, matches, workspace);
    for (std::size_t a = 0; a < ages.count; ++a) {
      const PastFrame& past = history.back(ages.frames[a]);
      OlderFrame& older = sightings.add(matches.size());
      older.reference_from_current = orthonormalized(past.filter_from_camera.inverse() * filter_from_current);
      older.elapsed_s = current.timestamp_s - past.timestamp_s;
    }
    collect_surfaces(current, camera, noise, sightings);
    for (std::size_t a = 0; a < ages.count; ++a) {
      const FrameView past = history.back(ages.frames[a]).view();
      OlderFrame& older = sightings.frames()[a];
      for (const SurfaceCell& cell : sightings.surfaces)
        older.of_surface.push_back(look_for_surface(cell, past, older.reference_from_current, camera, noise));
    }
    Patch patch;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.current.has_depth(i)) continue;
      const Vector2f centre = matches.current.pixel[i].array().round();
      const double depth_m = matches.current.depth_m[i];
      const bool textured =
          cut_patch(current.gray, centre, PatchMask(current.depth, depth_m, options.same_surface), patch) &&
          patch.count >= options.fewest_pixels;
      const Vector3d point = camera.back_project(camera.undistort(centre.template cast<double>()), depth_m);
      for (std::size_t a = 0; a < ages.count; ++a) {
        OlderFrame& older = sightings.frames()[a];
        older.of_feature[i] = look(point, matches.current.depth_sigma_m[i], textured ? &patch : nullptr,
                                   history.back(ages.frames[a]).view(), older.reference_from_current, camera, noise);
      }
    }
  }

 private:
  struct Ages {
    std::array<std::size_t, 3> frames{};
    std::size_t count = 0;
  };

  /// The last frame, the oldest that is needed, and one between them (their geometric mean). The oldest is the first
  /// against which the slowest mover of interest makes a detectable step at the scene's median depth.
  template <class Camera>
  Ages choose_ages(const FrameHistory& history, const FrameView& current, const Camera& camera, const Matches& matches,
                   Workspace& workspace) const {
    const double lateral_sigma_m = options.pixel_sigma * median_depth_m(matches.current, workspace) / camera.fx();
    const double wanted_s =
        std::min(options.detectable_sigmas * lateral_sigma_m / options.slowest_m_s, options.longest_s);
    std::size_t oldest = 1;
    while (oldest < history.size() && current.timestamp_s - history.back(oldest).timestamp_s < wanted_s) ++oldest;
    const auto between = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(oldest))));
    Ages ages;
    for (const std::size_t age : {std::size_t{1}, between, oldest})
      if (ages.count == 0 || age > ages.frames[ages.count - 1]) ages.frames[ages.count++] = age;
    return ages;
  }

  template <class Camera, class Noise>
  Sighting look(const Vector3d& point, double depth_sigma_m, const Patch* patch, const FrameView& older,
                const Pose& reference_from_current, const Camera& camera, const Noise& noise) const {
    Sighting sighting;
    const Vector3d there = reference_from_current * point;
    if (!(there.z() > kNearest_m)) return sighting;
    const Vector2f pixel = camera.distort(camera.project(there)).template cast<float>();
    if (!(older.gray.border_distance_px(pixel.x(), pixel.y()) >= 1.0f)) return sighting;
    const double measured_m = depth_at(older, pixel);
    if (measured_m > 0) {
      const double sigma_m = noise.sigma(measured_m);
      const double margin_m = options.occlusion_m + options.occlusion_sigmas * std::hypot(sigma_m, depth_sigma_m);
      sighting.depth_m = static_cast<float>(measured_m);
      sighting.depth_sigma_m = static_cast<float>(sigma_m);
      sighting.state = measured_m < there.z() - margin_m ? SightingState::occluded : SightingState::seen;
    }
    if (patch == nullptr || sighting.state == SightingState::occluded) return sighting;
    PatchSearch search = options.search;
    search.warp = view_warp(camera, point, there, reference_from_current);
    const PatchFit fit = find_patch(*patch, older.gray, pixel, search);
    if (!fit.inside) return sighting;
    sighting.state = SightingState::seen;
    sighting.dissimilarity = fit.dissimilarity;
    sighting.found = camera.undistort((pixel + fit.offset).template cast<double>()).template cast<float>();
    return sighting;
  }

  double depth_at(const FrameView& frame, const Vector2f& pixel) const noexcept {
    if (frame.depth.empty()) return 0.0;
    return guard.at(frame.depth, DepthScale(frame.gray, frame.depth.image)(pixel));
  }

  /// How a small step in the current image moves in the older one, for a surface that faces the camera.
  template <class Camera>
  static Eigen::Matrix2f view_warp(const Camera& camera, const Vector3d& here, const Vector3d& there,
                                   const Pose& reference_from_current) {
    Eigen::Matrix<double, 2, 3> projection;
    projection << camera.fx(), 0, -camera.fx() * there.x() / there.z(),  //
        0, camera.fy(), -camera.fy() * there.y() / there.z();
    Eigen::Matrix<double, 3, 2> step;
    step << here.z() / camera.fx(), 0, 0, here.z() / camera.fy(), 0, 0;
    return (projection * reference_from_current.linear() * step / there.z()).template cast<float>();
  }

  /// Grid cells where depth is smooth, with the surface's normal from four neighbours.
  template <class Camera, class Noise>
  void collect_surfaces(const FrameView& current, const Camera& camera, const Noise& noise,
                        Sightings& sightings) const {
    const int step = options.surface_step_px, reach = options.surface_reach_px;
    const auto point_at = [&](int u, int v) {
      const Vector2f pixel(static_cast<float>(u), static_cast<float>(v));
      return camera.back_project(camera.undistort(pixel.template cast<double>()), depth_at(current, pixel));
    };
    for (int v = step / 2; v < current.gray.height; v += step) {
      for (int u = step / 2; u < current.gray.width; u += step) {
        const Vector3d centre = point_at(u, v);
        if (!(centre.z() > 0)) continue;
        const Vector3d left = point_at(u - reach, v), right = point_at(u + reach, v);
        const Vector3d above = point_at(u, v - reach), below = point_at(u, v + reach);
        if (!(left.z() > 0 && right.z() > 0 && above.z() > 0 && below.z() > 0)) continue;
        const double bend_m =
            std::max(std::abs(left.z() + right.z() - 2 * centre.z()), std::abs(above.z() + below.z() - 2 * centre.z()));
        if (bend_m > options.same_surface.at(centre.z())) continue;
        const Vector3d normal = (right - left).cross(below - above).normalized();
        if (!(std::abs(normal.dot(centre.normalized())) > options.steepest_cosine)) continue;
        const Vector2f pixel(static_cast<float>(u), static_cast<float>(v));
        sightings.surfaces.push_back({pixel, centre, normal, noise.sigma(centre.z()), 1.0f});
      }
    }
  }

  template <class Camera, class Noise>
  SurfaceSighting look_for_surface(const SurfaceCell& cell, const FrameView& older, const Pose& reference_from_current,
                                   const Camera& camera, const Noise& noise) const {
    const Vector3d there = reference_from_current * cell.point;
    if (!(there.z() > kNearest_m)) return {};
    const Vector2f pixel = camera.distort(camera.project(there)).template cast<float>().array().round();
    const double depth_m = depth_at(older, pixel);
    if (!(depth_m > 0)) return {};
    return {camera.back_project(camera.undistort(pixel.template cast<double>()), depth_m), noise.sigma(depth_m)};
  }

  static constexpr double kNearest_m = 0.1;
};

}  // namespace stillpoint
