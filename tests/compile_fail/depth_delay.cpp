// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// It does not say how late depth is.
// expected: stillpoint: Policies::DepthDelay must offer DepthView undo(const FrameView&, const Pose&, const Camera&), void observe(const FrameView&, const Matches&, span<const Label>, const Motion&, const Camera&), double frames() const and void reset(); see depth/no_depth_delay.hpp

#include "sound_policies.hpp"

struct UnsaidDelay {
  template <class Camera>
  stillpoint::DepthView undo(const stillpoint::FrameView& frame, const stillpoint::Pose&, const Camera&) {
    return frame.depth;
  }
  template <class Camera>
  void observe(const stillpoint::FrameView&, const stillpoint::Matches&,
               stillpoint::span<const stillpoint::Label>, const stillpoint::Motion&, const Camera&) {}
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthDelay = UnsaidDelay;
#endif
};

template void use<Policies>(const Policies::Camera&);
