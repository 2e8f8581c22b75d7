// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Keyframes that nothing is looked for in: neither would be called.
// expected: stillpoint: Policies::Matcher must offer both or neither of void choose_keyframes(const FrameHistory&, const FrameView&, const Pose&, const Camera&, const DepthNoise&, Matches&, Workspace&) and void reproject_into_past(const FrameHistory&, const FrameView&, const Pose&, const Camera&, const DepthNoise&, Observations&); see docs/extending.md

#include "sound_policies.hpp"

struct ChoosesAlone : stillpoint::ProvidedMatches {
  void choose_keyframes(int) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = ChoosesAlone;
#endif
};

template void use<Policies>(const Policies::Camera&);
