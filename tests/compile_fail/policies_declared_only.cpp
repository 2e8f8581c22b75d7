// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A set that is declared alone, as stillpoint.hpp declares PaperPolicies.
// expected: stillpoint: these Policies are declared, but not defined: include their header, as policies.hpp for PaperPolicies and MonocularPolicies, policies/with_movers.hpp for WithMovers

#include "sound_policies.hpp"

struct Policies;
#ifndef STILLPOINT_MISTAKE
struct Policies : SoundPolicies {};
#endif

void use(stillpoint::FrameFilter<Policies>& filter) { filter.reset(); }
