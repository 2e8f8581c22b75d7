// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What stands and was uncovered a moment ago   An older frame that saw what hid it says nothing of it.

#include <array>
#include <cstddef>
#include <limits>

#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/match/older_frames.hpp"

namespace stillpoint {

/// Whether each older frame shows something nearer in a feature's place; false where it has no depth there.
using ShowsNearer = std::array<bool, OlderFrameChoice::kLooks>;

/// The last frame shows feature `i` where it is, if it stands. What an older frame shows there instead, unlike and
/// nearer, hid it: that frame becomes `occluded`. So does every frame before it, but none before one that shows the
/// feature in another place: what has moved was not hidden.
///
/// A surface that is nearer by less than `PlaceTest::kOcclusion_m` hides nothing by its depth alone, since noise and
/// slopes look like that, too: a book that stands against the box that was pushed along it looked changed.
inline void forget_where_hidden(std::size_t i, const ShowsNearer& shows_nearer, span<OlderFrame> frames) noexcept {
  constexpr float kUnlike = 0.3f;  // where a patch is no evidence for either, by ReprojectionScore
  if (frames.empty() || !stands_in_place(frames[0].of_feature[i])) return;
  bool may_be_hidden = true;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    Observation& observation = frames[f].of_feature[i];
    if (observation.state != ObservationState::seen) continue;
    if (may_be_hidden && shows_nearer[f] && observation.dissimilarity > kUnlike) {
      observation.state = ObservationState::occluded;
      observation.dissimilarity = std::numeric_limits<float>::quiet_NaN();
    } else {
      may_be_hidden = stands_in_place(observation);
    }
  }
}

}  // namespace stillpoint
