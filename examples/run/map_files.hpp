// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is written and drawn of a tracker's map.

#include <array>
#include <string>
#include <vector>

namespace stillpoint_run {

/// A map as PLY, when all frames are tracked.
struct MapFiles {
  std::string ply;
  std::string before_loop;                   ///< as it was before its last loop; empty where none was closed
  std::vector<double> keyframes;             ///< timestamps, seconds; each is a frame of the trajectory
  std::vector<std::array<double, 2>> loops;  ///< timestamps of the two keyframes that each connected
};

}  // namespace stillpoint_run
