// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default set without its memory, which decides: nothing would be dropped, without a word.
// names: NoMemory,SurfaceClusters
// expected: stillpoint: this Stage leaves the decision to the classifier, and this Classifier leaves it to the memory: take EvidenceMemory, or RegionClusters; see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/policies.hpp"

struct Policies : stillpoint::DefaultPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = stillpoint::NoMemory;
#endif
};

template void use<Policies>(const Policies::Camera&);
