// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The pose alone: nobody would know whether it is valid.
// expected: stillpoint: Policies::EgoMotion must offer Motion estimate(const Observations&, const Camera&, const MotionPrior&, Workspace&); see motion/rigid/rigid_motion.hpp

#include "sound_policies.hpp"

struct PoseAlone {
  stillpoint::Pose estimate(const stillpoint::Observations&, const stillpoint::Camera&, const stillpoint::MotionPrior&,
                            stillpoint::Workspace&) const {
    return stillpoint::Pose::Identity();
  }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using EgoMotion = PoseAlone;
#endif
};

template void use<Policies>(const Policies::Camera&);
