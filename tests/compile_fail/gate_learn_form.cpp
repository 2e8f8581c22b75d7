// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A gate that learns from labels alone: it would never be told.
// expected: stillpoint: Policies::Gate has a member learn, but not void learn(const Observations&, span<const Label>); see docs/extending.md

#include "sound_policies.hpp"

struct LearnsLabels : stillpoint::MeanGate {
  void learn(stillpoint::span<const stillpoint::Label>) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Gate = LearnsLabels;
#endif
};

template void use<Policies>(const Policies::Camera&);
