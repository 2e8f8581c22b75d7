// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Clusters in space of depths that are no metres.
// names: RegionClusters,Disparity
// expected: stillpoint: this Stage needs depths in metres, which this DepthLookup does not give: take RoundedDepth or GuardedDepth, or for one camera without depth inherit from MonocularPolicies; see docs/extending.md

#include "sound_policies.hpp"

struct Disparity : stillpoint::RoundedDepth {
  using Provides = stillpoint::Capabilities<>;
};

struct InPixels : stillpoint::OffsetScore {
  using Needs = stillpoint::Capabilities<>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthLookup = Disparity;
  using Scorer = InPixels;
#endif
};

template void use<Policies>(const Policies::Camera&);
