// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Holes of the depth image stay holes.

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// The null stage: a pixel without a depth has none.
struct NoHoleFilling {
  template <class Camera, class Noise>
  DepthView fill(const FrameView&, const FrameView& current, const Pose&, const Camera&, const Noise&) const noexcept {
    return current.depth;
  }
  void reset() const noexcept {}
};

}  // namespace stillpoint
