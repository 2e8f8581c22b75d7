// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A matcher that does not ask for the reference frame.
// expected: stillpoint: Policies::Matcher must offer void match(const FrameView& reference, const FrameView& current, Matches&) and void reset(); see match/provided_matches.hpp

#include "sound_policies.hpp"

struct ForgetfulMatcher {
  void match(const stillpoint::FrameView& current, stillpoint::Matches&) const { (void)current; }
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = ForgetfulMatcher;
#endif
};

template void use<Policies>(const Policies::Camera&);
