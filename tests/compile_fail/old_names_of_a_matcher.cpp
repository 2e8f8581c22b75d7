// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The names of 0.1: they would never be called.
// expected: stillpoint: survey and look_back of Policies::Matcher are called choose_keyframes and reproject_into_past now; see CHANGELOG.md

#include "sound_policies.hpp"

struct Surveys : stillpoint::ProvidedMatches {
  void survey(int) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = Surveys;
#endif
};

template void use<Policies>(const Policies::Camera&);
