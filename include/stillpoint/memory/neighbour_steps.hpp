// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where was a feature in the last frame that nobody followed?   Where its surface was, as the matched features beside
// it say.

#include <cmath>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Steps of the matched features, from the current frame to the reference, sorted for look-ups. Lives in the workspace.
class NeighbourSteps {
 public:
  /// @param reach_px  how far a neighbour may be
  NeighbourSteps(const Matches& matches, float reach_px, Workspace& workspace)
      : matches_(matches),
        reach_px_(reach_px),
        grid_(matches.current.pixel, reach_px, workspace, [&](std::size_t i) { return matches.matched(i); }) {}

  /// The pixel in the reference frame, by the step of the nearest neighbour on the same surface.
  /// @param depth_m      0 none
  /// @param tolerance_m  by which depths on its surface may differ
  /// @param if_static   where it was if it stands still: the answer where there is no such neighbour
  Vector2f before(const Vector2f& pixel, double depth_m, double tolerance_m, const Vector2f& if_static) const {
    if (!(depth_m > 0)) return if_static;
    const std::size_t nearest = grid_.nearest(pixel, reach_px_, [&](std::size_t j, float) {
      return std::abs(matches_.current.depth_m[j] - depth_m) <= tolerance_m;
    });
    if (nearest == PixelGrid::kNone) return if_static;
    return pixel + matches_.reference.pixel[nearest] - matches_.current.pixel[nearest];
  }

 private:
  const Matches& matches_;
  float reach_px_;
  PixelGrid grid_;
};

}  // namespace stillpoint
