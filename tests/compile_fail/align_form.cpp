// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// An alignment without the expected motion: it would never be called.
// expected: stillpoint: Policies::Matcher has a member align, but not Pose align(const FrameView& reference, const FrameView& current, const Pose&, const Camera&, const DepthNoise&); see docs/extending.md

#include "sound_policies.hpp"

struct AlignsImages : stillpoint::ProvidedMatches {
  stillpoint::Pose align(const stillpoint::FrameView&, const stillpoint::FrameView&) {
    return stillpoint::Pose::Identity();
  }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = AlignsImages;
#endif
};

template void use<Policies>(const Policies::Camera&);
