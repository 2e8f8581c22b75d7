// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The matcher of `DefaultPolicies`.

#include "stillpoint/core/options.hpp"
#include "stillpoint/match/corner_tracker.hpp"
#include "stillpoint/match/look_back.hpp"

namespace stillpoint {

/// Support corners one frame back for the ego-motion; then, when the motion is known, every feature in older frames.
struct PatchMatcher {
  CornerTracker corners;  ///< its settings are `corners.options`
  LookBack older;         ///< and `older.options`

  /// Before `match`: a rough motion, from which it begins.
  /// @return reference_from_current
  template <class Camera, class Noise>
  Pose align(const FrameView& reference, const FrameView& current, const Pose& reference_from_expected,
             const Camera& camera, const Noise& noise) {
    return corners.align(reference, current, reference_from_expected, camera, noise);
  }

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    corners.match(reference, current, matches);
  }

  /// Fills `matches.sightings` with frames and surfaces.
  template <class Camera, class Noise>
  void survey(const FrameHistory& history, const FrameView& current, const Pose& filter_from_expected,
              const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) const {
    older.survey(history, current, filter_from_expected, camera, noise, matches, workspace);
  }

  /// And with what became of every feature.
  template <class Camera, class Noise>
  void look_back(const FrameHistory& history, const FrameView& current, const Pose& filter_from_current,
                 const Camera& camera, const Noise& noise, Observations& observations) const {
    older.look_back(history, current, filter_from_current, camera, noise, observations);
  }

  void learn(const Observations& observations, span<const Label> labels) { corners.learn(observations, labels); }

  void reset() noexcept { corners.reset(); }
};

template <class Visit>
void each_option(PatchMatcher& stage, Visit& visit) {
  visit("corners", stage.corners);
  visit("older", stage.older);
}

}  // namespace stillpoint
