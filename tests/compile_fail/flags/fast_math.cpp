// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Compiled with a flag that makes NaN undefined: refused in the first line, whichever header comes first.

#include "stillpoint/core/frame_result.hpp"
