// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// NaN and infinity mean something here: no depth, no score, no pixel. Under -ffast-math compilers take them to be
// impossible, and what asks for them reads out of bounds.

#include "stillpoint/core/needs_cpp17.hpp"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "stillpoint needs NaN and infinity: compile this file without -ffast-math, -Ofast and -ffinite-math-only"
#endif
