// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Distances from epipolar lines, of a motion that is fitted to points in space.
// names: SampsonScore,RigidMotion
// expected: stillpoint: this Stage compares fractions of a pixel, and this EgoMotion is fitted to points in space, whose noise hides who walks: take MonocularMotion, EpipolarMotion or SupportMotion, or another score; see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/motion/rigid/rigid_motion.hpp"
#include "stillpoint/score/sampson_score.hpp"

struct Policies : SoundPolicies {
  using Scorer = stillpoint::SampsonScore;
#ifdef STILLPOINT_MISTAKE
  using EgoMotion = stillpoint::RigidMotion;
#endif
};

template void use<Policies>(const Policies::Camera&);
