// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// In which order are older frames asked for a feature, and when do they agree that it is static?

#include <cstddef>

#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

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

/// Calls `bool observe(frame)`, which fills the observation of feature `i` and says whether to go on, for the last
/// frame, then for the oldest, then for those between, unless it clearly stands.
/// @param in_all  in those between in any case
template <class Observe>
void visit_older_frames(std::size_t i, span<OlderFrame> frames, bool in_all, const Observe& observe) {
  for (OlderFrame& older : frames) older.of_feature[i] = Observation{};
  if (frames.empty() || !observe(frames[0])) return;
  for (std::size_t f = frames.size(); f-- > 1;) {
    const bool is_needed = f + 1 == frames.size() || in_all || !clearly_stands(i, frames);
    if (is_needed && !observe(frames[f])) return;
  }
}

}  // namespace stillpoint
