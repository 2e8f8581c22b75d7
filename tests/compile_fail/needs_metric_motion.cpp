// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Offsets in metres, of a motion whose length nobody knows.
// names: OffsetScore,UpToScale
// expected: stillpoint: this Stage needs a motion in metres, which this EgoMotion does not give: take SupportMotion, RigidMotion or EpipolarMotion, or SampsonScore; see docs/extending.md

#include "sound_policies.hpp"

struct UpToScale : NoEgoMotion {
  using Provides = stillpoint::Capabilities<>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using EgoMotion = UpToScale;
#endif
};

template void use<Policies>(const Policies::Camera&);
