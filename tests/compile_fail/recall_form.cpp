// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory that would look features up without a workspace: it would never be asked.
// expected: stillpoint: Policies::Memory has a member recall, but not void recall(const Matches&, Remembered&, Workspace&); see docs/extending.md

#include "sound_policies.hpp"

struct Recalls : stillpoint::NoMemory {
  void recall(const stillpoint::Matches&, stillpoint::Remembered&) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = Recalls;
#endif
};

template void use<Policies>(const Policies::Camera&);
