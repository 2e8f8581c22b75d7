// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The trajectories of a run as they are drawn: each laid on the reference, in axes to the right, ahead and up.

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "map_view.hpp"

namespace stillpoint_run {

/// One line of the maps.
struct DrawnPath {
  const char* name;                                           ///< as the legend has it
  const char* css_class;                                      ///< also its name in the page's data
  std::vector<stillpoint::Vector3d> points;                   ///< metres to the right, ahead, up; in the order of time
  std::vector<std::optional<stillpoint::Vector3d>> of_frame;  ///< where it was in each frame of the run
};

namespace detail {

/// In the reference's world where the two could be aligned, else laid on its first pose.
inline stillpoint::Trajectory in_reference(const RunRecord& run, const stillpoint::Trajectory& estimate,
                                           const TrajectoryFigures& figures) {
  if (!run.ground_truth || run.ground_truth->empty()) return estimate;
  if (figures.ate_rmse_m) return stillpoint::transformed(figures.reference_from_estimate, estimate);
  stillpoint::Trajectory moved = estimate;
  for (auto& pose : moved)
    pose.world_from_camera = run.ground_truth->front().world_from_camera * pose.world_from_camera;
  return moved;
}

/// The part of the reference that was run through.
inline stillpoint::Trajectory reference_path(const RunRecord& run) {
  stillpoint::Trajectory path;
  if (!run.ground_truth) return path;
  constexpr double kMargin_s = 0.01;  // what still counts as the same moment
  for (const auto& pose : *run.ground_truth)
    if (pose.timestamp_s >= run.frames.front().timestamp_s - kMargin_s &&
        pose.timestamp_s <= run.frames.back().timestamp_s + kMargin_s)
      path.push_back(pose);
  return path;
}

/// Index of the pose of each frame; empty where none is within 10 ms.
inline std::vector<std::optional<std::size_t>> pose_of_frame(const std::vector<FrameSummary>& frames,
                                                             const std::vector<double>& timestamps_s) {
  constexpr double kSameMoment_s = 0.01;
  std::vector<std::optional<std::size_t>> poses(frames.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < frames.size() && !timestamps_s.empty(); ++i) {
    const auto distance_s = [&](std::size_t pose) { return std::abs(timestamps_s[pose] - frames[i].timestamp_s); };
    while (k + 1 < timestamps_s.size() && distance_s(k + 1) <= distance_s(k)) ++k;
    if (distance_s(k) <= kSameMoment_s) poses[i] = k;
  }
  return poses;
}

inline std::vector<double> timestamps_of(const stillpoint::Trajectory& path) {
  std::vector<double> timestamps_s;
  for (const auto& pose : path) timestamps_s.push_back(pose.timestamp_s);
  return timestamps_s;
}

}  // namespace detail

/// Those that there are, the one that is drawn last behind.
inline std::vector<DrawnPath> drawn_paths(const RunRecord& run, const Figures& figures) {
  const stillpoint::Trajectory truth = detail::reference_path(run);
  const MapView axes(truth.empty() ? run.filtered : truth);
  std::vector<DrawnPath> paths;
  const auto add = [&](const char* name, const char* css_class, const stillpoint::Trajectory& path) {
    if (path.empty()) return;
    DrawnPath drawn{name, css_class, {}, {}};
    for (const auto& pose : path) drawn.points.push_back(axes(pose.world_from_camera.translation()));
    for (const auto& pose : detail::pose_of_frame(run.frames, detail::timestamps_of(path)))
      drawn.of_frame.push_back(pose ? std::optional(drawn.points[*pose]) : std::nullopt);
    paths.push_back(std::move(drawn));
  };
  add("without the filter", "unfiltered", detail::in_reference(run, run.unfiltered, figures.unfiltered));
  add("with the filter", "filtered", detail::in_reference(run, run.filtered, figures.filtered));
  add("reference", "truth", truth);
  return paths;
}

}  // namespace stillpoint_run
