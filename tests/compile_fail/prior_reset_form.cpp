// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A prior whose reset wants an argument: it would never be called.
// expected: stillpoint: Policies::Prior has a member reset, but not void reset(); see docs/extending.md

#include "sound_policies.hpp"

struct ResetsTo : stillpoint::BoxPrior {
  void reset(int) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Prior = ResetsTo;
#endif
};

template void use<Policies>(const Policies::Camera&);
