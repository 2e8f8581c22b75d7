// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter as most hosts want it: needs Eigen and OpenCV. The paper's and the monocular policies (policies.hpp),
// readers (io/), detectors/ and evaluation/ are included by themselves.

#include "stillpoint/core/compact.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/verdict/keep_flags.hpp"
#include "stillpoint/verdict/masked_depth.hpp"
#include "stillpoint/verdict/weights.hpp"
#include "stillpoint/version.hpp"

#ifdef STILLPOINT_COMPILED
#include "stillpoint/compiled.hpp"
#else
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies/default_policies.hpp"
#endif
