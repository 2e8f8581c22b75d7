// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// All policy sets, one type for each stage of `FrameFilter`, and the matcher of hosts with tracks of their own.
// stillpoint.hpp has DefaultPolicies alone: what the others need takes as long to compile again.

#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/policies/default_policies.hpp"
#include "stillpoint/policies/monocular_policies.hpp"
#include "stillpoint/policies/paper_policies.hpp"
