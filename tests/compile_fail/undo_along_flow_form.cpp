// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A delay whose second call wants another argument: it would never be called.
// expected: stillpoint: Policies::DepthRegistration has a member undo_along_flow, but not DepthView undo_along_flow(const FrameView& as_it_came, const FrameView& current, const Matches&, Workspace&); see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/depth/no_depth_registration.hpp"

struct UndoesAlong : stillpoint::NoDepthRegistration {
  void undo_along_flow(int) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthRegistration = UndoesAlong;
#endif
};

template void use<Policies>(const Policies::Camera&);
