// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The matcher of `DefaultPolicies`.

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/match/corner_tracker.hpp"
#include "stillpoint/match/past_reprojection.hpp"

namespace stillpoint {

/// Support corners one frame back for the ego-motion; then, when the motion is known, every feature in older frames.
struct PatchMatcher {
  using Needs = Capabilities<capability::metric_depth>;
  using Provides = Capabilities<capability::matches, capability::past_observations>;

  CornerTracker corners;   ///< its settings are `corners.options`
  PastReprojection older;  ///< and `older.options`

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

  /// After the motion: do the frames as a whole look like another one?
  template <class Camera>
  bool contradicts(const Pose& reference_from_current, const Camera& camera) const {
    return corners.contradicts(reference_from_current, camera);
  }

  /// Fills `matches.past_observations` with frames and surfaces.
  template <class Camera, class Noise>
  void choose_keyframes(const FrameHistory& history, const FrameView& current, const Pose& filter_from_expected,
                        const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) const {
    older.choose_keyframes(history, current, filter_from_expected, camera, noise, matches, workspace);
  }

  /// And with what became of every feature.
  template <class Camera, class Noise>
  void reproject_into_past(const FrameHistory& history, const FrameView& current, const Pose& filter_from_current,
                           const Camera& camera, const Noise& noise, Observations& observations) const {
    older.reproject_into_past(history, current, filter_from_current, camera, noise, observations);
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
