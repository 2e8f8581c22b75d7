// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A frame of the video: the image with the verdicts, and beside it the trajectories from above as far as they are
// known.

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "image_offsets.hpp"
#include "map_view.hpp"
#include "overlay.hpp"
#include "run_paths.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_run {

/// Call it for each frame, in their order. Unlike the report's, its trajectories are laid on the start alone: what
/// comes is not known yet, and drift shows as it grows.
class VideoFrame {
 public:
  explicit VideoFrame(const stillpoint::Camera& camera) : camera_(camera) {}

  /// @param run  as far as it has come: this frame's poses are in it
  cv::Mat draw(const SourceFrame& frame, const FrameRecord& record, const RunRecord& run) {
    const cv::Mat image = draw_overlay(frame, record, offsets_.of(frame, record, camera_));
    offsets_.remember(frame);
    cv::Mat panel(image.rows, image.rows, CV_8UC3, kPaper);
    draw_map(run, frame.timestamp_s, panel);
    cv::Mat both;
    cv::hconcat(image, panel, both);
    return both;
  }

 private:
  struct Path {
    const char* name;
    cv::Scalar colour;
    int width_px;
    std::vector<stillpoint::Vector2d> points;
  };

  static constexpr int kMargin_px = 48;
  static inline const cv::Scalar kPaper = cv::Scalar::all(252), kInk = cv::Scalar::all(40),
                                 kUnfiltered = cv::Scalar(0, 94, 213), kFiltered = cv::Scalar(178, 114, 0),
                                 kTruth = cv::Scalar::all(170);

  /// The start of the reference, where there is one: the trackers' world is their first camera.
  void begin(const RunRecord& run, double time_s) {
    stillpoint::Trajectory start = {{time_s, stillpoint::Pose::Identity()}};
    if (run.ground_truth && !run.ground_truth->empty())
      start.front().world_from_camera = pose_at(*run.ground_truth, time_s);
    world_from_start_ = start.front().world_from_camera;
    axes_ = MapView(start);
    start_s_ = time_s;
  }

  stillpoint::Vector2d on_map(const stillpoint::Pose& world_from_camera) {
    const stillpoint::Vector2d point = (*axes_)(world_from_camera.translation()).head<2>();
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
    return point;
  }

  std::vector<Path> paths(const RunRecord& run, double time_s) {
    std::vector<Path> result = {
        {"true", kTruth, 5, {}}, {"without filter", kUnfiltered, 2, {}}, {"with filter", kFiltered, 2, {}}};
    if (run.ground_truth)
      for (const auto& pose : *run.ground_truth)
        if (pose.timestamp_s >= start_s_ && pose.timestamp_s <= time_s)
          result[0].points.push_back(on_map(pose.world_from_camera));
    for (const auto& pose : run.unfiltered)
      result[1].points.push_back(on_map(world_from_start_ * pose.world_from_camera));
    for (const auto& pose : run.filtered)
      result[2].points.push_back(on_map(world_from_start_ * pose.world_from_camera));
    return result;
  }

  void draw_map(const RunRecord& run, double time_s, cv::Mat& panel) {
    if (!axes_) begin(run, time_s);
    const std::vector<Path> drawn = paths(run, time_s);
    const double side_px = panel.cols - 2 * kMargin_px, size_m = std::max((high_ - low_).maxCoeff(), kSmallest_m);
    const stillpoint::Vector2d centre = 0.5 * (low_ + high_);
    const auto at = [&](const stillpoint::Vector2d& point) {
      const stillpoint::Vector2d px = (point - centre) * side_px / size_m;
      return cv::Point(static_cast<int>(std::lround(0.5 * panel.cols + px.x())),
                       static_cast<int>(std::lround(0.5 * panel.rows - px.y())));
    };
    int line = 0;
    for (const Path& path : drawn) {
      if (path.points.empty()) continue;
      for (std::size_t i = 1; i < path.points.size(); ++i)
        cv::line(panel, at(path.points[i - 1]), at(path.points[i]), path.colour, path.width_px, cv::LINE_AA);
      cv::circle(panel, at(path.points.back()), 6, path.colour, cv::FILLED, cv::LINE_AA);
      const int y = 24 + 22 * line++;
      cv::line(panel, {14, y - 5}, {44, y - 5}, path.colour, path.width_px, cv::LINE_AA);
      cv::putText(panel, path.name, {52, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1, cv::LINE_AA);
    }
    draw_scale(side_px / size_m, size_m, panel);
  }

  /// A bar of a round length.
  static void draw_scale(double pixels_per_metre, double size_m, cv::Mat& panel) {
    double length_m = std::pow(10.0, std::floor(std::log10(size_m)));
    if (length_m > 0.6 * size_m) length_m /= 2;
    const int y = panel.rows - 16, length_px = static_cast<int>(std::lround(length_m * pixels_per_metre));
    cv::line(panel, {14, y}, {14 + length_px, y}, kInk, 2);
    cv::putText(panel, stillpoint::format_fixed(length_m, 1) + " m, from above", {14, y - 8}, cv::FONT_HERSHEY_SIMPLEX,
                0.5, kInk, 1, cv::LINE_AA);
  }

  static constexpr double kSmallest_m = 1.0;

  const stillpoint::Camera& camera_;
  ImageOffsets offsets_;
  stillpoint::Pose world_from_start_ = stillpoint::Pose::Identity();
  std::optional<MapView> axes_;
  stillpoint::Vector2d low_ = stillpoint::Vector2d::Zero(), high_ = stillpoint::Vector2d::Zero();
  double start_s_ = 0.0;
};

}  // namespace stillpoint_run
