// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A memory that wants the number of features: it would never be told.
// expected: stillpoint: Policies::Memory has a member expect_dynamic, but not void expect_dynamic(span<const std::uint8_t>); see docs/extending.md

#include "sound_policies.hpp"

struct ExpectsMany : stillpoint::NoMemory {
  void expect_dynamic(std::size_t) {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Memory = ExpectsMany;
#endif
};

template void use<Policies>(const Policies::Camera&);
