// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The settings of a run as reports list them.

#include <charconv>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"

namespace stillpoint_run {

/// Name and value of each setting of a run, for the report.
inline std::vector<std::pair<std::string, std::string>> settings(const Options& options) {
  const auto joined = [](const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
    return list.empty() ? std::string("nothing") : list;
  };
  const bool is_paper = options.policies == "paper";
  const auto shortest = [](double number) {
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  };
  // A file of options goes before the defaults of the command line.
  const auto unless_by_file = [&options](const char* name, std::string value) {
    return options.stages.empty() || options.is_given(name) ? std::move(value) : std::string("by --options");
  };
  const auto of_bag = [&options](const std::string& topic) {
    return options.bag.empty() ? std::string("n/a") : topic.empty() ? std::string("the only one") : topic;
  };
  const bool all_frames = options.frames == std::numeric_limits<int>::max();
  return {
      {"sequence", options.input_words()},
      {"--camera", options.camera.empty() ? "not given" : options.camera.string()},
      {"--image-topic", of_bag(options.image_topic)},
      {"--depth-topic", of_bag(options.depth_topic)},
      {"--camera-info-topic", of_bag(options.camera_info_topic)},
      {"--rectified", options.bag.empty() ? "n/a"
                      : options.rectified ? "yes"
                                          : "no"},
      {"--fps", options.frame_rate_hz > 0 ? shortest(options.frame_rate_hz) : "as the frames say"},
      {"--options", options.stages.empty() ? "defaults" : options.stages.string()},
      {"--depth-noise", unless_by_file("--depth-noise", options.depth_noise)},
      {"--policies", options.policies},
      {"--ego-motion", options.ego_motion},
      {"--paper-as-printed", is_paper ? unless_by_file("--paper-as-printed", joined(options.as_printed)) : "nothing"},
      {"--false-positive-rate",
       is_paper ? "n/a" : unless_by_file("--false-positive-rate", shortest(options.false_positive_rate))},
      {"--without", joined(options.without.names)},
      {"--prior", options.prior},
      {"--detector-layout", options.has_network() ? options.detector_layout : "n/a"},
      {"--classes", !options.has_network()    ? "n/a"
                    : options.classes.empty() ? "by the network"
                                              : options.classes},
      {"--detect-every", std::to_string(options.detect_every)},
      {"--sync", !options.has_network()   ? "n/a"
                 : options.is_synchronous ? "yes"
                                          : "no"},
      {"--drop-boxes", shortest(options.drop_boxes)},
      {"--backend", options.backend},
      {"--slam-without", options.backend == "slam" ? joined(options.slam_parts_off) : "n/a"},
      {"--mapping-in-step", options.backend != "slam" ? "n/a"
                            : options.maps_in_step    ? "yes"
                                                      : "no"},
      {"--features", std::to_string(options.features)},
      {"--start", std::to_string(options.start)},
      {"--frames", all_frames ? "all" : std::to_string(options.frames)},
      {"--seed", unless_by_file("--seed", std::to_string(options.seed))},
      {"--threads", std::to_string(options.threads)},
      {"--no-movers", options.no_movers ? "yes" : "no"}};
}

}  // namespace stillpoint_run
