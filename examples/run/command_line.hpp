// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The command line of stillpoint_run.

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "corrections.hpp"
#include "input_options.hpp"
#include "option_checks.hpp"
#include "option_conflicts.hpp"
#include "options.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/version.hpp"

namespace stillpoint_run {

/// Thrown where the program has answered the command line already: --help, --version.
struct NothingToRun {};

namespace detail {

constexpr int kLargest = std::numeric_limits<int>::max();

inline CLI::Option* add_path(CLI::App& app, const char* name, const char* type, std::filesystem::path& path,
                             const char* help) {
  return app.add_option(name, path, help)->type_name(type)->check(not_empty());
}

template <class Number>
CLI::Option* add_number(CLI::App& app, const char* name, Number& number, Number least, Number most, const char* help) {
  return app.add_option(name, number, help)->type_name("N")->check(whole_number(least, most));
}

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

inline void add_result_options(CLI::App& app, Options& options) {
  add_path(app, "--out", "OUT", options.out, "folder of the results; it is made if it does not exist");
  add_path(app, "--save-video", "OUT.mp4", options.save_video,
           "writes a video of the frames with their verdicts, and of the trajectories: .mp4 or .avi")
      ->check(video_name())
      ->default_str("");
  add_path(app, "--options", "FILE", options.stages,
           "options of the filter's stages: an options.yaml that an earlier run or --calibrate wrote; options on the "
           "command line override the file")
      ->default_str("");
  app.add_flag(
      "--calibrate", options.calibrate,
      "measures the noise of pixels and depths on a scene in which nothing moves, and writes OUT/options.yaml; "
      "nothing else is written");
}

inline void add_method_options(CLI::App& app, Options& options) {
  add_choice(app, "--depth-noise", options.depth_noise, {"kinect", "stereo", "tof"},
             "noise model of the depth; default for stereo pairs: stereo");
  add_choice(
      app, "--policies", options.policies, {"default", "paper", "monocular"},
      "set of stages: the corrected method, the paper's, or one without depth; default for images without depth: "
      "monocular");
  add_choice(app, "--ego-motion", options.ego_motion, {"default", "rigid", "epipolar"},
             "how the camera's motion is estimated; default is that of the policies: weighted by area and static prior "
             "for the default ones, epipolar for the paper's");
  app.add_option("--paper-as-printed", options.as_printed, "printed errors of the paper to repeat, separated by commas")
      ->delimiter(',')
      ->type_name("eq3,eq8,unit-t")
      ->check(one_of({"eq3", "eq8", "unit-t"}, "eq3, eq8, unit-t"))
      ->default_str("");
  app.add_option("--false-positive-rate", options.false_positive_rate,
                 "share of the static features that may be dropped")
      ->type_name("RATE")
      ->check(number(1e-6, 0.5, "0.000001 to 0.5"));
  app.add_option("--without", options.without.names, "corrections to switch off, separated by commas; listed below")
      ->delimiter(',')
      ->type_name("CORRECTION")
      ->check(one_of(correction_names(), correction_list()))
      ->default_str("");
  app.footer(correction_help());
}

inline void add_detector_options(CLI::App& app, Options& options) {
  app.add_option("--prior", options.prior,
                 "where something may move: boxes of the sequence, or what a network finds (MODEL: .onnx, .cfg, .pb "
                 "...). labels drops the features by the true labels, for comparison. Default for --demo with the "
                 "paper's method: boxes")
      ->type_name("none|boxes|labels|MODEL")
      ->check(prior());
  app.add_option("--detector-layout", options.detector_layout,
                 "layout of the network's outputs, if it is not recognised by their shapes: yolov8, ssd ...")
      ->type_name("NAME")
      ->check(layout());
  app.add_option(
         "--classes", options.classes,
         "the network's classes: a file with one name per line, or coco, coco91, voc, voc21, cityscapes, person")
      ->type_name("FILE")
      ->check(not_empty())
      ->default_str("by the network");
  add_number(app, "--detect-every", options.detect_every, 1, kLargest,
             "the detector runs on every N-th frame; boxes of the other frames are not used");
  app.add_flag("--sync", options.is_synchronous,
               "each frame waits for the network: the same bytes in every run. Without it, the network has a thread of "
               "its own, and frames are replayed in real time");
  app.add_option("--drop-boxes", options.drop_boxes, "share of the boxes that are left out at random, by --seed")
      ->type_name("SHARE")
      ->check(number(0.0, 1.0, "0 to 1"));
}

inline void add_backend_options(CLI::App& app, Options& options) {
  add_choice(app, "--backend", options.backend, {"odometry", "klt", "orb", "slam", "none"},
             "the tracker behind the filter; slam keeps a map; klt finds its points by a grid, not --features; default "
             "without depth: none");
  app.add_option("--slam-without", options.slam_parts_off, "parts of the SLAM to switch off, separated by commas")
      ->delimiter(',')
      ->type_name("multi-view,bundle,loops,semantics")
      ->check(one_of({"multi-view", "bundle", "loops", "semantics"}, "multi-view, bundle, loops, semantics"))
      ->default_str("");
  app.add_flag(
      "--mapping-in-step", options.maps_in_step,
      "each frame waits for the SLAM's mapping: the same bytes in every run. Without it, mapping has a thread of "
      "its own");
}

inline void add_run_options(CLI::App& app, Options& options) {
  add_number(app, "--features", options.features, 1, 100000, "ORB features per frame");
  add_number(app, "--start", options.start, 0, kLargest, "first frame, counted from 0");
  add_number(app, "--frames", options.frames, 1, kLargest, "largest number of frames")->default_str("all");
  add_number(app, "--seed", options.seed, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(),
             "seed of the filter's random numbers");
  add_number(app, "--threads", options.threads, 1, 1024, "threads that OpenCV may use; results do not depend on it");
  app.add_flag(
      "--no-movers", options.no_movers,
      "follows no objects and writes no movers.csv; verdicts are the same. With policies other than the default "
      "ones the file is always empty");
  app.add_flag("--quiet", options.quiet, "no progress on standard error");
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
  detail::add_input_options(app, options);
  detail::add_result_options(app, options);
  detail::add_method_options(app, options);
  detail::add_detector_options(app, options);
  detail::add_backend_options(app, options);
  detail::add_run_options(app, options);
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
  if (!options.has_depth() && !options.is_given("--policies")) options.policies = "monocular";
  detail::require_consistent(app, options);
  if (options.has_stereo() && !options.is_given("--depth-noise")) options.depth_noise = "stereo";
  if (!options.has_depth() && !options.is_given("--backend")) options.backend = "none";  // ours takes depth
  // The paper tests features in boxes only: without them its demo would have nothing to show.
  if (options.demo && options.policies == "paper" && !options.is_given("--prior")) options.prior = "boxes";
  return options;
}

}  // namespace stillpoint_run
