// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A motion from matches, and a matcher that finds none in the reference frame.
// names: FromMatches,OlderFramesOnly
// expected: stillpoint: this Stage needs matches with the reference frame, which this Matcher does not give: take PatchMatcher, LucasKanade or ProvidedMatches; see docs/extending.md

#include "sound_policies.hpp"

struct OlderFramesOnly : stillpoint::ProvidedMatches {
  using Provides = stillpoint::Capabilities<stillpoint::capability::feature_matches>;
};

struct FromMatches : NoEgoMotion {
  using Needs = stillpoint::Capabilities<stillpoint::capability::matches>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = OlderFramesOnly;
  using EgoMotion = FromMatches;
#endif
};

template void use<Policies>(const Policies::Camera&);
