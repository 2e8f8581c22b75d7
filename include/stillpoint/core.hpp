// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What goes into the filter and what comes out of it: all that a host's own header has to name. Needs Eigen alone, and
// is quick to compile; the pipeline (filter_frame.hpp) and its stages (policies.hpp) are for the one file that runs
// them.

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/status.hpp"
#include "stillpoint/depth/depth_noise.hpp"
