// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where the frames come from: what all sources have in common, a folder with depth, and the synthetic scene.

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "options.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/io/boxes_file.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/moving_day.hpp"
#include "stillpoint/synthetic/renderer.hpp"

namespace stillpoint_run {

/// One frame and all that is known of it. Owns its images.
struct SourceFrame {
  double timestamp_s = 0.0;
  cv::Mat gray, colour;                        ///< CV_8UC1 and CV_8UC3
  cv::Mat depth;                               ///< CV_16UC1, or CV_32FC1 in metres; empty where there is none
  double depth_factor = 5000.0;                ///< of a 16-bit depth
  cv::Mat labels;                              ///< CV_8UC1, values of PixelLabel; empty where there are none
  std::vector<stillpoint::DetectedBox> boxes;  ///< empty unless the run's prior asks for them

  stillpoint::FrameView view() const {
    stillpoint::FrameView frame(gray, stillpoint::DepthView(depth, depth_factor), timestamp_s);
    frame.colour = colour;
    return frame;
  }
};

/// A sequence of frames with a camera. One call per frame: virtual functions cost nothing here.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  virtual std::string name() const = 0;
  /// Empty where only the end tells.
  virtual std::optional<std::size_t> size() const = 0;
  virtual const stillpoint::Camera& camera() const = 0;
  /// world_from_camera; empty where nobody knows.
  virtual const std::optional<stillpoint::Trajectory>& ground_truth() const = 0;
  virtual bool has_labels() const { return false; }
  virtual bool has_depth() const { return true; }
  /// Of depth from a stereo pair; empty where nobody knows its baseline.
  virtual std::optional<stillpoint::StereoNoise> stereo_noise() const { return std::nullopt; }
  /// Images that lists name and that are not there: their frames are left out.
  virtual std::size_t missing_files() const { return 0; }
  /// Images so far that had no depth of their time: they are no frames.
  virtual std::size_t images_without_depth() const { return 0; }
  /// What is taken for true because nobody said, one sentence each.
  virtual std::vector<std::string> assumptions() const { return {}; }
  /// Nothing behind the last frame. Indices must rise from call to call.
  /// @throws stillpoint::Error where a file of the frame can't be read.
  virtual std::optional<SourceFrame> load(std::size_t index) = 0;
};

/// Of a source whose camera's path nobody knows.
inline const std::optional<stillpoint::Trajectory> kNoGroundTruth;

/// The last part of a path, however it is written.
inline std::string last_name(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(path, ignored).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// A folder in the layout of the TUM benchmark.
class TumSource : public FrameSource {
 public:
  explicit TumSource(const Options& options)
      : sequence_(options.tum,
                  options.camera.empty() ? std::nullopt : std::optional(stillpoint::read_camera(options.camera))) {
    if (options.prior == "boxes") boxes_ = stillpoint::read_boxes(options.tum / "boxes.txt");
  }

  std::string name() const override { return last_name(sequence_.folder()); }
  std::optional<std::size_t> size() const override { return sequence_.frames().size(); }
  const stillpoint::Camera& camera() const override { return sequence_.camera(); }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return sequence_.ground_truth(); }
  bool has_labels() const override { return sequence_.has_labels(); }
  std::size_t missing_files() const override { return sequence_.missing_files(); }
  std::size_t images_without_depth() const override { return sequence_.images_without_depth(); }
  std::optional<stillpoint::StereoNoise> stereo_noise() const override {
    if (!sequence_.baseline_m()) return std::nullopt;
    stillpoint::StereoNoise noise;
    noise.focal_px = camera().fx();
    noise.baseline_m = *sequence_.baseline_m();
    return noise;
  }

  std::optional<SourceFrame> load(std::size_t index) override {
    if (index >= sequence_.frames().size()) return std::nullopt;
    stillpoint::RgbdImages images = sequence_.load(index);
    SourceFrame frame;
    frame.timestamp_s = sequence_.frames()[index].timestamp_s;
    frame.colour = images.colour;
    frame.depth = images.depth;
    frame.depth_factor = sequence_.depth_factor();
    cv::cvtColor(frame.colour, frame.gray, cv::COLOR_BGR2GRAY);
    if (has_labels()) frame.labels = sequence_.load_labels(index);
    if (const stillpoint::FrameBoxes* found = stillpoint::boxes_at(boxes_, frame.timestamp_s))
      frame.boxes = found->boxes;
    return frame;
  }

 private:
  stillpoint::TumSequence sequence_;
  std::vector<stillpoint::FrameBoxes> boxes_;
};

/// A rendered frame, with the boxes of a perfect detector if wanted.
inline SourceFrame source_frame(const stillpoint::SyntheticFrame& rendered, bool wants_boxes) {
  SourceFrame frame;
  frame.timestamp_s = rendered.timestamp_s;
  frame.gray = stillpoint::as_mat(rendered.gray.view()).clone();
  frame.colour = stillpoint::as_mat(rendered.colour.view()).clone();
  frame.depth = stillpoint::as_mat(rendered.depth.view()).clone();
  frame.depth_factor = rendered.depth_factor;
  frame.labels = stillpoint::as_mat(rendered.labels.view()).clone();
  if (wants_boxes)
    for (const stillpoint::synthetic::TruthBox& box : rendered.boxes)
      frame.boxes.push_back({box.class_name, 1.0f,
                             stillpoint::Box{static_cast<float>(box.x), static_cast<float>(box.y),
                                             static_cast<float>(box.width), static_cast<float>(box.height)}});
  return frame;
}

/// The synthetic scene of the library, with its exact truth. The next frame is rendered beside the work on this one.
class DemoSource : public FrameSource {
 public:
  explicit DemoSource(const Options& options)
      : sequence_(stillpoint::synthetic::moving_day()),
        end_(frame_end(options, sequence_.size())),
        wants_boxes_(options.prior == "boxes"),
        ground_truth_(true_path()) {}

  std::string name() const override { return "demo"; }
  std::optional<std::size_t> size() const override { return static_cast<std::size_t>(sequence_.size()); }
  const stillpoint::Camera& camera() const override { return sequence_.camera(); }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return ground_truth_; }
  bool has_labels() const override { return true; }

  std::optional<SourceFrame> load(std::size_t index) override {
    if (index >= static_cast<std::size_t>(sequence_.size())) return std::nullopt;
    if (next_.valid() && next_index_ != index) next_.get();
    SourceFrame frame = next_.valid() ? next_.get() : rendered(index);
    next_index_ = index + 1;
    if (next_index_ < end_) next_ = std::async(std::launch::async, [this] { return rendered(next_index_); });
    return frame;
  }

 private:
  static std::size_t frame_end(const Options& options, int size) {
    const auto all = static_cast<std::size_t>(size);
    return std::min(all, static_cast<std::size_t>(options.start) + static_cast<std::size_t>(options.frames));
  }

  SourceFrame rendered(std::size_t index) {
    sequence_.render(static_cast<int>(index), buffer_);
    return source_frame(buffer_, wants_boxes_);
  }

  stillpoint::Trajectory true_path() const {
    const stillpoint::synthetic::Scene& scene = sequence_.scene();
    stillpoint::Trajectory path;
    for (int i = 0; i < sequence_.size(); ++i)
      path.push_back({scene.start_s + sequence_.time_of(i), scene.camera_path.world_from_camera(sequence_.time_of(i))});
    return path;
  }

  stillpoint::SyntheticSequence sequence_;
  std::size_t end_;                    ///< behind the last frame of the run
  stillpoint::SyntheticFrame buffer_;  ///< used by one rendering at a time
  bool wants_boxes_;
  std::optional<stillpoint::Trajectory> ground_truth_;
  std::size_t next_index_ = 0;
  std::future<SourceFrame> next_;  ///< last: its destructor waits for what uses the others
};

}  // namespace stillpoint_run
