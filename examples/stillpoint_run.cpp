// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Runs the filter over a sequence, with a tracker behind it and the same tracker without it beside it, and reports what
// it did: trajectories, every feature's verdict, figures, a page to look at.

#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>

#include "run/backends.hpp"
#include "run/calibration.hpp"
#include "run/command_line.hpp"
#include "run/csv_files.hpp"
#include "run/detection_feed.hpp"
#include "run/figures.hpp"
#include "run/filters.hpp"
#include "run/frame_source.hpp"
#include "run/interrupt.hpp"
#include "run/open_source.hpp"
#include "run/options.hpp"
#include "run/options_json.hpp"
#include "run/picture_roll.hpp"
#include "run/report_html.hpp"
#include "run/report_json.hpp"
#include "run/result_files.hpp"
#include "run/sequence_run.hpp"
#include "run/video_file.hpp"
#include "run/words.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/options/options_file.hpp"

namespace stillpoint_run {
namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw stillpoint::Error("--out: found " + folder.string() + ", expected a folder or a place where one can be made" +
                            (error ? " (" + error.message() + ")" : ""));
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  stillpoint::AtomicFile output(file);
  output.write(text);
  output.commit();
}

/// An oracle has no options.
template <class Filter>
void describe(Filter& filter, std::string& yaml, nlohmann::ordered_json& json) {
  if constexpr (!std::is_same_v<Filter, examples::OracleFilter>) {
    yaml = stillpoint::options_as_yaml(filter);
    json = options_json(filter);
  }
}

void calibrate_camera(const Options& options, FrameSource& source) {
  make_folder(options.out);
  const CalibrationRecord record = calibrate(options, source);
  write_whole(options.out / "options.yaml", record.yaml);
  for (const std::string& sentence : sentences(record)) std::printf("%s\n", sentence.c_str());
  std::printf("Options: %s\n", (options.out / "options.yaml").string().c_str());
}

/// Nothing gets its name before everything is computed: after an error OUT is as it was. The video comes last, so that
/// one that can't get its name costs no results.
void run(const Options& options) {
  cv::setNumThreads(options.threads);
  const std::unique_ptr<FrameSource> source = open_source(options);
  catch_interrupt();
  if (options.calibrate) return calibrate_camera(options, *source);
  const std::unique_ptr<DetectionFeed> detector = open_feed(options);
  make_folder(options.out);
  ResultFiles results(options.out);
  FeaturesFile features(results.open("features.csv"));
  FramesFile frames(results.open("frames.csv"));
  PictureRoll roll;
  std::optional<VideoFile> video;
  if (!options.save_video.empty()) video.emplace(options.save_video);
  std::optional<MoversFile> movers;
  if (!options.no_movers) movers.emplace(results.open("movers.csv"));

  std::string yaml;
  nlohmann::ordered_json stages;
  const RunRecord record = with_filter(options, *source, [&](auto filter) {
    describe(filter, yaml, stages);
    const auto tracker = [&] { return make_tracker(options, source->camera()); };
    return run_frames(options, *source, *detector, std::move(filter), tracker(), tracker(),
                      RunOutput{features, frames, roll, video ? &*video : nullptr, movers ? &*movers : nullptr});
  });
  const Figures figures = evaluate(record);
  const std::string json = report_json(options, record, figures, stages);
  const std::string html = report_html(options, record, figures, source->camera(), roll);

  if (video) video->finish();
  results.add("trajectory.txt", record.filtered);
  results.add("trajectory_unfiltered.txt", record.unfiltered);
  if (record.map) {
    results.add("trajectory_live.txt", record.live);
    results.add("map.ply", record.map->ply);
    if (!record.map->before_loop.empty()) results.add("map_before_loop.ply", record.map->before_loop);
  }
  if (!yaml.empty()) results.add("options.yaml", yaml);
  results.add("report.json", json);
  results.add("report.html", html);
  results.finish();
  results.commit();
  if (video) video->commit();
  for (const std::string& sentence : sentences(options, record, figures)) std::printf("%s\n", sentence.c_str());
  if (video) std::printf("Video: %s\n", options.save_video.string().c_str());
  std::printf("Report: %s\n", (options.out / "report.html").string().c_str());
}

/// An error is one line, whatever names of files are in it.
std::string one_line(std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  return message;
}

/// What is left of standard output is written, or it is an error: the disk may be full.
void flush_output() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.flush())
    throw stillpoint::Error(std::string("standard output: cannot write") +
                            (errno != 0 ? ": " + std::generic_category().message(errno) : ""));
}

}  // namespace
}  // namespace stillpoint_run

int main(int argument_count, char** arguments) {
  constexpr int kFailed = 2;
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // an error is one line, and ours
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);                              // FFmpeg's messages: AV_LOG_QUIET
  try {
    try {
      stillpoint_run::run(stillpoint_run::parse_options(argument_count, arguments));
    } catch (const stillpoint_run::NothingToRun&) {
    }
    stillpoint_run::flush_output();
    return 0;
  } catch (const stillpoint::ReplacedOptionsError& error) {  // the one with a list
    std::fprintf(stderr, "stillpoint_run: %s\n", error.what());
    return kFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_run: %s\n", stillpoint_run::one_line(error.what()).c_str());
    return kFailed;
  }
}
