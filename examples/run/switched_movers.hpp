// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The default filter with all that the command line switches, movers too: one filter to compile for all of them.

#include "corrections_policies.hpp"
#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/movers/mover_tracking.hpp"

namespace stillpoint_run {

/// Its options are in no file: a host's filter without movers reads what this program wrote.
struct SwitchedMovers {
  using Needs = stillpoint::MoverTracking::Needs;

  SwitchedMovers() { tracking.gives_back = false; }  // the verdicts are those of DefaultPolicies

  stillpoint::MoverTracking tracking;

  template <class Camera>
  void track(const stillpoint::FrameView& frame, const stillpoint::Observations& observations,
             const stillpoint::Motion& motion, const Camera& camera, stillpoint::span<stillpoint::Label> labels,
             stillpoint::Movers& result, stillpoint::Workspace& workspace) {
    tracking.track(frame, observations, motion, camera, labels, result, workspace);
  }
  void reset() { tracking.reset(); }
};

struct WithSwitchedMovers : SwitchedPolicies {
  using Movers = SwitchedMovers;
};

}  // namespace stillpoint_run
