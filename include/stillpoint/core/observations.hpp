// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// All that is observed of a frame before it is judged, and the evidence that scores and threshold make of it.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// What was known of features and surfaces before this frame. Parallel to `Matches` and to its surface cells.
struct Remembered {
  std::vector<float> static_prior;          ///< of features, 0 to 1: their weight in the camera's motion
  std::vector<float> log_odds;              ///< that it moves, from earlier frames; 0 where nothing is remembered, nats
  std::vector<float> surface_static_prior;  ///< of surface cells, 0 to 1: the same

  /// Nothing is remembered: the static prior is that of free space in the past seconds.
  void begin(const Matches& matches) {
    static_prior = matches.space_static_prior;
    refill(log_odds, matches.size(), 0.0f);
    surface_static_prior.resize(matches.past_observations.surfaces.size());
    std::transform(matches.past_observations.surfaces.begin(), matches.past_observations.surfaces.end(),
                   surface_static_prior.begin(), [](const SurfaceCell& cell) { return cell.space_static_prior; });
  }
};

/// Where each feature was, where something may move, and what is remembered. Motion, scorer, classifier and memory read
/// it; each part is written by one stage.
struct Observations {
  Matches matches;        ///< by the matcher
  Regions regions;        ///< by the prior
  Remembered remembered;  ///< by the memory

  std::size_t size() const noexcept { return matches.size(); }
};

/// How badly each feature disagrees with the camera's motion, and from where on that is more than noise.
struct Evidence {
  span<const FeatureScore> scores;  ///< by the scorer, one per feature
  Threshold threshold;              ///< by the gate
};

}  // namespace stillpoint
