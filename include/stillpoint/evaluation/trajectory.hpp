// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A camera's path over time, and which poses of two such paths belong together.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/options.hpp"

namespace stillpoint {

/// Where the camera was at one moment: metres, seconds.
struct StampedPose {
  double timestamp_s = 0.0;
  Pose world_from_camera = Pose::Identity();
};

/// Poses in the order of time; equal times may follow each other.
using Trajectory = std::vector<StampedPose>;

/// A pose as files write it. A quaternion of any length is taken, but for one of almost none, which has no direction.
inline std::optional<Pose> pose_from_quaternion(Eigen::Quaterniond rotation, const Vector3d& translation) {
  constexpr double kShortest = 1e-6;  // the last decimal of such files
  const double length = rotation.coeffs().stableNorm();
  if (!(length > kShortest)) return std::nullopt;
  rotation.coeffs() /= length;
  return make_pose(rotation.toRotationMatrix(), translation);
}

/// Poses of two trajectories that belong together: `reference[i]` was taken at the time of `estimate[i]`.
struct AssociatedTrajectories {
  Trajectory reference;
  Trajectory estimate;
};

namespace detail {

inline void require_ordered(const Trajectory& trajectory, const char* name) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double time_s = trajectory[i].timestamp_s;
    if (!std::isfinite(time_s) || (i > 0 && !(time_s >= trajectory[i - 1].timestamp_s)))
      throw Error(std::string(name) + ": timestamp of pose " + std::to_string(i) + " is " + std::to_string(time_s) +
                  ", expected a finite time not before the previous pose's");
  }
}

/// Index of the value nearest to `value` at or after `first`, the first of those equally near. `ordered` does not
/// descend and is longer than `first`.
inline std::size_t nearest_index(const std::vector<double>& ordered, std::size_t first, double value) {
  const auto begin = std::next(ordered.begin(), static_cast<std::ptrdiff_t>(first));
  auto nearest = std::lower_bound(begin, ordered.end(), value);
  if (nearest != begin) {
    const double before = *std::prev(nearest);
    const bool after_is_nearer = nearest != ordered.end() && *nearest - value < value - before;
    if (!after_is_nearer) nearest = std::lower_bound(begin, nearest, before);
  }
  return static_cast<std::size_t>(nearest - ordered.begin());
}

}  // namespace detail

/// Pairs up two trajectories as evo does: each pose of the shorter one (the estimate, if both are as long) takes the
/// pose of the longer one that is nearest in time, and a pair further apart than the limit is left out. A pose of the
/// longer trajectory may be taken twice.
/// @param max_time_difference_s  largest difference that still counts as the same moment, inclusive.
/// @return        pairs in the order of time; empty where nothing fits.
/// @throws Error if a timestamp is not finite or before its predecessor, or the limit is no time.   Cost O(n log m).
inline AssociatedTrajectories associate(const Trajectory& reference, const Trajectory& estimate,
                                        double max_time_difference_s = 0.01) {
  detail::require_ordered(reference, "reference trajectory");
  detail::require_ordered(estimate, "estimated trajectory");
  if (!(max_time_difference_s >= 0))
    throw Error("max_time_difference_s is " + option_text(max_time_difference_s) + ", expected 0 or more seconds");
  const bool reference_is_shorter = reference.size() < estimate.size();
  const Trajectory& shorter = reference_is_shorter ? reference : estimate;
  const Trajectory& longer = reference_is_shorter ? estimate : reference;

  AssociatedTrajectories pairs;
  if (shorter.empty()) return pairs;
  std::vector<double> longer_s;
  for (const StampedPose& pose : longer) longer_s.push_back(pose.timestamp_s);
  for (const StampedPose& pose : shorter) {
    const StampedPose& partner = longer[detail::nearest_index(longer_s, 0, pose.timestamp_s)];
    if (!(std::abs(partner.timestamp_s - pose.timestamp_s) <= max_time_difference_s)) continue;
    pairs.reference.push_back(reference_is_shorter ? pose : partner);
    pairs.estimate.push_back(reference_is_shorter ? partner : pose);
  }
  return pairs;
}

}  // namespace stillpoint
