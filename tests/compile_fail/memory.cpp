// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory that cannot forget.
// expected: stillpoint: Policies::Memory must offer void update(const Observations&, const Motion&, const Evidence&, span<Label>, Workspace&) and void reset(); see memory/no_memory.hpp

#include "sound_policies.hpp"

struct UnforgettingMemory {
  void update(const stillpoint::Observations&, const stillpoint::Motion&, const stillpoint::Evidence&,
              stillpoint::span<stillpoint::Label>, stillpoint::Workspace&) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = UnforgettingMemory;
#endif
};

template void use<Policies>(const Policies::Camera&);
