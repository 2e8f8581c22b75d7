// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter with movers whose options are in no file: one filter to compile, whether the program follows them or not.

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/movers/mover_tracking.hpp"
#include "stillpoint/policies/default_policies.hpp"

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

struct WithSwitchedMovers : stillpoint::DefaultPolicies {
  using Movers = SwitchedMovers;
};

}  // namespace stillpoint_run
