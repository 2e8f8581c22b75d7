// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A level in nats for scores that are offsets.
// names: TailGate,OffsetScore
// expected: stillpoint: this Stage needs scores in nats, which this Scorer does not give: take ReprojectionScore or SampsonScore, or MeanGate and RegionClusters; see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/gate/tail_gate.hpp"

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Gate = stillpoint::TailGate;
#endif
};

template void use<Policies>(const Policies::Camera&);
