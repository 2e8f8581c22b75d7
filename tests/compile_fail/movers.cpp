// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Movers that do not see the frame.
// expected: stillpoint: Policies::Movers must offer void track(const FrameView&, const Observations&, const Motion&, const Camera&, span<Label>, Movers&, Workspace&) and void reset(); see movers/no_movers.hpp

#include "sound_policies.hpp"

struct BlindMovers {
  void track(const stillpoint::Observations&, const stillpoint::Motion&, stillpoint::span<const stillpoint::Label>,
             stillpoint::Movers&, stillpoint::Workspace&) const {}
  void reset() const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Movers = BlindMovers;
#endif
};

template void use<Policies>(const Policies::Camera&);
