// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A refinement without the observations: it would never be called.
// expected: stillpoint: Policies::EgoMotion has a member refine, but not void refine(Observations&, const Camera&, const MotionPrior&, Motion&, Workspace&); see docs/extending.md

#include "sound_policies.hpp"

struct RefinesAlone : NoEgoMotion {
  void refine(stillpoint::Motion&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using EgoMotion = RefinesAlone;
#endif
};

template void use<Policies>(const Policies::Camera&);
