// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// All of the filter: needs Eigen and OpenCV. Readers (io/), detectors/ and evaluation/ are included by themselves.

#include "stillpoint/core/compact.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/verdict/keep_flags.hpp"
#include "stillpoint/verdict/masked_depth.hpp"
#include "stillpoint/verdict/weights.hpp"
#include "stillpoint/version.hpp"
