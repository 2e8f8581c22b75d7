// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a run was asked for.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "corrections.hpp"
#include "input_options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/gate/tail_gate.hpp"

namespace stillpoint_run {

/// What a run was asked for, as it was given; `parse_options` (command_line.hpp) has checked each value.
struct Options : InputOptions {
  std::filesystem::path out = "stillpoint_out";
  std::filesystem::path save_video;  ///< empty: none
  std::filesystem::path stages;      ///< options of the filter's stages; empty: the defaults
  bool calibrate = false;            ///< measures noise and writes options, in place of a run
  std::string depth_noise = "kinect";
  std::string policies = "default";
  std::string ego_motion = "default";
  std::vector<std::string> as_printed;  ///< of eq3, eq8, unit-t
  double false_positive_rate = stillpoint::TailGate::Options{}.false_positive_rate;
  Without without;             ///< corrections that are switched off
  std::string prior = "none";  ///< none, boxes, labels, or the file of a network
  std::string detector_layout = "automatic";
  std::string classes;          ///< a list of ClassList or a file; empty: by the network
  int detect_every = 1;         ///< frames from one that the detector is offered to the next
  bool is_synchronous = false;  ///< the network is waited for
  double drop_boxes = 0.0;      ///< share of the boxes that is left out
  std::string backend = "odometry";
  std::vector<std::string> slam_parts_off;  ///< of multi-view, bundle, loops, semantics
  bool maps_in_step = false;                ///< mapping is waited for
  int features = 1000;
  int start = 0;
  int frames = std::numeric_limits<int>::max();
  std::uint64_t seed = stillpoint::Random::kDefaultSeed;
  int threads = 1;
  bool no_movers = false;
  bool quiet = false;
  std::vector<std::string> given;  ///< the arguments that were there, as --name

  bool is_given(std::string_view name) const { return std::find(given.begin(), given.end(), name) != given.end(); }
  bool has_network() const { return prior != "none" && prior != "boxes" && prior != "labels"; }
  /// Movers are followed by the default stages alone: others have no metres, or no verdicts to follow.
  bool has_movers() const {
    return !no_movers && policies == "default" && prior != "labels" && ego_motion == "default" &&
           !without.needs_other_stages();
  }
  /// As reports have it: a network by the name of its file.
  std::string prior_name() const { return has_network() ? std::filesystem::path(prior).filename().string() : prior; }

  bool slam_without(std::string_view part) const {
    return std::find(slam_parts_off.begin(), slam_parts_off.end(), part) != slam_parts_off.end();
  }
  bool prints_error(std::string_view name) const {
    for (const std::string& printed : as_printed)
      if (printed == name) return true;
    return false;
  }
};

}  // namespace stillpoint_run
