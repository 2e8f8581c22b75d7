// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A policy set that remembers no frame: there would be nothing to compare with.
// expected: stillpoint: Policies must have static constexpr std::size_t kHistoryLength, 1 or more; see policies.hpp

#include "sound_policies.hpp"

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  static constexpr std::size_t kHistoryLength = 0;
#endif
};

template void use<Policies>(const Policies::Camera&);
