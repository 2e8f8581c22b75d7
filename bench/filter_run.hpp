// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The whole filter over the frames of a clip, again and again.

#include <cstddef>

#include "clip.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint::bench {

namespace detail {

/// Only a matcher that takes tracks gets them.
template <class Matcher>
auto give_tracks(Matcher& matcher, const ClipFrame& frame, int)
    -> decltype(matcher.reference_pixels = frame.reference_pixels, void()) {
  matcher.reference_pixels = frame.reference_pixels;
}
template <class Matcher>
void give_tracks(Matcher&, const ClipFrame&, long) {}

}  // namespace detail

/// Does to a clip what a host does before its tracking.
template <class Policies>
class FilterRun {
 public:
  explicit FilterRun(const Clip& clip) : clip_(clip), filter_(clip.camera) {}

  /// Outside of what is timed: forgets the frames, and sees the first, with which there is nothing to compare.
  void begin() {
    filter_.reset();
    filter(0);
  }

  /// @param i  from 1, the frames in their order
  const FrameResult& filter(std::size_t i) {
    const ClipFrame& frame = clip_.frames[i];
    filter_.prior.detections = frame.detections;
    detail::give_tracks(filter_.matcher, frame, 0);
    return filter_.filter_frame(frame.view(), frame.keypoints);
  }

 private:
  const Clip& clip_;
  FrameFilter<Policies> filter_;
};

}  // namespace stillpoint::bench
