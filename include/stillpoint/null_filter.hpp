// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter that keeps everything: the unfiltered run beside a filtered one, through the same loop.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Keeps every keypoint of every frame; offers what `FilteredTracker` asks of a filter and nothing else.
class NullFilter {
 public:
  /// One byte per keypoint, all 1. Holds until the filter's next frame.
  class Result {
   public:
    span<const std::uint8_t> keep() const noexcept { return keep_; }

   private:
    friend class NullFilter;
    std::vector<std::uint8_t> keep_;
  };

  template <class Keypoints>
  const Result& filter_frame(const FrameView&, const Keypoints& keypoints) {
    result_.keep_.assign(span(keypoints).size(), 1);
    return result_;
  }

 private:
  Result result_;
};

}  // namespace stillpoint
