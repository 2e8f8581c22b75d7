// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A prior that cuts boxes by depth, and a classifier that tests nothing outside them: half of a person is missed.
// names: RegionClusters,ForegroundPrior
// expected: stillpoint: this Stage tests only what lies in boxes, and this Prior cuts them by depth, so that half of a person would be missed: take BoxPrior, or SurfaceClusters; see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/prior/foreground_prior.hpp"

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Prior = stillpoint::ForegroundPrior;
#endif
};

template void use<Policies>(const Policies::Camera&);
