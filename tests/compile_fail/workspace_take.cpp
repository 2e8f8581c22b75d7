// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The arena runs no destructors: what needs one would leak.
// expected: Workspace::take<T>: T must be trivially destructible.

#include <string>

#include "stillpoint/core/workspace.hpp"

#ifdef STILLPOINT_MISTAKE
using Element = std::string;
#else
using Element = double;
#endif

void take_three(stillpoint::Workspace& workspace) { workspace.take<Element>(3); }
