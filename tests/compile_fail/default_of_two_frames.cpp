// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default set with a matcher of two frames: its scorer would find nothing.
// names: ReprojectionScore,LucasKanade
// expected: stillpoint: this Stage needs the features in older frames, where this Matcher does not look: take PatchMatcher or ProvidedMatches, or a stage that needs two frames (OffsetScore, SampsonScore); see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/policies.hpp"

struct Policies : stillpoint::DefaultPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = stillpoint::LucasKanade;
#endif
};

template void use<Policies>(const Policies::Camera&);
