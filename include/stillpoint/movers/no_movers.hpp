// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Features alone: nobody asks which objects they belong to.

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The null stage: no movers.
struct NoMovers {
  template <class Camera>
  void track(const FrameView&, const Observations&, const Motion&, const Camera&, span<Label>, Movers&,
             Workspace&) const noexcept {}
  void reset() const noexcept {}
};

}  // namespace stillpoint
