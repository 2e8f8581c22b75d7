// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The member is not const.
// expected: stillpoint: Policies::DepthLookup must offer double at(const DepthView&, const Vector2f& depth_pixel) const; see depth/depth_lookup.hpp

#include "sound_policies.hpp"

struct CountingLookup {
  double at(const stillpoint::DepthView&, const stillpoint::Vector2f&) { return ++count; }
  int count = 0;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthLookup = CountingLookup;
#endif
};

template void use<Policies>(const Policies::Camera&);
