// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which older frames are looked at?   The history, the scene's depth → frames, and where they show the surfaces
//
// A test per frame pair sees fast movers only; a slow one is found against a frame that is old enough for its step to
// exceed the noise.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/match/space_search.hpp"
#include "stillpoint/match/surface_search.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// Chooses older frames by the time that has passed.
struct OlderFrameChoice {
  static constexpr std::size_t kLooks = 3;  ///< older frames at the most

  double slowest_m_s = 0.03;  ///< a mover of this speed should be seen against the oldest frame
  double pixel_sigma = 0.7;   ///< of a found place, pixels
  double longest_s = 0.5;     ///< but no frame is older than this, unless frames are few

  /// Fills `matches.past_observations` with frames in which nothing is looked for yet.
  template <class Camera>
  void choose(const FrameHistory& history, const FrameView& current, const Camera& camera, Matches& matches,
              Workspace& workspace) const {
    matches.past_observations.clear();
    for (const std::size_t age : ages(history, current, camera, matches, workspace)) {
      if (age == 0) continue;
      OlderFrame& older = matches.past_observations.add(matches.size());
      older.age = age;
      older.elapsed_s = current.timestamp_s - history.back(age).timestamp_s;
    }
  }

 private:
  static constexpr double kDetectableSigmas = 3.0;    // of the step that the slowest mover makes since the oldest frame
  static constexpr double kLongestAtLowRate_s = 1.0;  // of the oldest, where there are not three within `longest_s`

  /// The last frame, the oldest that is needed, and one between them (their geometric mean in time); 0 is none. The
  /// oldest is the first against which the slowest mover of interest makes a detectable step at the scene's median
  /// depth, and at the least the third: one look can be a reflection.
  template <class Camera>
  std::array<std::size_t, kLooks> ages(const FrameHistory& history, const FrameView& current, const Camera& camera,
                                       const Matches& matches, Workspace& workspace) const {
    const double lateral_sigma_m = pixel_sigma * median_depth_m(matches.current, workspace) / camera.fx();
    const double wanted_s = std::min(kDetectableSigmas * lateral_sigma_m / slowest_m_s, longest_s);
    const auto elapsed_s = [&](std::size_t age) { return current.timestamp_s - history.back(age).timestamp_s; };
    std::size_t oldest = 1;
    while (oldest < history.size() &&
           (elapsed_s(oldest) < wanted_s || (oldest < kLooks && elapsed_s(oldest + 1) < kLongestAtLowRate_s)))
      ++oldest;
    const std::size_t between =
        std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(oldest)))));
    return {1, between < oldest ? between : 0, oldest > 1 ? oldest : 0};
  }
};

/// Writes into each frame where the camera was, seen from the current one, and what it shows in the surfaces' places.
template <class Camera, class Noise>
void look_for_surfaces(const SurfaceSearch& search, const FrameHistory& history, const Pose& filter_from_current,
                       const Camera& camera, const Noise& noise, span<const SurfaceCell> cells,
                       span<OlderFrame> frames) {
  for (OlderFrame& older : frames) {
    const PastFrame& past = history.back(older.age);
    const FrameView view = past.view();
    older.reference_from_current = orthonormalized(composed(inverted(past.filter_from_camera), filter_from_current));
    older.of_surface.clear();
    for (const SurfaceCell& cell : cells)
      older.of_surface.push_back(search.look(cell, view, older.reference_from_current, camera, noise));
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
    look_for_surfaces(surfaces, history, filter_from_expected, camera, noise, matches.past_observations.surfaces,
                      frames.first(1));
    predict_places(frames[0].reference_from_current, camera, matches);
  }
  space.set_static_prior(history.space(), current.timestamp_s, filter_from_expected, camera, noise,
                         surfaces.scaled_step_px(camera), matches, workspace);
}

/// Whether a frame shows a feature clearly where a static one would be.
inline bool stands_in_place(const Observation& observation) noexcept {
  constexpr float kAlike = 0.12f, kThere_px = 0.7f;
  return observation.state == ObservationState::seen && observation.dissimilarity < kAlike &&
         observation.offset_px < kThere_px;
}

/// Where neither the last nor the oldest frame objects to feature `i` being static, those between would not either.
inline bool clearly_stands(std::size_t i, span<const OlderFrame> frames) noexcept {
  return !frames.empty() && stands_in_place(frames[0].of_feature[i]) &&
         stands_in_place(frames[frames.size() - 1].of_feature[i]);
}

/// Calls `bool look_at(frame)`, which fills the observation of feature `i` and says whether to go on, for the last
/// frame, then for the oldest, then for those between, unless it clearly stands.
/// @param in_all  in those between in any case
template <class LookAt>
void look_in_older_frames(std::size_t i, span<OlderFrame> frames, bool in_all, const LookAt& look_at) {
  for (OlderFrame& older : frames) older.of_feature[i] = Observation{};
  if (frames.empty() || !look_at(frames[0])) return;
  for (std::size_t f = frames.size(); f-- > 1;) {
    const bool is_needed = f + 1 == frames.size() || in_all || !clearly_stands(i, frames);
    if (is_needed && !look_at(frames[f])) return;
  }
}

template <class Visit>
void each_option(OlderFrameChoice& choice, Visit& visit) {
  visit("slowest_m_s", choice.slowest_m_s, OptionRange{1e-3, 100});
  visit("pixel_sigma", choice.pixel_sigma, OptionRange{0.01, 100});
  visit("longest_s", choice.longest_s, OptionRange{0, 3600});
}

}  // namespace stillpoint
