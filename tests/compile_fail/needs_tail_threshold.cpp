// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Log-odds above the level that few static features exceed, and a gate that gives the mean.
// names: AboveTheTail,MeanGate
// expected: stillpoint: this Stage needs the level that few static features exceed, which this Gate does not give: take TailGate, or RegionClusters; see docs/extending.md

#include "sound_policies.hpp"

struct AboveTheTail : stillpoint::RegionClusters {
  using Needs = stillpoint::Capabilities<stillpoint::capability::tail_threshold>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Classifier = AboveTheTail;
#endif
};

template void use<Policies>(const Policies::Camera&);
