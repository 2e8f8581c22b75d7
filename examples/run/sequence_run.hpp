// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The run itself: each frame through the filtered tracker and, beside it, through the unfiltered one.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "backends.hpp"
#include "csv_files.hpp"
#include "detection_feed.hpp"
#include "figures.hpp"
#include "filters.hpp"
#include "frame_clock.hpp"
#include "frame_source.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "picture_roll.hpp"
#include "progress.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/null_filter.hpp"
#include "stillpoint/verdict/keep_flags.hpp"
#include "video_file.hpp"
#include "video_frame.hpp"
#include "write_down.hpp"

namespace stillpoint_run {

namespace detail {

/// Counts a frame's labels: all in all, and for this frame alone.
/// @throws stillpoint::Error where the label image holds a value that is none.
inline void count_labels(const SourceFrame& frame, FrameRecord& record, stillpoint::FilterScore& score) {
  const auto since = [](const stillpoint::DropCount& now, const stillpoint::DropCount& before) {
    return stillpoint::DropCount{now.features - before.features, now.dropped - before.dropped};
  };
  const stillpoint::DropCount moving = score.moving(), background = score.background();
  try {
    score.add_frame(frame.labels, record.pixels, record.keep);
  } catch (const stillpoint::Error& error) {
    throw stillpoint::Error("labels of the frame at " + stillpoint::format_timestamp(frame.timestamp_s) +
                            " s: " + error.what());
  }
  record.summary.moving = since(score.moving(), moving);
  record.summary.background = since(score.background(), background);
}

/// The mask that the filter predicts of the frame, before it has seen it; an oracle predicts none.
template <class Policies>
void predict_mask(stillpoint::FrameFilter<Policies>& filter, double timestamp_s, stillpoint::ImageBuffer& mask) {
  constexpr int kMargin_px = 0;  // features are asked about, not pixels
  filter.predicted_keep_mask(timestamp_s, kMargin_px, mask);
}
inline void predict_mask(const examples::OracleFilter&, double, const stillpoint::ImageBuffer&) {}

inline void append_pose(const std::optional<stillpoint::Pose>& pose, double timestamp_s,
                        stillpoint::Trajectory& trajectory) {
  if (pose) trajectory.push_back({timestamp_s, *pose});
}

inline std::vector<stillpoint::Detection> detections(const FrameRecord& record) {
  std::vector<stillpoint::Detection> result;
  for (const RegionRow& row : record.regions) result.push_back(row.region.detection);
  return result;
}

/// The poses as a map has them in the end take the place of those that were known at the time.
inline stillpoint::Trajectory adjusted(AnyTracker& tracker, const stillpoint::Trajectory& live) {
  const std::optional<stillpoint::Trajectory> by_map = tracker.trajectory();
  return by_map ? *by_map : live;
}

/// Poses as the files have them: the camera of the run's first frame is the world, if that frame has a pose.
inline void begin_at_identity(stillpoint::Trajectory& trajectory) {
  if (trajectory.empty()) return;
  const stillpoint::Pose first_from_world = trajectory.front().world_from_camera.inverse();
  for (stillpoint::StampedPose& pose : trajectory)
    pose.world_from_camera = stillpoint::orthonormalized(first_from_world * pose.world_from_camera);
}

/// What is known of a run before its first frame.
inline RunRecord begin_run(const Options& options, const FrameSource& source) {
  RunRecord run;
  run.sequence = source.name();
  run.ground_truth = source.ground_truth();
  run.has_backend = options.backend != "none";
  run.has_labels = source.has_labels();
  run.has_depth = source.has_depth();
  run.missing_files = source.missing_files();
  run.assumptions = source.assumptions();
  if (options.depth_noise == "stereo" && !source.stereo_noise())
    run.assumptions.push_back(
        "The depth's baseline is not known: " + stillpoint::format_fixed(stillpoint::StereoNoise{}.baseline_m, 2) +
        " m is assumed (baseline_m in camera.yaml).");
  return run;
}

/// The frame takes its place in the run.
inline void append_frame(const FrameRecord& record, RunRecord& run) {
  for (const auto& [mover, name] : record.movers)
    run.movers.push_back(
        {run.frames.size(), mover.id, mover.state, mover.box, mover.centroid, mover.velocity.norm(), name});
  run.frames.push_back(record.summary);
}

/// What is known after the last frame only: what was missing, the network's times, the map and the poses by it.
inline void finish_run(const FrameSource& source, DetectionFeed& detector, AnyTracker& behind_filter,
                       AnyTracker& unfiltered_backend, RunRecord& run) {
  run.images_without_depth = source.images_without_depth();
  run.detector = detector.finish();
  run.map = behind_filter.map_files();
  run.live = run.filtered;
  run.filtered = adjusted(behind_filter, run.filtered);
  run.unfiltered = adjusted(unfiltered_backend, run.unfiltered);
  for (stillpoint::Trajectory* trajectory : {&run.filtered, &run.unfiltered, &run.live}) begin_at_identity(*trajectory);
}

}  // namespace detail

/// Where the rows go while the run goes on.
struct RunOutput {
  FeaturesFile& features;
  FramesFile& frames;
  PictureRoll& pictures;
  VideoFile* video;    ///< null where nobody asked for one
  MoversFile* movers;  ///< null: not wanted

  void write_rows(const FrameRecord& record) const {
    features.write(record);
    frames.write(record.summary);
    if (movers != nullptr) movers->write(record);
  }
};

/// How many frames the options ask for; empty where only the source's end tells.
inline std::optional<std::size_t> frame_count(const Options& options, const FrameSource& source) {
  const std::optional<std::size_t> size = source.size();
  if (!size && options.frames == std::numeric_limits<int>::max()) return std::nullopt;
  const auto most = static_cast<std::size_t>(options.frames);
  return size ? std::min(*size - static_cast<std::size_t>(options.start), most) : most;
}

/// Runs the frames that the options ask for, or fewer where the source ends or Ctrl-C is pressed; beside a network in a
/// thread of its own no faster than they were taken.
/// @throws stillpoint::Error where a frame can't be read or a row not written, or there is none.
template <class Filter>
RunRecord run_frames(const Options& options, FrameSource& source, DetectionFeed& detector, Filter a_filter,
                     AnyTracker behind_filter, AnyTracker unfiltered_backend, const RunOutput& output) {
  stillpoint::FilteredTracker filtered(std::move(a_filter), std::move(behind_filter));
  filtered.tells_filter = false;  // an odometry's poses may mislead it; those of --backend slam are not told, either
  stillpoint::FilteredTracker unfiltered(stillpoint::NullFilter{}, std::move(unfiltered_backend));
  const bool is_paced = options.has_network() && !options.is_synchronous;
  FrameClock clock;
  const std::optional<std::size_t> count = frame_count(options, source);
  const auto first = static_cast<std::size_t>(options.start);
  Progress progress(count, options.quiet);

  RunRecord run = detail::begin_run(options, source);
  run.has_stages = !std::is_same_v<Filter, examples::OracleFilter>;
  const auto class_name = [&detector](int index) { return detector.class_name(index); };
  VideoFrame drawing(source.camera());
  FrameRecord record;
  stillpoint::ImageBuffer predicted_mask;
  std::vector<std::uint8_t> under_no_mask;
  for (std::size_t i = first; !count || i < first + *count; ++i) {
    const std::optional<SourceFrame> loaded = source.load(i);
    if (!loaded) break;
    const SourceFrame& frame = *loaded;
    const stillpoint::FrameView view = frame.view();
    if (is_paced) clock.wait_for(frame.timestamp_s);
    prepare(filtered.filter, frame, detector.next(frame));
    if (run.has_labels) detail::predict_mask(filtered.filter, frame.timestamp_s, predicted_mask);
    record.summary = FrameSummary{};
    record.summary.timestamp_s = frame.timestamp_s;
    record.summary.time_s =
        frame.timestamp_s - (run.frames.empty() ? frame.timestamp_s : run.frames.front().timestamp_s);
    const auto pose = filtered.track(view, [&](const std::vector<cv::KeyPoint>& keypoints, const auto& result) {
      write_down(view, filtered.filter, keypoints, result, class_name, record);
      filtered.backend.expect_detections(detail::detections(record));
    });
    record.summary.extract_ms = filtered.backend.extract_ms;
    record.summary.track_ms = filtered.backend.track_ms;
    detail::append_pose(pose, frame.timestamp_s, run.filtered);
    if (run.has_backend) {
      const auto same_objects = [&](const auto&, const auto&) {
        unfiltered.backend.expect_detections(detail::detections(record));
      };
      detail::append_pose(unfiltered.track(view, same_objects), frame.timestamp_s, run.unfiltered);
    }
    if (run.has_labels) {
      detail::count_labels(frame, record, run.labels);
      if (run.has_stages) {
        stillpoint::flags_from_mask(predicted_mask.view(), record.pixels, under_no_mask);
        run.predicted_mask.add_frame(frame.labels, record.pixels, under_no_mask);
      }
    }
    output.write_rows(record);
    output.pictures.add(frame, record, source.camera());
    if (output.video != nullptr) output.video->write(drawing.draw(frame, record, run), record.summary.time_s);
    detail::append_frame(record, run);
    progress.frame_done();
    run.was_interrupted = was_interrupted();
    if (run.was_interrupted) break;
  }
  if (run.frames.empty())
    throw stillpoint::Error("--start: found " + std::to_string(options.start) + ", expected less than the number of " +
                            "frames of " + run.sequence);
  detail::finish_run(source, detector, filtered.backend, unfiltered.backend, run);
  return run;
}

}  // namespace stillpoint_run
