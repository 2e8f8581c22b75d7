// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Regions are returned instead of filled.
// expected: stillpoint: Policies::Prior must offer void regions(const FrameView&, Regions&); see prior/box_prior.hpp

#include "sound_policies.hpp"

struct ReturningPrior {
  stillpoint::Regions regions(const stillpoint::FrameView&) const { return {}; }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Prior = ReturningPrior;
#endif
};

template void use<Policies>(const Policies::Camera&);
