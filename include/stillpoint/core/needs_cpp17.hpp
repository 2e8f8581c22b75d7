// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The first line that a compiler in an older standard meets. It ends there, with one error: behind an #error it would
// go on and list every name that it does not know. The test is of MSVC's own macro, too, as __cplusplus is 199711
// there.

#if !(__cplusplus >= 201703L || (defined(_MSVC_LANG) && _MSVC_LANG >= 201703L))
#include "stillpoint needs C++17: compile this file with -std=c++17 or later"
#endif
