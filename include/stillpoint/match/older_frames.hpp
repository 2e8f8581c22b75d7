// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Before the motion is known: which older frames count, where they show the surfaces, and who came where space was
// free.

#include <cstddef>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/match/older_frame_choice.hpp"
#include "stillpoint/match/space_search.hpp"
#include "stillpoint/match/surface_search.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// Writes into each frame where the camera was, seen from the current one, and what it shows in the surfaces' places.
template <class Camera, class Noise>
void observe_surfaces(const SurfaceSearch& search, const FrameHistory& history, const Pose& filter_from_current,
                      const Camera& camera, const Noise& noise, span<const SurfaceCell> cells,
                      span<OlderFrame> frames) {
  for (OlderFrame& older : frames) {
    const PastFrame& past = history.back(older.age);
    const FrameView view = past.view();
    older.reference_from_current = orthonormalized(composed(inverted(past.filter_from_camera), filter_from_current));
    older.of_surface.clear();
    for (const SurfaceCell& cell : cells)
      older.of_surface.push_back(search.observe(cell, view, older.reference_from_current, camera, noise));
  }
}

/// Where the last frame showed the host's features and the surfaces, if they stand still: fills `predicted`.
template <class Camera>
void predict_places(const Pose& reference_from_current, const Camera& camera, Matches& matches) {
  const auto project = [&](const Vector3d& point, Vector2f& pixel) {
    const Vector3d there = reference_from_current * point;
    if (there.z() > SurfaceSearch::kNearest_m) pixel = image_pixel(camera, there);
  };
  for (std::size_t i = 0; i < matches.host_count; ++i)
    if (matches.current.has_depth(i)) project(matches.current.point[i], matches.predicted[i]);
  for (SurfaceCell& cell : matches.past_observations.surfaces) {
    cell.predicted = cell.pixel;
    project(cell.point, cell.predicted);
  }
}

/// Before the motion is known: chooses the older frames, finds the surfaces in the last one, and lowers the static
/// prior where the views of the past seconds saw free space.
/// @param filter_from_expected  where the camera is expected now
template <class Camera, class Noise>
void choose_older_frames(const OlderFrameChoice& choice, const SurfaceSearch& surfaces, const SpaceSearch& space,
                         const FrameHistory& history, const FrameView& current, const Pose& filter_from_expected,
                         const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) {
  choice.choose(history, current, camera, matches, workspace);
  surfaces.collect(current, camera, noise, matches.past_observations.surfaces);
  const span<OlderFrame> frames = matches.past_observations.frames();
  if (!frames.empty()) {
    observe_surfaces(surfaces, history, filter_from_expected, camera, noise, matches.past_observations.surfaces,
                     frames.first(1));
    predict_places(frames[0].reference_from_current, camera, matches);
  }
  space.set_static_prior(history.space(), current.timestamp_s, filter_from_expected, camera, noise,
                         surfaces.scaled_step_px(camera), matches, workspace);
}

}  // namespace stillpoint
