// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// It does not ask how noisy the depth is.
// expected: stillpoint: Policies::HoleFilling must offer DepthView fill(const FrameView& reference, const FrameView& current, const Pose& current_from_reference, const Camera&, const DepthNoise&) and void reset(); see depth/no_hole_filling.hpp

#include "sound_policies.hpp"

struct FillingWithoutNoise {
  template <class Camera>
  stillpoint::DepthView fill(const stillpoint::FrameView&, const stillpoint::FrameView& current,
                             const stillpoint::Pose&, const Camera&) {
    return current.depth;
  }
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using HoleFilling = FillingWithoutNoise;
#endif
};

template void use<Policies>(const Policies::Camera&);
