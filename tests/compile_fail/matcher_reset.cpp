// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A matcher that can't be told to forget its pyramids.
// expected: stillpoint: Policies::Matcher must offer void match(const FrameView& reference, const FrameView& current, Matches&) and void reset(); see match/provided_matches.hpp

#include "sound_policies.hpp"

struct UnforgettingMatcher {
  void match(const stillpoint::FrameView&, const stillpoint::FrameView&, stillpoint::Matches&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = UnforgettingMatcher;
#endif
};

template void use<Policies>(const Policies::Camera&);
