// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The command line of stillpoint_run.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "corrections.hpp"
#include "input_options.hpp"
#include "option_checks.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/gate/tail_gate.hpp"
#include "stillpoint/version.hpp"

namespace stillpoint_run {

/// What a run was asked for, as it was given; `parse_options` has checked each value.
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

/// Thrown where the program has answered the command line already: --help, --version.
struct NothingToRun {};

namespace detail {

/// The corrections' names, and for --help what each is.
inline std::vector<std::string> correction_names() {
  std::vector<std::string> names;
  for (const Correction& correction : kCorrections) names.emplace_back(correction.name);
  return names;
}
inline std::string correction_list() {
  std::string list;
  for (const Correction& correction : kCorrections) list += (list.empty() ? "" : ", ") + std::string(correction.name);
  return list;
}
inline std::string correction_help() {
  std::string help = "Corrections of the paper's method, and what --without each is done instead:\n";
  for (const Correction& correction : kCorrections) {
    std::string name = correction.name;
    name.resize(18, ' ');
    help += "  " + name + correction.then + '\n';
  }
  return help;
}

/// A word that names a prior, or a file that is there; what is in it shows when it is read.
inline CLI::Validator prior() {
  return CLI::Validator(
      [](std::string& text) {
        std::error_code ignored;
        for (const char* word : {"none", "boxes", "labels"})
          if (text == word) return std::string();
        if (std::filesystem::exists(text, ignored)) return std::string();
        return "found '" + text + "', and no such file; expected one of none, boxes, labels, or the file of a network";
      },
      "");
}

inline CLI::Validator layout() {
  return CLI::Validator(
      [](std::string& text) {
        try {
          stillpoint::layout_from_name(text);
          return std::string();
        } catch (const stillpoint::Error&) {
          return "found '" + text + "', expected automatic or one of " + stillpoint::layout_names();
        }
      },
      "");
}

/// The ending says which codec.
inline CLI::Validator video_name() {
  return CLI::Validator(
      [](std::string& text) {
        const std::string ending = std::filesystem::path(text).extension().string();
        if (ending == ".mp4" || ending == ".avi") return std::string();
        return "found '" + text + "', expected a name that ends in .mp4 or .avi";
      },
      "");
}

/// What no single option can know.
inline void require_consistent(const CLI::App& app, const Options& options) {
  const auto given = [&app](const char* name) { return app.count(name) > 0; };
  require_one_input(app, options);
  const std::string only_default = ": found with --policies paper, expected it with --policies default, whose it is";
  if (options.policies == "paper")
    for (const char* name : {"--false-positive-rate", "--without"})
      if (given(name)) throw stillpoint::Error(name + only_default);
  if (options.policies == "monocular")
    for (const char* name : {"--ego-motion", "--paper-as-printed", "--depth-noise", "--without"})
      if (given(name))
        throw stillpoint::Error(std::string(name) + ": found with --policies monocular, which has no such choice");
  if (options.policies == "default" && given("--paper-as-printed"))
    throw stillpoint::Error(
        "--paper-as-printed: found with --policies default, which makes none of these errors; expected it with "
        "--policies paper");
  if (options.without("calibrated") && given("--false-positive-rate"))
    throw stillpoint::Error("--false-positive-rate: found with --without calibrated, whose level knows no rate");
  if (options.policies == "default" && options.ego_motion != "default")
    for (const char* name : {"measured-noise", "past-hypothesis", "inertia"})
      if (options.without(name))
        throw stillpoint::Error("--without: found " + std::string(name) + " with --ego-motion " + options.ego_motion +
                                ", expected --ego-motion default, whose correction it is");
  if (options.ego_motion == "rigid")
    for (const char* name : {"eq3", "unit-t"})
      if (options.prints_error(name))
        throw stillpoint::Error("--paper-as-printed: found " + std::string(name) +
                                " with --ego-motion rigid, expected --ego-motion epipolar, whose printed error it is");
  if (options.prior == "boxes" && !options.demo && options.tum.empty())
    throw stillpoint::Error("--prior: found boxes with " + options.input_words() +
                            ", expected none or MODEL; boxes.txt belongs to --tum");
  if (options.prior != "boxes" && given("--drop-boxes"))
    throw stillpoint::Error("--drop-boxes: found without boxes, expected --prior boxes");
  if (options.prior != "boxes" && !options.has_network() && given("--detect-every"))
    throw stillpoint::Error("--detect-every: found without a detector, expected --prior boxes or --prior MODEL");
  if (!options.has_network())
    for (const char* name : {"--detector-layout", "--classes", "--sync"})
      if (given(name)) throw stillpoint::Error(std::string(name) + ": found without a network, expected --prior MODEL");
  if (options.backend != "slam")
    for (const char* name : {"--slam-without", "--mapping-in-step"})
      if (given(name))
        throw stillpoint::Error(std::string(name) + ": found with --backend " + options.backend +
                                ", expected --backend slam, whose part it is");
  if (options.calibrate)
    for (const char* name :
         {"--policies", "--ego-motion", "--paper-as-printed", "--without", "--prior", "--backend", "--save-video"})
      if (given(name))
        throw stillpoint::Error(std::string(name) +
                                ": found with --calibrate, which measures with the default policies and no tracker");
  if (options.prior == "labels")
    for (const char* name : {"--policies", "--ego-motion", "--paper-as-printed", "--depth-noise",
                             "--false-positive-rate", "--without", "--options"})
      if (given(name))
        throw stillpoint::Error(std::string(name) +
                                ": found with --prior labels, which looks the answer up and filters nothing; expected "
                                "--prior none, boxes or MODEL");
}

}  // namespace detail

/// Reads the command line.
/// @throws stillpoint::Error  one line: which argument, what was found, what was expected.
/// @throws NothingToRun       after --help and --version, which print to standard output.
inline Options parse_options(int argument_count, const char* const* arguments) {
  Options options;
  CLI::App app("Runs the stillpoint filter over a sequence and reports what it did.", "stillpoint_run");
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", STILLPOINT_VERSION);
  const int most = std::numeric_limits<int>::max();

  const auto add_path = [&app](const char* name, const char* type, std::filesystem::path& path, const char* help) {
    return app.add_option(name, path, help)->type_name(type)->check(detail::not_empty());
  };
  const auto add_number = [&app](const char* name, auto& number, auto least, auto greatest, const char* help) {
    return app.add_option(name, number, help)->type_name("N")->check(detail::whole_number(least, greatest));
  };
  detail::add_input_options(app, options);
  add_path("--out", "OUT", options.out, "folder of the results; it is made if it does not exist");
  add_path("--save-video", "OUT.mp4", options.save_video,
           "writes a video of the frames with their verdicts, and of the trajectories: .mp4 or .avi")
      ->check(detail::video_name())
      ->default_str("");
  add_path("--options", "FILE", options.stages,
           "options of the filter's stages: an options.yaml that an earlier run or --calibrate wrote; options on the "
           "command line override the file")
      ->default_str("");
  app.add_flag(
      "--calibrate", options.calibrate,
      "measures the noise of pixels and depths on a scene in which nothing moves, and writes OUT/options.yaml; "
      "nothing else is written");
  const CLI::Option* depth_noise =
      detail::add_choice(app, "--depth-noise", options.depth_noise, {"kinect", "stereo", "tof"},
                         "noise model of the depth; default for stereo pairs: stereo");
  const CLI::Option* policies = detail::add_choice(
      app, "--policies", options.policies, {"default", "paper", "monocular"},
      "set of stages: the corrected method, the paper's, or one without depth; default for images without depth: "
      "monocular");
  detail::add_choice(
      app, "--ego-motion", options.ego_motion, {"default", "rigid", "epipolar"},
      "how the camera's motion is estimated; default is that of the policies: weighted by area and static prior "
      "for the default ones, epipolar for the paper's");
  app.add_option("--paper-as-printed", options.as_printed, "printed errors of the paper to repeat, separated by commas")
      ->delimiter(',')
      ->type_name("eq3,eq8,unit-t")
      ->check(detail::one_of({"eq3", "eq8", "unit-t"}, "eq3, eq8, unit-t"))
      ->default_str("");
  app.add_option("--false-positive-rate", options.false_positive_rate,
                 "share of the static features that may be dropped")
      ->type_name("RATE")
      ->check(detail::number(1e-6, 0.5, "0.000001 to 0.5"));
  app.add_option("--without", options.without.names, "corrections to switch off, separated by commas; listed below")
      ->delimiter(',')
      ->type_name("CORRECTION")
      ->check(detail::one_of(detail::correction_names(), detail::correction_list()))
      ->default_str("");
  app.footer(detail::correction_help());
  const CLI::Option* prior =
      app.add_option(
             "--prior", options.prior,
             "where something may move: boxes of the sequence, or what a network finds (MODEL: .onnx, .cfg, .pb "
             "...). labels drops the features by the true labels, for comparison. Default for --demo with the "
             "paper's method: boxes")
          ->type_name("none|boxes|labels|MODEL")
          ->check(detail::prior());
  app.add_option("--detector-layout", options.detector_layout,
                 "layout of the network's outputs, if it is not recognised by their shapes: yolov8, ssd ...")
      ->type_name("NAME")
      ->check(detail::layout());
  app.add_option(
         "--classes", options.classes,
         "the network's classes: a file with one name per line, or coco, coco91, voc, voc21, cityscapes, person")
      ->type_name("FILE")
      ->check(detail::not_empty())
      ->default_str("by the network");
  add_number("--detect-every", options.detect_every, 1, most,
             "the detector runs on every N-th frame; boxes of the other frames are not used");
  app.add_flag("--sync", options.is_synchronous,
               "each frame waits for the network: the same bytes in every run. Without it, the network has a thread of "
               "its own, and frames are replayed in real time");
  app.add_option("--drop-boxes", options.drop_boxes, "share of the boxes that are left out at random, by --seed")
      ->type_name("SHARE")
      ->check(detail::number(0.0, 1.0, "0 to 1"));
  const CLI::Option* backend = detail::add_choice(
      app, "--backend", options.backend, {"odometry", "klt", "orb", "slam", "none"},
      "the tracker behind the filter; slam keeps a map; klt finds its points by a grid, not --features; default "
      "without depth: none");
  app.add_option("--slam-without", options.slam_parts_off, "parts of the SLAM to switch off, separated by commas")
      ->delimiter(',')
      ->type_name("multi-view,bundle,loops,semantics")
      ->check(detail::one_of({"multi-view", "bundle", "loops", "semantics"}, "multi-view, bundle, loops, semantics"))
      ->default_str("");
  app.add_flag(
      "--mapping-in-step", options.maps_in_step,
      "each frame waits for the SLAM's mapping: the same bytes in every run. Without it, mapping has a thread of "
      "its own");
  add_number("--features", options.features, 1, 100000, "ORB features per frame");
  add_number("--start", options.start, 0, most, "first frame, counted from 0");
  add_number("--frames", options.frames, 1, most, "largest number of frames")->default_str("all");
  add_number("--seed", options.seed, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(),
             "seed of the filter's random numbers");
  add_number("--threads", options.threads, 1, 1024, "threads that OpenCV may use; results do not depend on it");
  app.add_flag(
      "--no-movers", options.no_movers,
      "follows no objects and writes no movers.csv; verdicts are the same. With policies other than the default "
      "ones the file is always empty");
  app.add_flag("--quiet", options.quiet, "no progress on standard error");

  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::Success& answered) {
    app.exit(answered);
    throw NothingToRun{};
  } catch (const CLI::ParseError& error) {
    throw stillpoint::Error(std::string(error.what()) + " (stillpoint_run --help lists the arguments)");
  }
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0) options.given.push_back("--" + option->get_lnames().front());
  if (!options.has_depth() && policies->empty()) options.policies = "monocular";
  detail::require_consistent(app, options);
  if (options.has_stereo() && depth_noise->empty()) options.depth_noise = "stereo";
  if (!options.has_depth() && backend->empty()) options.backend = "none";  // ours takes depth
  // The paper tests features in boxes only: without them its demo would have nothing to show.
  if (options.demo && options.policies == "paper" && prior->empty()) options.prior = "boxes";
  return options;
}

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
  const bool all_frames = options.frames == std::numeric_limits<int>::max();
  return {
      {"sequence", options.input_words()},
      {"--camera", options.camera.empty() ? "not given" : options.camera.string()},
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
      {"--threads", std::to_string(options.threads)}};
}

}  // namespace stillpoint_run
