// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A host that tracks its features itself hands its matches over and pays for no matching.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/matches.hpp"

namespace stillpoint {

/// Takes the host's own tracks. Before each `filter_frame`, set `reference_pixels`: one entry for each key point, in
/// their order: where it was in the last frame that was filtered (distorted pixels), NaN where it was not seen.
/// They are used once and cleared. A list of another length means that the host gave no matches for this frame: every
/// feature is lost.
class ProvidedMatches {
 public:
  struct Options {
    float border_px = 10.0f;  ///< nearer to either image's border a feature stays out of ego-motion; 0: none
  };
  Options options;

  std::vector<Vector2f> reference_pixels;

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    for (std::size_t i = 0; i < matches.host_count && reference_pixels.size() == matches.host_count; ++i) {
      const Vector2f pixel = matches.current.pixel[i], before = reference_pixels[i];
      const float here = current.gray.border_distance_px(pixel.x(), pixel.y());
      const float there = reference.gray.border_distance_px(before.x(), before.y());
      if (!(here >= 0.0f)) {
        matches.state[i] = MatchState::outside;
      } else if (there >= 0.0f) {
        matches.reference.pixel[i] = before;
        matches.state[i] = std::min(here, there) < options.border_px ? MatchState::near_edge : MatchState::matched;
      }
    }
    reference_pixels.clear();
  }

  void reset() noexcept { reference_pixels.clear(); }
};

}  // namespace stillpoint
