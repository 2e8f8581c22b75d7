// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where was a feature in the last frame that nobody followed?   Where its surface was, as the matched features beside
// it say.

#include <cmath>
#include <cstddef>
#include <limits>

#include "stillpoint/core/depth_tolerance.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Steps of the matched features, from the current frame to the reference, sorted for look-ups. Lives in the workspace.
class NeighbourSteps {
 public:
  /// @param reach_px  how far a neighbour may be
  NeighbourSteps(const Matches& matches, float reach_px, const DepthTolerance& same_surface, Workspace& workspace)
      : matches_(matches),
        reach_px_(reach_px),
        same_surface_(same_surface),
        grid_(matches.current.pixel, reach_px, workspace, [&](std::size_t i) { return matches.matched(i); }) {}

  /// The step of the nearest neighbour on the same surface, else of the nearest; zero where there is none.
  /// @param depth_m  0 none
  Vector2f around(const Vector2f& pixel, double depth_m) const {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    float nearest = kFar;
    Vector2f step = Vector2f::Zero();
    // A neighbour on another surface counts as if it were a reach farther away.
    const double tolerance_m = same_surface_.at(depth_m);
    grid_.within(pixel, reach_px_, [&](std::size_t j, float squared) {
      const double there_m = matches_.current.depth_m[j];
      const bool one_surface = depth_m > 0 && there_m > 0 && std::abs(there_m - depth_m) <= tolerance_m;
      const float distance = std::sqrt(squared) + (one_surface ? 0.0f : reach_px_);
      if (!(distance < nearest)) return;
      nearest = distance;
      step = matches_.reference.pixel[j] - matches_.current.pixel[j];
    });
    return step;
  }

 private:
  const Matches& matches_;
  float reach_px_;
  DepthTolerance same_surface_;
  PixelGrid grid_;
};

}  // namespace stillpoint
