// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where may something move?   Boxes, and the depth of what is in them: a box is larger than a person.

#include <optional>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/prior/box_prior.hpp"
#include "stillpoint/prior/object_depth.hpp"

namespace stillpoint {

/// Detections of the coming frame, each with the depth of its object: what is much nearer or farther is something else
/// seen past it. Arms and legs of who walks are outside as well: such regions shift odds, and are too small for a
/// classifier that tests nothing else.
class ForegroundPrior : public BoxPrior {
 public:
  using Provides = Capabilities<>;

  void regions(const FrameView& frame, Regions& regions) const {
    BoxPrior::regions(frame, regions);
    if (frame.depth.empty()) return;
    const DepthScale to_depth(frame.image(), frame.depth.image);
    for (Detection& detection : regions.detections) set_range(frame.depth, to_depth, detection);
  }

 protected:
  static constexpr double kReach_m = 0.1;  // the object reaches this far from its middle's depth, either way

  /// Leaves the range as it is where there is too little depth.
  void set_range(const DepthView& depth, const DepthScale& to_depth, Detection& detection) const {
    const std::optional<ObjectDepth> object = ObjectDepth::measure(depth, to_depth, detection.box);
    if (!object) return;
    detection.nearest_m = object->middle_m - kReach_m;
    detection.farthest_m = object->middle_m + kReach_m;
    detection.depth_slope_m = object->slope_m;
  }
};

}  // namespace stillpoint
