// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// WithMovers: a set of policies that also follows the objects that move.

#include "stillpoint/fwd.hpp"
#include "stillpoint/movers/mover_tracking.hpp"
#ifdef STILLPOINT_COMPILED
#include "stillpoint/compiled.hpp"
#else
#include "stillpoint/policies/default_policies.hpp"
#endif

namespace stillpoint {

/// The stages of a set, and `FrameResult::movers()` beside their verdicts.
template <class Policies>
struct WithMovers : Policies {
  using Movers = MoverTracking;
};

}  // namespace stillpoint
