// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How far an estimated trajectory is from its reference: as a whole (ATE, Eq. 15) and over short stretches (RPE,
// Eq. 16). The conventions are those of evo (github.com/MichaelGrupp/evo), so that figures can be compared with
// others'. Source: Sturm et al., "A Benchmark for the Evaluation of RGB-D SLAM Systems", IROS 2012.

#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/evaluation/alignment.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/trajectory.hpp"

namespace stillpoint {

/// Errors in the order of time; empty where there is nothing to compare. `error_statistics` sums them up.
struct TrajectoryErrors {
  std::vector<double> timestamps_s;  ///< of the estimate's pose, for the relative error of the later one
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;  ///< in [0, 180]
};

struct AbsoluteTrajectoryError {
  AlignmentResult alignment;  ///< reference_from_estimate; where its status is not ok there are no errors
  TrajectoryErrors errors;
};

/// How far apart the two poses of a relative error are.
enum class DeltaUnit {
  frames,  ///< associated poses
  metres,  ///< of the estimate's path
};

/// Which pairs of poses are compared.
enum class PairSelection {
  consecutive,  ///< each pair begins where the one before it ended
  all,          ///< a pair begins at every pose
};

struct RelativeErrorOptions {
  double delta = 1.0;  ///< in `unit`; a whole number of frames
  DeltaUnit unit = DeltaUnit::frames;
  PairSelection pairs = PairSelection::consecutive;
  double relative_tolerance =
      0.1;  ///< by how much of `delta` a pair may miss it (metres and all pairs only; evo's 0.1)
};

namespace detail {

inline void append_error(TrajectoryErrors& errors, double timestamp_s, const Pose& error) {
  errors.timestamps_s.push_back(timestamp_s);
  errors.translation_m.push_back(error.translation().norm());
  errors.rotation_deg.push_back(rotation_angle(error.linear()) * kDegreesPerRadian);
}

using PosePairs = std::vector<std::pair<std::size_t, std::size_t>>;

inline PosePairs pairs_by_frames(std::size_t pose_count, std::size_t delta, PairSelection selection) {
  PosePairs pairs;
  const std::size_t step = selection == PairSelection::all ? 1 : delta;
  for (std::size_t first = 0; first < pose_count && delta < pose_count - first; first += step)
    pairs.emplace_back(first, first + delta);
  return pairs;
}

/// Length of the step to each pose from the one before it, metres; 0 for the first.
inline std::vector<double> step_lengths(const Trajectory& trajectory) {
  std::vector<double> lengths(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Pose &before = trajectory[i - 1].world_from_camera, &pose = trajectory[i].world_from_camera;
    lengths[i] = (pose.translation() - before.translation()).norm();
  }
  return lengths;
}

/// Consecutive pairs end at the first pose that is at least `delta` further along the path. As in evo, the stretch
/// before the first such pose only finds the start and is no pair itself.
inline PosePairs consecutive_pairs_by_path(const std::vector<double>& steps, double delta) {
  PosePairs pairs;
  std::optional<std::size_t> start;
  double length = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    length += steps[i];
    if (!(length >= delta)) continue;
    if (start) pairs.emplace_back(*start, i);
    start = i;
    length = 0.0;
  }
  return pairs;
}

/// From every pose to the later one whose distance along the path is nearest to `delta`, if it is near enough.
inline PosePairs all_pairs_by_path(const std::vector<double>& steps, double delta, double tolerance) {
  std::vector<double> from_first(steps.size());
  std::partial_sum(steps.begin(), steps.end(), from_first.begin());
  PosePairs pairs;
  for (std::size_t start = 0; start + 1 < from_first.size(); ++start) {
    const std::size_t end = nearest_index(from_first, start + 1, from_first[start] + delta);
    if (std::abs(from_first[end] - from_first[start] - delta) <= tolerance) pairs.emplace_back(start, end);
  }
  return pairs;
}

inline PosePairs select_pairs(const Trajectory& estimate, const RelativeErrorOptions& options) {
  const double delta = options.delta;
  if (!std::isfinite(delta) || !(delta > 0))
    throw Error("relative trajectory error: delta is " + std::to_string(delta) + ", expected a positive number");
  if (options.unit == DeltaUnit::frames) {
    if (!(delta >= 1 && delta <= 1e9 && delta == std::floor(delta)))
      throw Error("relative trajectory error: delta is " + std::to_string(delta) +
                  ", expected a whole number of frames");
    return pairs_by_frames(estimate.size(), static_cast<std::size_t>(delta), options.pairs);
  }
  const std::vector<double> steps = step_lengths(estimate);
  if (options.pairs == PairSelection::consecutive) return consecutive_pairs_by_path(steps, delta);
  return all_pairs_by_path(steps, delta, options.relative_tolerance * delta);
}

}  // namespace detail

/// Measures each pose of the estimate, aligned, against the reference's (Eq. 15; evo's ape): with Q the reference and P
/// the estimate, the error is E = Q⁻¹ S P, its translation part and rotation angle.
/// @param max_time_difference_s  how far apart in time two poses may be that are compared.
/// @throws Error if a trajectory is not in the order of time.   Cost O(n log m).
inline AbsoluteTrajectoryError absolute_trajectory_error(const Trajectory& reference, const Trajectory& estimate,
                                                         Alignment alignment, double max_time_difference_s = 0.01) {
  AbsoluteTrajectoryError result;
  const AssociatedTrajectories pairs = associate(reference, estimate, max_time_difference_s);
  result.alignment = align(pairs, alignment);
  if (result.alignment.status != AlignmentStatus::ok) return result;
  const Trajectory aligned = transformed(result.alignment.target_from_source, pairs.estimate);
  for (std::size_t i = 0; i < aligned.size(); ++i)
    detail::append_error(result.errors, aligned[i].timestamp_s,
                         pairs.reference[i].world_from_camera.inverse() * aligned[i].world_from_camera);
  return result;
}

/// Measures how the motion over a stretch differs from the reference's (Eq. 16; evo's rpe, without alignment): for
/// poses i and j, the error is E = (Qᵢ⁻¹ Qⱼ)⁻¹ (Pᵢ⁻¹ Pⱼ).
/// @throws Error if a trajectory is not in the order of time or `options.delta` does not fit its unit.   Cost O(n log
/// m).
inline TrajectoryErrors relative_trajectory_error(const Trajectory& reference, const Trajectory& estimate,
                                                  const RelativeErrorOptions& options = {},
                                                  double max_time_difference_s = 0.01) {
  TrajectoryErrors errors;
  const AssociatedTrajectories pairs = associate(reference, estimate, max_time_difference_s);
  const auto motion = [](const Trajectory& trajectory, std::size_t i, std::size_t j) -> Pose {
    return trajectory[i].world_from_camera.inverse() * trajectory[j].world_from_camera;
  };
  for (const auto& [i, j] : detail::select_pairs(pairs.estimate, options))
    detail::append_error(errors, pairs.estimate[j].timestamp_s,
                         motion(pairs.reference, i, j).inverse() * motion(pairs.estimate, i, j));
  return errors;
}

}  // namespace stillpoint
