// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A matcher that learns from labels alone: it would never be told.
// expected: stillpoint: Policies::Matcher has a member learn, but not void learn(const Observations&, span<const Label>); see docs/extending.md

#include "sound_policies.hpp"

struct LearnsLabels : stillpoint::ProvidedMatches {
  void learn(stillpoint::span<const stillpoint::Label>) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = LearnsLabels;
#endif
};

template void use<Policies>(const Policies::Camera&);
