// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Scores of the host's features, and a matcher of corners of its own.
// names: OffsetScore,CornersOnly
// expected: stillpoint: this Stage needs matches of the host's features with the reference frame, which this Matcher does not give: take LucasKanade or ProvidedMatches, or a stage of DefaultPolicies; see docs/extending.md

#include "sound_policies.hpp"

struct CornersOnly : stillpoint::ProvidedMatches {
  using Provides = stillpoint::Capabilities<stillpoint::capability::matches>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = CornersOnly;
#endif
};

template void use<Policies>(const Policies::Camera&);
