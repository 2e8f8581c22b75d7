// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Depth is used as it comes.

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/warnings.hpp"

namespace stillpoint {

/// The null stage: each depth image lies on its image.
struct NoDepthRegistration {
  template <class Camera>
  DepthView undo(const FrameView& /*reference*/, const FrameView& current, const Pose&, const Camera&) const noexcept {
    return current.depth;
  }
  template <class Camera>
  void observe(const FrameView&, const Matches&, span<const Label>, const Motion&, const Camera&) const noexcept {}
  Warnings warnings() const noexcept { return {}; }
  void reset() const noexcept {}
};

}  // namespace stillpoint
