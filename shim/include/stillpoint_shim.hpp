// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// All of the shim: the filter and the compaction of what belongs to the features. C++11 and OpenCV; no Eigen.

#include "stillpoint_shim/compact.hpp"
#include "stillpoint_shim/filter.hpp"
