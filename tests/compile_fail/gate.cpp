// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A gate that keeps its threshold to itself.
// expected: stillpoint: Policies::Gate must offer Threshold threshold(span<const FeatureScore>, const Regions&, Workspace&); see gate/mean_gate.hpp

#include "sound_policies.hpp"

struct SilentGate {
  void threshold(stillpoint::span<const stillpoint::FeatureScore>, const stillpoint::Regions&,
                 stillpoint::Workspace&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Gate = SilentGate;
#endif
};

template void use<Policies>(const Policies::Camera&);
