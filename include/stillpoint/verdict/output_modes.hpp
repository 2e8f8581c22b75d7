// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Moved: what 0.1 had here is in verdict/weights.hpp, keep_flags.hpp and masked_depth.hpp. Gone in 0.3.

#include "stillpoint/verdict/keep_flags.hpp"
#include "stillpoint/verdict/masked_depth.hpp"
#include "stillpoint/verdict/weights.hpp"
