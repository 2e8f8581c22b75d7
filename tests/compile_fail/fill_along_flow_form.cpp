// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A filling of holes whose second call wants another argument: it would never be called.
// expected: stillpoint: Policies::HoleFilling has a member fill_along_flow, but not DepthView fill_along_flow(const FrameView& reference, const FrameView& current, const Matches&, const DepthNoise&, Workspace&); see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/depth/no_hole_filling.hpp"

struct FillsAlong : stillpoint::NoHoleFilling {
  void fill_along_flow(int) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using HoleFilling = FillsAlong;
#endif
};

template void use<Policies>(const Policies::Camera&);
