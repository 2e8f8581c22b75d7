// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which options of a run exclude each other.

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <string>

#include "input_options.hpp"
#include "options.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint_run::detail {

/// What no single option can know.
/// @throws stillpoint::Error  that names the first of the options that do not fit, and what it was found with.
inline void require_consistent(const CLI::App& app, const Options& options) {
  require_one_input(app, options);
  const auto refuse = [&app](bool applies, std::initializer_list<const char*> names, const std::string& found) {
    for (const char* name : names)
      if (applies && app.count(name) > 0) throw stillpoint::Error(std::string(name) + ": found " + found);
  };
  const auto refuse_value = [](const char* name, const std::string& value, const std::string& found) {
    throw stillpoint::Error(std::string(name) + ": found " + value + ' ' + found);
  };
  refuse(options.policies == "paper", {"--false-positive-rate", "--without"},
         "with --policies paper, expected it with --policies default, whose it is");
  refuse(options.policies == "monocular", {"--ego-motion", "--paper-as-printed", "--depth-noise", "--without"},
         "with --policies monocular, which has no such choice");
  refuse(options.policies == "default", {"--paper-as-printed"},
         "with --policies default, which makes none of these errors; expected it with --policies paper");
  refuse(options.without("calibrated"), {"--false-positive-rate"},
         "with --without calibrated, whose level knows no rate");
  if (options.policies == "default" && options.ego_motion != "default")
    for (const char* name : {"measured-noise", "past-hypothesis", "inertia"})
      if (options.without(name))
        refuse_value(
            "--without", name,
            "with --ego-motion " + options.ego_motion + ", expected --ego-motion default, whose correction it is");
  if (options.ego_motion == "rigid")
    for (const char* name : {"eq3", "unit-t"})
      if (options.prints_error(name))
        refuse_value("--paper-as-printed", name,
                     "with --ego-motion rigid, expected --ego-motion epipolar, whose printed error it is");
  if (options.prior == "boxes" && !options.demo && options.tum.empty())
    refuse_value("--prior", "boxes",
                 "with " + options.input_words() + ", expected none or MODEL; boxes.txt belongs to --tum");
  refuse(options.prior != "boxes", {"--drop-boxes"}, "without boxes, expected --prior boxes");
  refuse(options.prior != "boxes" && !options.has_network(), {"--detect-every"},
         "without a detector, expected --prior boxes or --prior MODEL");
  refuse(!options.has_network(), {"--detector-layout", "--classes", "--sync"},
         "without a network, expected --prior MODEL");
  refuse(options.backend != "slam", {"--slam-without", "--mapping-in-step"},
         "with --backend " + options.backend + ", expected --backend slam, whose part it is");
  refuse(options.calibrate,
         {"--policies", "--ego-motion", "--paper-as-printed", "--without", "--prior", "--backend", "--save-video"},
         "with --calibrate, which measures with the default policies and no tracker");
  refuse(options.prior == "labels",
         {"--policies", "--ego-motion", "--paper-as-printed", "--depth-noise", "--false-positive-rate", "--without",
          "--options"},
         "with --prior labels, which looks the answer up and filters nothing; expected --prior none, boxes or MODEL");
}

}  // namespace stillpoint_run::detail
