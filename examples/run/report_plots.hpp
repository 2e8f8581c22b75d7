// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The plots of the report: what is drawn in each of them. Time is that since the first frame.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "explanations.hpp"
#include "figures.hpp"
#include "run_paths.hpp"
#include "svg_plot.hpp"
#include "words.hpp"

namespace stillpoint_run {

namespace detail {

using stillpoint::Vector2d;

inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

inline double seconds_of(const RunRecord& run, double timestamp_s) {
  return timestamp_s - run.frames.front().timestamp_s;
}

}  // namespace detail

namespace detail {

inline Line map_line(const DrawnPath& path, const std::array<int, 2>& axes) {
  Line line{path.name, path.css_class, {}, path.of_frame.empty() ? "" : path.key};
  for (const stillpoint::Vector3d& point : path.points) line.points.emplace_back(point[axes[0]], point[axes[1]]);
  return line;
}

}  // namespace detail

/// A map in two of the three axes: right (0), ahead (1), up (2).
inline Plot map_plot(const DrawnPaths& drawn, std::array<int, 2> axes) {
  const bool is_from_above = axes[0] == 0;
  Plot plot;
  plot.title = is_from_above ? "Trajectories from above" : "Trajectories from the side";
  plot.x_label = is_from_above ? "to the right of the start, m" : "ahead of the start, m";
  plot.y_label = is_from_above ? "ahead of the start, m" : "up from the start, m";
  plot.is_map = true;
  plot.map_axes = axes;
  bool has_reference = false;
  const auto add_map = [&](bool is_loops) {
    for (const DrawnPath& path : drawn.map)
      if (is_from_above && (path.css_class == "loops") == is_loops) plot.lines.push_back(detail::map_line(path, axes));
  };
  add_map(false);
  for (const DrawnPath& path : drawn.trajectories) {
    has_reference = has_reference || path.css_class == "truth";
    plot.lines.push_back(detail::map_line(path, axes));
  }
  add_map(true);  // short, and on the trajectories
  const bool has_estimate = plot.lines.size() > (has_reference ? 1u : 0u);
  plot.description = !has_estimate ? "The camera's path by the reference; there is none of a tracker."
                     : has_reference
                         ? "The camera's path with and without the filter from the same start, aligned to the "
                           "reference as the better one is."
                         : "The camera's path with and without the filter; no reference could be compared.";
  if (is_from_above && !drawn.map.empty())
    plot.description += " Keyframes are those that the map has in the end; a loop connects two of them.";
  return plot;
}

/// Where movers went, from above, with the camera's path.
inline Plot movers_map(const DrawnPaths& drawn) {
  constexpr std::array<int, 2> kFromAbove = {0, 1};
  Plot plot;
  plot.title = "Movers from above";
  plot.x_label = "to the right of the start, m";
  plot.y_label = "ahead of the start, m";
  plot.is_map = true;
  for (const DrawnPath& path : drawn.trajectories) {
    if (path.css_class != "filtered") continue;
    plot.lines.push_back(detail::map_line(path, kFromAbove));
    plot.lines.back().name = "camera, with the filter";
  }
  for (const DrawnPath& path : drawn.movers) {
    plot.lines.push_back(detail::map_line(path, kFromAbove));
    plot.lines.back().label = path.key.substr(path.key.find(' ') + 1);
  }
  plot.description =
      "The centroid of the points that are seen of each, placed by the camera's path: it shifts where an object is "
      "half "
      "covered. The number is the identifier, at the end. Nothing is drawn where a mover is lost.";
  return plot;
}

inline Plot speed_plot(const RunRecord& run, const std::vector<MoverHistory>& movers) {
  Plot plot;
  plot.title = "Speed of movers";
  plot.x_label = "time, s";
  plot.y_label = "relative to the world, m/s";
  for (std::size_t m = 0; m < movers.size(); ++m) {
    Line line{movers[m].name(), mover_class(m), {}};
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const MoverInFrame* const seen = movers[m].in(i);
      const bool is_seen = seen != nullptr && seen->state != stillpoint::MoverState::lost;
      line.points.emplace_back(detail::seconds_of(run, run.frames[i].timestamp_s),
                               is_seen ? seen->speed_m_s : detail::kGap);
    }
    plot.lines.push_back(std::move(line));
  }
  plot.description = "Of each object's centroid, by the filter's own motion; a gap where it is lost.";
  return plot;
}

namespace detail {

inline Line error_line(const RunRecord& run, const char* name, const char* css_class,
                       const stillpoint::TrajectoryErrors& errors, const std::vector<double>& values, double factor) {
  Line line{name, css_class, {}};
  for (std::size_t i = 0; i < errors.timestamps_s.size(); ++i)
    line.points.emplace_back(seconds_of(run, errors.timestamps_s[i]), factor * values[i]);
  return line;
}

/// The same plot of positions or of rotations.
struct ErrorKind {
  std::vector<double> stillpoint::TrajectoryErrors::*values;
  double factor;
  const char *noun, *y_label;
};
inline constexpr ErrorKind kPositions{&stillpoint::TrajectoryErrors::translation_m, 100.0, "position", "cm"};
inline constexpr ErrorKind kRotations{&stillpoint::TrajectoryErrors::rotation_deg, 1.0, "rotation", "degrees"};

}  // namespace detail

inline Plot error_plot(const RunRecord& run, const Figures& figures, const detail::ErrorKind& kind) {
  Plot plot;
  plot.title = std::string("Error of ") + kind.noun;
  plot.x_label = "time, s";
  plot.y_label = std::string("from the reference, ") + kind.y_label;
  plot.description = std::string("How far each pose's ") + kind.noun +
                     " is from the reference's. Both trajectories start at the same pose, and are aligned to the "
                     "reference by the alignment of the better one; the ATE aligns each by itself";
  const auto add = [&](const char* name, const char* css_class, const TrajectoryFigures& trajectory) {
    const stillpoint::TrajectoryErrors& errors = trajectory.drift;
    const std::vector<double>& values = errors.*kind.values;
    if (values.empty()) return;
    plot.lines.push_back(detail::error_line(run, name, css_class, errors, values, kind.factor));
    plot.description += std::string("; at most ") +
                        stillpoint::format_fixed(kind.factor * *std::max_element(values.begin(), values.end()), 1) +
                        ' ' + kind.y_label + ' ' + name;
  };
  add("without the filter", "unfiltered", figures.unfiltered);
  add("with the filter", "filtered", figures.filtered);
  plot.description += '.';
  return plot;
}

/// Where no reference can be compared: the difference of filtered and unfiltered trajectory.
inline Plot divergence_plot(const RunRecord& run, const Figures& figures, const detail::ErrorKind& kind) {
  Plot plot;
  plot.title = std::string("Difference of filtered and unfiltered: ") + kind.noun;
  plot.x_label = "time, s";
  plot.y_label = std::string("difference, ") + kind.y_label;
  plot.lines.push_back(detail::error_line(run, "difference", "filtered", figures.divergence,
                                          figures.divergence.*kind.values, kind.factor));
  plot.description =
      "Difference of the two trajectories, which start at the same pose. No reference could be compared, so this does "
      "not say which of them is right.";
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
  plot.description =
      "How many of the features the tracker gets. Marks below the line: frames whose status is not ok, and frames with "
      "a warning.";

  std::size_t kinds = 0;
  const auto mark = [&](const std::string& name, const char* meaning, std::size_t frames, const auto& has_it) {
    const std::string css_class = "mark" + std::to_string(std::min<std::size_t>(kinds++, 3));
    plot.mark_names.push_back({css_class, name + ": " + count_words(frames, "frame"), meaning});
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
      mark(to_string(status), explained(status), frames,
           [found = status](const FrameSummary& frame) { return frame.status == found; });
  for (const auto& [warning, frames] : figures.warnings)
    mark(to_string(warning), explained(warning), frames,
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
  add("on moving objects (100 % is right)", "filtered", &FrameSummary::moving);
  add("on the background (0 % is right)", "unfiltered", &FrameSummary::background);
  plot.description = "By the labels of each frame; a gap where a frame has no such feature.";
  return plot;
}

/// All plots over time that have something to show.
inline std::vector<Plot> report_plots(const RunRecord& run, const Figures& figures,
                                      const std::vector<MoverHistory>& movers) {
  std::vector<Plot> plots;
  for (const detail::ErrorKind& kind : {detail::kPositions, detail::kRotations}) {
    if (figures.has_errors())
      plots.push_back(error_plot(run, figures, kind));
    else if (!figures.divergence.timestamps_s.empty())
      plots.push_back(divergence_plot(run, figures, kind));
  }
  if (!movers.empty()) plots.push_back(speed_plot(run, movers));
  plots.push_back(kept_plot(run, figures));
  if (run.has_labels) plots.push_back(label_plot(run));
  if (run.has_stages) plots.push_back(time_plot(run));
  return plots;
}

}  // namespace stillpoint_run
