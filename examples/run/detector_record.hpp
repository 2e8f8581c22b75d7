// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "stillpoint/detectors/async_detector.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint_run {

/// What became of the frames that a network was offered.
struct DetectorRecord {
  stillpoint::DetectorLayout layout = stillpoint::DetectorLayout::automatic;
  stillpoint::InputSize input;
  stillpoint::DetectorCounters counters;
  std::vector<double> times_ms;  ///< of each detection that went well
  std::string last_error;        ///< empty: all went well
};

}  // namespace stillpoint_run
