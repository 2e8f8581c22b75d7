// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a run has to draw in its maps: trajectories, each laid on the reference, and the paths of movers, in axes to the
// right, ahead and up.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "map_view.hpp"
#include "mover_history.hpp"

namespace stillpoint_run {

/// One line of the maps.
struct DrawnPath {
  std::string name;                          ///< as the legend has it
  std::string css_class;                     ///< colour and dash
  std::string key;                           ///< its name in the page's data
  std::vector<stillpoint::Vector3d> points;  ///< metres to the right, ahead, up; in the order of time; NaN is a gap
  std::vector<std::optional<stillpoint::Vector3d>> of_frame = {};  ///< where it was in each frame; empty: not followed
};

/// All that the maps show.
struct DrawnPaths {
  std::vector<DrawnPath> trajectories;  ///< those that there are, the one that is drawn last behind
  std::vector<DrawnPath> map;           ///< of a tracker with a map: keyframes, loops, the path before them
  std::vector<DrawnPath> movers;        ///< one for each of `MoverHistory`, in their order
};

/// The reference's pose nearest in time. @param reference  not empty
inline stillpoint::Pose pose_at(const stillpoint::Trajectory& reference, double timestamp_s) {
  const auto nearer = [timestamp_s](const auto& a, const auto& b) {
    return std::abs(a.timestamp_s - timestamp_s) < std::abs(b.timestamp_s - timestamp_s);
  };
  return std::min_element(reference.begin(), reference.end(), nearer)->world_from_camera;
}

namespace detail {

/// In the reference's world where the two could be aligned, else laid on its pose at the run's beginning.
inline stillpoint::Trajectory in_reference(const RunRecord& run, const stillpoint::Trajectory& estimate,
                                           const TrajectoryFigures& figures) {
  if (!run.ground_truth || run.ground_truth->empty()) return estimate;
  if (figures.ate_rmse_m) return stillpoint::transformed(figures.reference_from_estimate, estimate);
  stillpoint::Trajectory moved = estimate;
  const stillpoint::Pose start = pose_at(*run.ground_truth, run.frames.front().timestamp_s);
  for (auto& pose : moved) pose.world_from_camera = start * pose.world_from_camera;
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

namespace detail {

/// Between two pieces of a path; a lone point is a dot.
inline stillpoint::Vector3d gap_in_path() {
  return stillpoint::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Keyframes and loops lie on the trajectory; what was known at the time shows what the loops have moved.
inline std::vector<DrawnPath> drawn_map(const MapFiles& map, const MapView& axes, const stillpoint::Trajectory& path,
                                        const stillpoint::Trajectory& live) {
  const auto position = [&](double timestamp_s) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < path.size(); ++i)
      if (std::abs(path[i].timestamp_s - timestamp_s) < std::abs(path[nearest].timestamp_s - timestamp_s)) nearest = i;
    return axes(path[nearest].world_from_camera.translation());
  };
  if (path.empty()) return {};
  std::vector<DrawnPath> paths;
  DrawnPath keyframes{"keyframes: " + std::to_string(map.keyframes.size()), "keyframes", "", {}};
  for (const double timestamp_s : map.keyframes)
    keyframes.points.insert(keyframes.points.end(), {position(timestamp_s), gap_in_path()});
  paths.push_back(std::move(keyframes));
  if (map.loops.empty()) return paths;
  DrawnPath loops{"loops closed: " + std::to_string(map.loops.size()), "loops", "", {}};
  for (const auto& [place, keyframe] : map.loops)
    loops.points.insert(loops.points.end(), {position(place), position(keyframe), gap_in_path()});
  DrawnPath before{"as it was known at the time, before loops", "before_loops", "", {}};
  for (const auto& pose : live) before.points.push_back(axes(pose.world_from_camera.translation()));
  paths.push_back(std::move(loops));
  paths.push_back(std::move(before));
  return paths;
}

/// Of frames in which the mover is seen and the camera has a pose.
inline DrawnPath drawn_mover(const MoverHistory& mover, const std::string& css_class, const MapView& axes,
                             const stillpoint::Trajectory& path,
                             const std::vector<std::optional<std::size_t>>& pose_of_frame) {
  DrawnPath drawn{mover.name(), css_class, mover.key(), {}};
  drawn.of_frame.resize(pose_of_frame.size());
  for (std::size_t i = mover.first_frame; i <= mover.last_frame; ++i) {
    const MoverInFrame* const seen = mover.in(i);
    const bool is_seen = seen != nullptr && seen->state != stillpoint::MoverState::lost && pose_of_frame[i];
    if (is_seen) drawn.of_frame[i] = axes(path[*pose_of_frame[i]].world_from_camera * seen->centroid);
    drawn.points.push_back(is_seen ? *drawn.of_frame[i] : gap_in_path());
  }
  return drawn;
}

}  // namespace detail

inline DrawnPaths drawn_paths(const RunRecord& run, const Figures& figures, const std::vector<MoverHistory>& movers) {
  const stillpoint::Trajectory truth = detail::reference_path(run);
  const stillpoint::Trajectory filtered = detail::in_reference(run, run.filtered, figures.filtered);
  const MapView axes(truth.empty() ? run.filtered : truth);
  DrawnPaths paths;
  const auto add = [&](const char* name, const char* css_class, const stillpoint::Trajectory& path) {
    if (path.empty()) return;
    DrawnPath drawn{name, css_class, css_class, {}};
    for (const auto& pose : path) drawn.points.push_back(axes(pose.world_from_camera.translation()));
    for (const auto& pose : detail::pose_of_frame(run.frames, detail::timestamps_of(path)))
      drawn.of_frame.push_back(pose ? std::optional(drawn.points[*pose]) : std::nullopt);
    paths.trajectories.push_back(std::move(drawn));
  };
  add("without the filter", "unfiltered", detail::in_reference(run, run.unfiltered, figures.unfiltered));
  add("with the filter", "filtered", filtered);
  add("reference", "truth", truth);
  if (run.map)
    paths.map = detail::drawn_map(*run.map, axes, filtered, detail::in_reference(run, run.live, figures.filtered));
  if (filtered.empty()) return paths;
  const auto pose_of_frame = detail::pose_of_frame(run.frames, detail::timestamps_of(filtered));
  for (std::size_t m = 0; m < movers.size(); ++m)
    paths.movers.push_back(detail::drawn_mover(movers[m], mover_class(m), axes, filtered, pose_of_frame));
  return paths;
}

}  // namespace stillpoint_run
