// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

#include "stillpoint/core/regions.hpp"

namespace stillpoint_run {

/// One region as the filter had it.
struct UsedRegion {
  stillpoint::Detection detection;
  bool is_carried = false;  ///< it was seen in an earlier frame, not in this one
};

}  // namespace stillpoint_run
