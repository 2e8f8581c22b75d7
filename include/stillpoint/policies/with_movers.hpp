// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// WithMovers: a set of policies that also follows the objects that move.

#include "stillpoint/movers/mover_tracking.hpp"
#include "stillpoint/policies/default_policies.hpp"

namespace stillpoint {

/// The stages of a set, and `FrameResult::movers()` beside their verdicts.
template <class Policies = DefaultPolicies>
struct WithMovers : Policies {
  using Movers = MoverTracking;
};

}  // namespace stillpoint
