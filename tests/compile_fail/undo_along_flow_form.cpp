// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A delay whose second call wants another argument: it would never be called.
// expected: stillpoint: Policies::DepthDelay has a member undo_along_flow, but not DepthView undo_along_flow(const FrameView& as_it_came, const FrameView& current, const Matches&, Workspace&); see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/depth/no_depth_delay.hpp"

struct UndoesAlong : stillpoint::NoDepthDelay {
  void undo_along_flow(int) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthDelay = UndoesAlong;
#endif
};

template void use<Policies>(const Policies::Camera&);
