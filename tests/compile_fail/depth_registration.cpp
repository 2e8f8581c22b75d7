// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// It does not say whether it found anything.
// expected: stillpoint: Policies::DepthRegistration must offer DepthView undo(const FrameView& reference, const FrameView& current, const Pose& current_from_reference, const Camera&), void observe(const FrameView&, const Matches&, span<const Label>, const Motion&, const Camera&), Warnings warnings() const and void reset(); see depth/no_depth_registration.hpp

#include "sound_policies.hpp"

struct UnsaidRegistration {
  template <class Camera>
  stillpoint::DepthView undo(const stillpoint::FrameView&, const stillpoint::FrameView& current,
                             const stillpoint::Pose&, const Camera&) {
    return current.depth;
  }
  template <class Camera>
  void observe(const stillpoint::FrameView&, const stillpoint::Matches&, stillpoint::span<const stillpoint::Label>,
               const stillpoint::Motion&, const Camera&) {}
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthRegistration = UnsaidRegistration;
#endif
};

template void use<Policies>(const Policies::Camera&);
