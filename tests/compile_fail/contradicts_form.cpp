// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A doubt that knows no camera: it would never be asked.
// expected: stillpoint: Policies::Matcher has a member contradicts, but not bool contradicts(const Pose&, const Camera&) const; see docs/extending.md

#include "sound_policies.hpp"

struct ContradictsAlone : stillpoint::ProvidedMatches {
  bool contradicts(const stillpoint::Pose&) const { return false; }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = ContradictsAlone;
#endif
};

template void use<Policies>(const Policies::Camera&);
