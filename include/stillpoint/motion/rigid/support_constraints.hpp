// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the support corners and surfaces say of the camera's motion, with their noise and their weight.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/motion/rigid/area_support.hpp"
#include "stillpoint/motion/rigid/reprojection_residual.hpp"

namespace stillpoint {

/// Makes constraints of matches. Support is by area: one corner a grid cell, and a grid of surface cells.
struct SupportConstraints {
  double pixel_sigma = 1.0;             ///< of a followed corner, pixels
  double depth_sigmas = 1.5;            ///< measured depth noise over the model's
  double dynamic_region_weight = 0.15;  ///< of a feature in a dynamic region

  // No option in files.
  double surface_weight = 0.8;  ///< of a surface cell: depth errors of neighbours are not independent
  float host_cell_px = 24.0f;   ///< of the host's features one per cell of this size speaks, where they support

  /// The matches with the reference frame.
  template <class Camera>
  span<PointConstraint> from_matches(const Observations& observations, const Camera& camera,
                                     Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const span<PointConstraint> points = workspace.take<PointConstraint>(matches.size());
    const double typical_m = typical_depth_m(matches, workspace);
    const span<const std::uint8_t> speaks = area_support(matches, matches.pixel_scale * host_cell_px, workspace);
    std::size_t count = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.matched(i) || speaks[i] == 0) continue;
      points[count++] = from_match(observations, i, typical_m, camera);
    }
    return points.first(count);
  }

  /// What all older frames say of the support corners: first the matches of those without a depth, then what each older
  /// frame shows of the others, frame by frame.
  template <class Camera>
  span<PointConstraint> from_past_observations(const Observations& observations, const Camera& camera,
                                               Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const span<const OlderFrame> frames = matches.past_observations.frames();
    const std::size_t corners = matches.size() - matches.first_support();
    const span<PointConstraint> points = workspace.take<PointConstraint>(corners * (frames.size() + 1));
    const double typical_m = typical_depth_m(matches, workspace);
    const span<const std::uint8_t> speaks = area_support(matches, matches.pixel_scale * host_cell_px, workspace);
    std::size_t count = 0;
    for (std::size_t i = matches.first_support(); i < matches.size(); ++i)
      if (speaks[i] != 0 && matches.matched(i) && !matches.current.has_depth(i))
        points[count++] = from_match(observations, i, typical_m, camera);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      for (std::size_t i = matches.first_support(); i < matches.size(); ++i) {
        const Observation& observation = frames[f].of_feature[i];
        if (speaks[i] == 0 || !matches.current.has_depth(i)) continue;
        if (observation.state != ObservationState::seen || !(observation.dissimilarity < kMostDissimilar)) continue;
        points[count++] =
            at_depth(observations, i, to_double(observation.found), static_cast<double>(observation.depth_m),
                     static_cast<double>(observation.depth_sigma_m), f);
      }
    }
    return points.first(count);
  }

  /// What these older frames show in the places of the surfaces.
  span<PlaneConstraint> from_surfaces(const Observations& observations, span<const OlderFrame> frames,
                                      Workspace& workspace) const {
    const span<const SurfaceCell> cells = observations.matches.past_observations.surfaces;
    const span<PlaneConstraint> planes = workspace.take<PlaneConstraint>(cells.size() * frames.size());
    std::size_t count = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      for (std::size_t s = 0; s < cells.size(); ++s) {
        const SurfaceCell& cell = cells[s];
        const SurfaceObservation& observation = frames[f].of_surface[s];
        if (!(observation.depth_sigma_m > 0)) continue;
        PlaneConstraint& plane = planes[count++];
        plane.point = cell.point;
        plane.target = observation.target;
        // Depth noise points along the optical axis: the plane sees its share along the normal.
        const double sigma_m =
            depth_sigma_m(cell.depth_sigma_m, observation.depth_sigma_m) * std::abs(cell.normal.z()) + kDepthFloor_m;
        plane.slope = rotation_of(frames[f].reference_from_current) * cell.normal / sigma_m;
        plane.weight_without_prior = surface_weight;
        plane.weight = surface_weight * static_cast<double>(observations.remembered.surface_static_prior[s]);
        plane.frame = f;
      }
    }
    return planes.first(count);
  }

 private:
  static constexpr double kMovableRegionWeight = 0.6;  // a chair seldom moves
  static constexpr double kDepthFloor_m = 0.003;       // what is left when the noise model's is nothing
  static constexpr double kDepthlessSpread = 2.0;  // standard deviation of an unknown inverse depth, of the median one:
                                                   // also what lies beyond the sensor's range has none
  static constexpr float kMostDissimilar = 0.25f;  // an observation that is less alike says nothing of the motion

  double depth_sigma_m(double here_m, double there_m) const noexcept {
    return depth_sigmas * std::sqrt(here_m * here_m + there_m * there_m);
  }

  /// Features that move by the log-odds of the last frames lose weight at once: a slow box is found long before its
  /// dynamic prior rises, and would pull the motion along until then. Nor is it taken for parked.
  void set_feature(PointConstraint& point, const Observations& observations, std::size_t i) const noexcept {
    const Membership& region = observations.regions.of_feature[i];
    const double by_region = region.in_dynamic ? dynamic_region_weight : region.in_movable ? kMovableRegionWeight : 1.0;
    const auto log_odds = static_cast<double>(observations.remembered.log_odds[i]);
    const bool moves = log_odds > 0;
    const double stands = moves ? 2.0 / (1.0 + std::exp(log_odds)) : 1.0;  // its probability over that at even odds
    point.weight = by_region * stands * static_cast<double>(observations.remembered.static_prior[i]);
    point.weight_without_prior = moves ? point.weight : by_region;
    point.feature = i;
  }

  PointConstraint at_depth(const Observations& observations, std::size_t i, const Vector2d& pixel, double seen_depth_m,
                           double seen_sigma_m, std::size_t frame) const {
    const Matches& matches = observations.matches;
    const double z = matches.current.depth_m[i];
    PointConstraint point;
    point.point = matches.current.point[i];
    point.inverse_depth_sigma = matches.current.depth_sigma_m[i] / (z * z);
    point.pixel = pixel;
    point.pixel_sigma = pixel_sigma;
    point.depth_m = seen_depth_m;
    if (seen_depth_m > 0)
      point.depth_slope = 1.0 / (depth_sigma_m(matches.current.depth_sigma_m[i], seen_sigma_m) + kDepthFloor_m);
    set_feature(point, observations, i);
    point.frame = frame;
    return point;
  }

  template <class Camera>
  PointConstraint from_match(const Observations& observations, std::size_t i, double typical_m,
                             const Camera& camera) const {
    const Matches& matches = observations.matches;
    const FrameFeatures& seen = matches.reference;
    if (matches.current.has_depth(i))
      return at_depth(observations, i, seen.undistorted[i], seen.depth_m[i], seen.depth_sigma_m[i], 0);
    PointConstraint point;
    point.point = camera.back_project(matches.current.undistorted[i], typical_m);
    point.inverse_depth_sigma = kDepthlessSpread / typical_m;
    point.pixel = seen.undistorted[i];
    point.pixel_sigma = pixel_sigma;
    set_feature(point, observations, i);
    return point;
  }

  /// The inverse depth of what has none is guessed around the median's.
  static double typical_depth_m(const Matches& matches, Workspace& workspace) {
    constexpr double kRoom_m = 2.0;  // for a scene without any depth
    const double median_m = median_depth_m(matches.current, workspace);
    return median_m > 0 ? median_m : kRoom_m;
  }
};

template <class Visit>
void each_option(SupportConstraints& constraints, Visit& visit) {
  visit("pixel_sigma", constraints.pixel_sigma, OptionRange{0.01, 100});
  visit("depth_sigmas", constraints.depth_sigmas, OptionRange{0.01, 100});
  visit("dynamic_region_weight", constraints.dynamic_region_weight, OptionRange{0, 1});
  if constexpr (sees_code_only<Visit>::value) {
    visit("surface_weight", constraints.surface_weight, OptionRange{0, 100});
    visit("host_cell_px", constraints.host_cell_px, OptionRange{0, 1e4});
  }
}

}  // namespace stillpoint
