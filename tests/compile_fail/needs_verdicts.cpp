// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A classifier that leaves the decision to a memory, and no memory: every feature would be kept.
// names: NoMemory,Undecided
// expected: stillpoint: this Stage leaves the decision to the classifier, and this Classifier leaves it to the memory: take EvidenceMemory, or RegionClusters; see docs/extending.md

#include "sound_policies.hpp"

struct Undecided : stillpoint::RegionClusters {
  using Provides = stillpoint::Capabilities<stillpoint::capability::log_odds>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Classifier = Undecided;
#endif
};

template void use<Policies>(const Policies::Camera&);
