// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A prior that knows no motion: it would never be called.
// expected: stillpoint: Policies::Prior has a member observe, but not void observe(const Observations&, const Motion&, const Camera&); see docs/extending.md

#include "sound_policies.hpp"

struct ObservesFeatures : stillpoint::BoxPrior {
  void observe(const stillpoint::Observations&) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Prior = ObservesFeatures;
#endif
};

template void use<Policies>(const Policies::Camera&);
