// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory that may not change the labels.
// expected: stillpoint: Policies::Memory must offer void update(const Matches&, const Motion&, span<const FeatureScore>, span<Label>, Workspace&) and void reset(); see memory/no_memory.hpp

#include "sound_policies.hpp"

struct PowerlessMemory {
  void update(const stillpoint::Matches&, const stillpoint::Motion&, stillpoint::span<const stillpoint::FeatureScore>) {
  }
  void reset() {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = PowerlessMemory;
#endif
};

template void use<Policies>(const Policies::Camera&);
