// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the patch of a feature says of the place where a static point would be in an older frame.

#include <cstddef>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/match/patch_search.hpp"
#include "stillpoint/match/static_place.hpp"

namespace stillpoint {

/// A patch with less contrast there cannot be compared, gray values.
constexpr float kLeastContrast = 3.0f;

/// How a static point is searched: it is not three pixels away, and more steps find look-alikes.
inline PatchSearch static_point_search() { return {3, 0.2f}; }

/// What is looked for: feature `i` at a depth.
/// @param inverse_depth_sigma  of that depth, 1 / m
template <class Camera>
void set_depth_in_past(std::size_t i, double depth_m, double inverse_depth_sigma, const Camera& camera,
                       Matches& matches) {
  matches.past_observations.point[i] = camera.back_project(matches.current.undistorted[i], depth_m);
  matches.past_observations.inverse_depth_sigma[i] = inverse_depth_sigma;
}

/// The patch was found near that place.
template <class Camera>
void set_found(const PatchFit& fit, const StaticPlace& place, const Camera& camera, Observation& observation) {
  observation.state = ObservationState::seen;
  observation.dissimilarity = fit.dissimilarity;
  observation.offset_px = fit.offset.norm();
  observation.found = to_float(camera.undistort(to_double(place.pixel + fit.offset)));
}

}  // namespace stillpoint
