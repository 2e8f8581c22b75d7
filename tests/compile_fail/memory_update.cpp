// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory that may not change the labels.
// expected: stillpoint: Policies::Memory must offer void update(const Observations&, const Motion&, const Evidence&, span<Label>, Workspace&) and void reset(); see memory/no_memory.hpp

#include "sound_policies.hpp"

struct PowerlessMemory {
  void update(const stillpoint::Observations&, const stillpoint::Motion&, const stillpoint::Evidence&) {}
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = PowerlessMemory;
#endif
};

template void use<Policies>(const Policies::Camera&);
