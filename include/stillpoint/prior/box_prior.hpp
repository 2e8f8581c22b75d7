// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The semantic prior: boxes of a detector, sorted into the paper's three groups.   detections → regions

#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"

namespace stillpoint {

/// Hands the detections of the current frame on (the paper, 3.2). Set `detections` before each `filter_frame`.
class BoxPrior {
 public:
  struct Options {
    float lowest_confidence = 0.0f;  ///< detections below it are left out; detectors apply their own threshold already
  };
  Options options;

  std::vector<Detection> detections;  ///< of the coming frame; the host's to write, kept until it writes again

  /// Detections that are not finite, have no area or a mask of the wrong size are left out.
  void regions(const FrameView&, Regions& regions) const {
    regions.detections.clear();
    for (const Detection& detection : detections)
      if (is_valid(detection)) regions.detections.push_back(detection);
  }

 protected:
  bool is_valid(const Detection& detection) const noexcept {
    return valid(detection.box) && valid(detection.mask.get()) && detection.confidence >= options.lowest_confidence;
  }

 private:
  static bool valid(const Box& box) noexcept {
    return std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) && std::isfinite(box.height) &&
           box.width > 0 && box.height > 0;
  }
  static bool valid(const BoxMask* mask) noexcept {
    return mask == nullptr ||
           (mask->columns > 0 && mask->rows > 0 &&
            mask->inside.size() == static_cast<std::size_t>(mask->columns) * static_cast<std::size_t>(mask->rows));
  }
};

/// No prior: nothing is known of any place.
struct NoPrior {
  void regions(const FrameView&, Regions& regions) const noexcept { regions.detections.clear(); }
};

template <class Visit>
void each_option(BoxPrior& stage, Visit& visit) {
  visit("lowest_confidence", stage.options.lowest_confidence, OptionRange{0, 1});
}

}  // namespace stillpoint
