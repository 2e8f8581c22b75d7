// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The plots of the report: what is drawn in each of them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "svg_plot.hpp"
#include "words.hpp"

namespace stillpoint_run {

namespace detail {

using stillpoint::Pose;
using stillpoint::Trajectory;
using stillpoint::Vector2d;
using stillpoint::Vector3d;

inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// Looks down on a path: to the right and ahead of where the camera looked first.
class MapView {
 public:
  /// The way up is the axis of the world nearest to the cameras' own: handheld cameras look down a little.
  explicit MapView(const Trajectory& path) {
    if (path.empty()) return;
    Vector3d up = Vector3d::Zero();
    for (const auto& pose : path) up -= pose.world_from_camera.linear().col(1);
    Eigen::Index axis = 1;
    up.cwiseAbs().maxCoeff(&axis);
    const Vector3d vertical = Vector3d::Unit(axis) * (up[axis] < 0 ? -1.0 : 1.0);
    const Vector3d sight = path.front().world_from_camera.linear().col(2);
    ahead_ = sight - sight.dot(vertical) * vertical;
    // Looking straight up or down, the picture's up is ahead.
    if (!(ahead_.norm() > 0.1)) ahead_ = -path.front().world_from_camera.linear().col(1);
    ahead_.normalize();
    right_ = ahead_.cross(vertical);
    origin_ = path.front().world_from_camera.translation();
  }

  Vector2d operator()(const Vector3d& position) const {
    return {right_.dot(position - origin_), ahead_.dot(position - origin_)};
  }

 private:
  Vector3d right_ = Vector3d::UnitX(), ahead_ = Vector3d::UnitZ(), origin_ = Vector3d::Zero();
};

/// In the reference's world where the two could be aligned, else laid on its first pose.
inline Trajectory in_reference(const RunRecord& run, const Trajectory& estimate, const TrajectoryFigures& figures) {
  if (!run.ground_truth || run.ground_truth->empty()) return estimate;
  if (figures.ate_rmse_m) return stillpoint::transformed(figures.absolute.alignment.target_from_source, estimate);
  Trajectory moved = estimate;
  for (auto& pose : moved)
    pose.world_from_camera = run.ground_truth->front().world_from_camera * pose.world_from_camera;
  return moved;
}

inline double seconds_of(const RunRecord& run, double timestamp_s) {
  return timestamp_s - run.frames.front().timestamp_s;
}

/// The part of the reference that was run through.
inline Trajectory reference_path(const RunRecord& run) {
  Trajectory path;
  if (!run.ground_truth) return path;
  constexpr double kMargin_s = 0.01;  // what still counts as the same moment
  for (const auto& pose : *run.ground_truth)
    if (pose.timestamp_s >= run.frames.front().timestamp_s - kMargin_s &&
        pose.timestamp_s <= run.frames.back().timestamp_s + kMargin_s)
      path.push_back(pose);
  return path;
}

}  // namespace detail

inline Plot map_plot(const RunRecord& run, const Figures& figures) {
  Plot plot;
  plot.title = "Trajectories from above";
  plot.x_label = "to the right of the start, m";
  plot.y_label = "ahead of the start, m";
  plot.has_equal_scales = true;
  const detail::Trajectory truth = detail::reference_path(run);
  const detail::MapView from_above(truth.empty() ? run.filtered : truth);
  const auto add = [&](const char* name, const char* css_class, const detail::Trajectory& path) {
    Line line{name, css_class, {}};
    for (const auto& pose : path) line.points.push_back(from_above(pose.world_from_camera.translation()));
    if (!line.points.empty()) plot.lines.push_back(std::move(line));
  };
  add("without the filter", "unfiltered", detail::in_reference(run, run.unfiltered, figures.unfiltered));
  add("with the filter", "filtered", detail::in_reference(run, run.filtered, figures.filtered));
  add("reference", "truth", truth);
  plot.description = truth.empty() ? "The camera's path with and without the filter; nobody knows the true one."
                                   : "The camera's path with and without the filter, each laid on the reference.";
  return plot;
}

inline Plot error_plot(const RunRecord& run, const Figures& figures) {
  Plot plot;
  plot.title = "Position error over time";
  plot.x_label = "time, s";
  plot.y_label = "distance from the reference, cm";
  const auto add = [&](const char* name, const char* css_class, const TrajectoryFigures& trajectory) {
    const stillpoint::TrajectoryErrors& errors = trajectory.absolute.errors;
    Line line{name, css_class, {}};
    for (std::size_t i = 0; i < errors.timestamps_s.size(); ++i)
      line.points.emplace_back(detail::seconds_of(run, errors.timestamps_s[i]), 100 * errors.translation_m[i]);
    if (!line.points.empty()) plot.lines.push_back(std::move(line));
  };
  add("without the filter", "unfiltered", figures.unfiltered);
  add("with the filter", "filtered", figures.filtered);
  plot.description = "After alignment with the reference";
  const auto worst = [](const TrajectoryFigures& trajectory) {
    const auto& errors = trajectory.absolute.errors.translation_m;
    return length_words(*std::max_element(errors.begin(), errors.end()));
  };
  if (figures.filtered.ate_rmse_m) plot.description += "; at most " + worst(figures.filtered) + " with the filter";
  if (figures.unfiltered.ate_rmse_m) plot.description += "; at most " + worst(figures.unfiltered) + " without";
  plot.description += '.';
  return plot;
}

/// Share of the features kept, with a mark under each frame whose status is not ok.
inline Plot kept_plot(const RunRecord& run, const Figures& figures) {
  Plot plot;
  plot.title = "Features kept";
  plot.x_label = "time, s";
  plot.y_label = "share of the features, %";
  plot.y_at_least = 100;
  Line line{"kept", "filtered", {}};
  for (const FrameSummary& frame : run.frames)
    line.points.emplace_back(detail::seconds_of(run, frame.timestamp_s),
                             frame.features > 0
                                 ? 100.0 * static_cast<double>(frame.kept) / static_cast<double>(frame.features)
                                 : detail::kGap);
  plot.lines.push_back(std::move(line));
  plot.description = "Marks below the line: frames whose status is not ok, and frames with a warning.";

  std::size_t kinds = 0;
  const auto mark = [&](const std::string& name, std::size_t frames, const auto& has_it) {
    const std::string css_class = "mark" + std::to_string(std::min<std::size_t>(kinds++, 3));
    plot.mark_names.emplace_back(css_class, name + ": " + count_words(frames, "frame"));
    bool had_it = false;
    for (const FrameSummary& frame : run.frames) {
      const double time_s = detail::seconds_of(run, frame.timestamp_s);
      const bool has = has_it(frame);
      if (has && had_it)
        plot.marks.back().x_end = time_s;  // frames in a row are one mark
      else if (has)
        plot.marks.push_back({css_class, time_s, time_s});
      had_it = has;
    }
  };
  for (const auto& [status, frames] : figures.statuses)
    if (status != stillpoint::Status::ok)
      mark(to_string(status), frames, [found = status](const FrameSummary& frame) { return frame.status == found; });
  for (const auto& [warning, frames] : figures.warnings)
    mark(to_string(warning), frames,
         [found = warning](const FrameSummary& frame) { return frame.warnings.has(found); });
  return plot;
}

/// Time of each stage, one upon the other; the small ones together.
inline Plot time_plot(const RunRecord& run) {
  Plot plot;
  plot.title = "Time per frame";
  plot.x_label = "time, s";
  plot.y_label = "filter's own time, ms";
  plot.is_stacked = true;
  constexpr std::size_t kOwnAreas = 3;
  std::vector<std::pair<double, stillpoint::Stage>> sums;
  for (std::size_t s = 0; s < stillpoint::kStageCount; ++s) {
    const auto stage = static_cast<stillpoint::Stage>(s);
    double sum = 0;
    for (const FrameSummary& frame : run.frames) sum += frame.timings[stage];
    sums.emplace_back(sum, stage);
  }
  std::stable_sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  plot.lines.resize(kOwnAreas + 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::size_t area = std::min(i, kOwnAreas);
    Line& line = plot.lines[area];
    line.css_class = "area" + std::to_string(area);
    line.name += (line.name.empty() ? "" : ", ") + std::string(to_string(sums[i].second));
    line.points.resize(run.frames.size(), detail::Vector2d::Zero());
    for (std::size_t k = 0; k < run.frames.size(); ++k)
      line.points[k] = {detail::seconds_of(run, run.frames[k].timestamp_s),
                        line.points[k].y() + run.frames[k].timings[sums[i].second]};
  }
  plot.description = "By stage, the longest at the bottom; without the tracker's own work.";
  return plot;
}

inline Plot label_plot(const RunRecord& run) {
  Plot plot;
  plot.title = "Right and wrong";
  plot.x_label = "time, s";
  plot.y_label = "share of the features dropped, %";
  plot.y_at_least = 100;
  const auto add = [&](const char* name, const char* css_class, stillpoint::DropCount FrameSummary::*count) {
    Line line{name, css_class, {}};
    for (const FrameSummary& frame : run.frames)
      line.points.emplace_back(detail::seconds_of(run, frame.timestamp_s),
                               100 * (frame.*count).share().value_or(detail::kGap));
    plot.lines.push_back(std::move(line));
  };
  add("on what moves (100 % is right)", "filtered", &FrameSummary::moving);
  add("on the background (0 % is right)", "unfiltered", &FrameSummary::background);
  plot.description = "By the labels of each frame; a gap where a frame has no such feature.";
  return plot;
}

/// All plots that have something to show.
inline std::vector<Plot> report_plots(const RunRecord& run, const Figures& figures) {
  std::vector<Plot> plots;
  if (!run.filtered.empty() || !run.unfiltered.empty()) plots.push_back(map_plot(run, figures));
  if (figures.filtered.ate_rmse_m || figures.unfiltered.ate_rmse_m) plots.push_back(error_plot(run, figures));
  plots.push_back(kept_plot(run, figures));
  if (run.has_labels) plots.push_back(label_plot(run));
  if (run.has_stages) plots.push_back(time_plot(run));
  return plots;
}

}  // namespace stillpoint_run
