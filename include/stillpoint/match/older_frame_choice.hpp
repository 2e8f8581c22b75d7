// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// With which older frames is the current one compared?   The history, the scene's depth → ages
//
// A test per frame pair sees fast movers only; a slow one is found against a frame that is old enough for its step to
// exceed the noise.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// Chooses older frames by the time that has passed.
struct OlderFrameChoice {
  static constexpr std::size_t kMostFrames = 3;  ///< that are chosen

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
  /// depth, and at the least the third: one observation may be of a reflection.
  template <class Camera>
  std::array<std::size_t, kMostFrames> ages(const FrameHistory& history, const FrameView& current, const Camera& camera,
                                            const Matches& matches, Workspace& workspace) const {
    const double lateral_sigma_m = pixel_sigma * median_depth_m(matches.current, workspace) / camera.fx();
    const double wanted_s = std::min(kDetectableSigmas * lateral_sigma_m / slowest_m_s, longest_s);
    const auto elapsed_s = [&](std::size_t age) { return current.timestamp_s - history.back(age).timestamp_s; };
    std::size_t oldest = 1;
    while (oldest < history.size() &&
           (elapsed_s(oldest) < wanted_s || (oldest < kMostFrames && elapsed_s(oldest + 1) < kLongestAtLowRate_s)))
      ++oldest;
    const std::size_t between =
        std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(oldest)))));
    return {1, between < oldest ? between : 0, oldest > 1 ? oldest : 0};
  }
};

template <class Visit>
void each_option(OlderFrameChoice& choice, Visit& visit) {
  visit("slowest_m_s", choice.slowest_m_s, OptionRange{1e-3, 100});
  visit("pixel_sigma", choice.pixel_sigma, OptionRange{0.01, 100});
  visit("longest_s", choice.longest_s, OptionRange{0, 3600});
}

}  // namespace stillpoint
