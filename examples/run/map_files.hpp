// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is written of a tracker's map.

#include <string>

namespace stillpoint_run {

/// A map as PLY, when all frames are tracked.
struct MapFiles {
  std::string ply;
  std::string before_loop;  ///< as it was before its last loop; empty where none was closed
};

}  // namespace stillpoint_run
