// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A static feature that was uncovered a moment ago: an older frame that saw what hid it says nothing of it.

#include <cstddef>
#include <limits>

#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/match/observation_order.hpp"

namespace stillpoint {

/// Dissimilarity of a patch in a frame that can't be compared, as where something nearer hides the place: there a
/// feature scores 0 nats (ReprojectionScore: 2.5 nats expected, 0.12 each). What contradicts is above, what fits below.
inline constexpr float kNoEvidence = 0.3f;

/// A feature that the last frame clearly shows in its place is static. An older frame that shows something else there,
/// nearer, says nothing of it: it becomes `occluded`. Where a frame between shows the feature in another place it has
/// moved, and all that is older counts.
///
/// A surface that is nearer by less than 15 cm (`PlaceTest::margin_m`) hides nothing by its depth alone, since noise
/// and slopes look like that, too: a book that stands against the box that was pushed along it looked changed.
inline void forget_where_hidden(std::size_t i, span<OlderFrame> frames) noexcept {
  if (frames.empty() || !stands_in_place(frames[0].of_feature[i])) return;
  bool may_be_hidden = true;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    Observation& observation = frames[f].of_feature[i];
    if (observation.state != ObservationState::seen) continue;
    if (may_be_hidden && observation.shows_nearer && observation.dissimilarity > kNoEvidence) {
      observation.state = ObservationState::occluded;
      observation.dissimilarity = std::numeric_limits<float>::quiet_NaN();
    } else {
      may_be_hidden = stands_in_place(observation);
    }
  }
}

}  // namespace stillpoint
