// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory of log-odds behind a classifier that has verdicts alone.
// names: AddsUp,RegionClusters
// expected: stillpoint: this Stage adds up log-odds, which this Classifier does not give: take SurfaceClusters or FlowNeighbours, or NoMemory; see docs/extending.md

#include "sound_policies.hpp"

struct AddsUp : stillpoint::NoMemory {
  using Needs = stillpoint::Capabilities<stillpoint::capability::log_odds>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = AddsUp;
#endif
};

template void use<Policies>(const Policies::Camera&);
