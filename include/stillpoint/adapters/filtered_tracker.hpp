// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Moved to stillpoint/filtered_tracker.hpp: it serves every host. Gone here in 0.3.

#include "stillpoint/filtered_tracker.hpp"
