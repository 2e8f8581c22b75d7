// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The part of the command line that says where the frames come from.

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "option_checks.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint_run {

/// One source of frames, and what it needs to be told.
struct InputOptions {
  bool demo = false;
  std::filesystem::path tum, euroc, images;
  std::filesystem::path right;  ///< the right images of a rectified pair whose left ones are `images`
  std::filesystem::path bag;    ///< of ROS 1
  std::string image_topic, depth_topic, camera_info_topic;  ///< of the bag; empty: the only one that fits
  bool rectified = false;                                   ///< the bag's images are: P of camera_info
  std::string video;                                        ///< a file, or the number of a camera
  std::filesystem::path camera;                             ///< empty: the sequence's own
  double frame_rate_hz = 0.0;                               ///< 0: the frames tell

  bool has_stereo() const { return !euroc.empty() || !right.empty(); }
  bool has_depth() const { return demo || !tum.empty() || !bag.empty() || has_stereo(); }

  /// The number of a camera that is connected; empty where `video` is a file.
  std::optional<int> device() const {
    int number = 0;
    const auto result = std::from_chars(video.data(), video.data() + video.size(), number);
    const bool is_number = !video.empty() && result.ec == std::errc() && result.ptr == video.data() + video.size();
    return is_number && number >= 0 ? std::optional(number) : std::nullopt;
  }

  /// As on the command line: "--tum FOLDER".
  std::string input_words() const {
    if (demo) return "--demo";
    if (!tum.empty()) return "--tum " + tum.string();
    if (!euroc.empty()) return "--euroc " + euroc.string();
    if (!bag.empty()) return "--bag " + bag.string();
    if (!video.empty()) return "--video " + video;
    return "--images " + images.string() + (right.empty() ? "" : " --right " + right.string());
  }
};

namespace detail {

inline void add_input_options(CLI::App& app, InputOptions& options) {
  const auto add_path = [&app](const char* name, const char* type, auto& path, const char* help) {
    app.add_option(name, path, help)->type_name(type)->check(not_empty())->default_str("");
  };
  app.add_flag("--demo", options.demo, "a synthetic scene, rendered in memory");
  add_path("--tum", "FOLDER", options.tum, "a sequence in the layout of the TUM RGB-D benchmark");
  add_path("--euroc", "FOLDER", options.euroc, "a stereo sequence in the layout of the EuRoC datasets");
  add_path("--bag", "FILE", options.bag, "a ROS 1 bag with images, aligned depth and camera_info");
  add_path("--image-topic", "TOPIC", options.image_topic, "of --bag, if it has more than one");
  add_path("--depth-topic", "TOPIC", options.depth_topic, "of --bag, if it has more than one");
  add_path("--camera-info-topic", "TOPIC", options.camera_info_topic, "of --bag, if not the one beside the image's");
  app.add_flag("--rectified", options.rectified, "the images of --bag are rectified: the camera is P of camera_info");
  add_path("--images", "FOLDER", options.images, "a folder of images, in the order of their names");
  add_path("--right", "FOLDER", options.right,
           "the right images of a rectified stereo pair, named as the left ones in --images");
  add_path("--video", "FILE|N", options.video, "a video, or the number of a camera; Ctrl-C ends it with a report");
  add_path("--camera", "FILE", options.camera, "camera.yaml to use, if the folder has none, or in place of it");
  app.add_option("--fps", options.frame_rate_hz,
                 "frames per second of --images or --video, if names or file do not say it")
      ->type_name("RATE")
      ->check(number(0.001, 10000, "0.001 to 10000"))
      ->default_str("");
}

/// Exactly one source, and nothing that belongs to another.
inline void require_one_input(const CLI::App& app, const InputOptions& options) {
  const auto given = [&app](const char* name) { return app.count(name) > 0; };
  constexpr std::array<const char*, 6> kInputs = {"--demo", "--tum", "--euroc", "--bag", "--images", "--video"};
  const char* found = nullptr;
  for (const char* input : kInputs) {
    if (!given(input)) continue;
    if (found != nullptr)
      throw stillpoint::Error(std::string("found ") + found + " and " + input + ", expected one of them");
    found = input;
  }
  if (given("--right") && !given("--images"))
    throw stillpoint::Error("--right: found without --images, expected --images with the folder of the left images");
  if (found == nullptr)
    throw stillpoint::Error(
        "found no sequence, expected --demo or --tum FOLDER, --euroc FOLDER, --bag FILE, --images FOLDER or --video "
        "FILE|N");
  for (const char* option : {"--image-topic", "--depth-topic", "--camera-info-topic", "--rectified"})
    if (given(option) && !given("--bag"))
      throw stillpoint::Error(std::string(option) + ": found without --bag, expected --bag with a file");
  for (const char* option : {"--camera-info-topic", "--rectified"})
    if (given(option) && given("--camera"))
      throw stillpoint::Error(std::string(option) + ": found with --camera, expected one of them");
  if (given("--camera") && (options.demo || !options.euroc.empty()))
    throw stillpoint::Error("--camera: found with " + std::string(found) +
                            ", whose camera is known; expected it with --tum, --bag, --images or --video");
  if (given("--fps") && options.images.empty() && options.video.empty())
    throw stillpoint::Error("--fps: found with " + std::string(found) +
                            ", whose frames have their times; expected it with --images or --video");
  if (given("--fps") && options.device())
    throw stillpoint::Error("--fps: found with a camera, whose frames are timed by the clock; expected a video file");
}

}  // namespace detail
}  // namespace stillpoint_run
