// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A host that follows its features itself: what the default engine does with its tracks.

#include <opencv2/core/types.hpp>

#include "backends/followed_corners.hpp"
#include "clip.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint::bench {

/// The default engine on the host's own tracks.
struct TrackPolicies : DefaultPolicies {
  using Matcher = ProvidedMatches;
};

/// The same frames with corners that Lucas-Kanade has followed, in place of ORB's keypoints.
/// @param sequence  a `Clip` or a `LabelledSequence`
template <class Sequence>
Sequence with_followed_corners(Sequence sequence) {
  examples::FollowedCorners corners(kFeatures);
  for (auto& frame : sequence.frames) {
    corners.next(frame.gray);
    frame.keypoints.clear();
    for (const Vector2f& pixel : corners.pixels) frame.keypoints.emplace_back(pixel.x(), pixel.y(), 1.0f);
    frame.reference_pixels = corners.reference_pixels;
  }
  return sequence;
}

}  // namespace stillpoint::bench
