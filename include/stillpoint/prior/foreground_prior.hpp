// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where may something move?   Boxes, and the depth of what is in them: a box is larger than a person.

#include <array>
#include <cstddef>

#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/prior/box_prior.hpp"

namespace stillpoint {

/// Detections of the coming frame, each with the depth of its thing. The thing that a box was drawn around fills most
/// of its middle: the median depth there is the thing's, and what is much nearer or farther is something else seen past
/// it.
class ForegroundPrior : public BoxPrior {
 public:
  double reach_m = 0.2;        ///< the thing reaches this far from the middle's depth, either way
  double fewest_depths = 0.1;  ///< share of the samples that must have a depth; fewer say nothing

  void regions(const FrameView& frame, Regions& regions) const {
    BoxPrior::regions(frame, regions);
    if (frame.depth.empty()) return;
    const DepthScale to_depth(frame.image(), frame.depth.image);
    for (Detection& detection : regions.detections) set_range(frame.depth, to_depth, detection);
  }

 protected:
  /// Leaves the range as it is where there is too little depth.
  void set_range(const DepthView& depth, const DepthScale& to_depth, Detection& detection) const {
    constexpr int kColumns = 9, kRows = 18;
    std::array<float, kColumns * kRows> samples;
    std::size_t count = 0;
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < kColumns; ++i) {
        const float x = (static_cast<float>(i) + 0.5f) / kColumns / 3.0f + 1.0f / 3.0f;  // the middle third
        const float y = (static_cast<float>(j) + 0.5f) / kRows;
        const Box& box = detection.box;
        const Vector2f pixel = to_depth({box.x + x * box.width, box.y + y * box.height});
        const auto depth_m = static_cast<float>(RoundedDepth{}.at(depth, pixel));
        if (depth_m > 0.0f) samples[count++] = depth_m;
      }
    }
    if (static_cast<double>(count) < fewest_depths * kColumns * kRows) return;
    const double middle_m = static_cast<double>(median_in_place(span<float>(samples.data(), count)));
    detection.nearest_m = middle_m - reach_m;
    detection.farthest_m = middle_m + reach_m;
  }
};

}  // namespace stillpoint
