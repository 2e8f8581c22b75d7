// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The one place the version is written; CMake reads it from here.

#define STILLPOINT_VERSION_MAJOR 0
#define STILLPOINT_VERSION_MINOR 2
#define STILLPOINT_VERSION_PATCH 0
#define STILLPOINT_VERSION "0.2.0"
