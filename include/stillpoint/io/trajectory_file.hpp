// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Trajectories in the TUM benchmark's format: `timestamp tx ty tz qx qy qz qw`, camera to world.

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/table_reader.hpp"

namespace stillpoint {

/// The pose in the columns tx ty tz qx qy qz qw of a row, from `first` on.
/// @throws Error unless they are finite numbers and the quaternion has a direction.
inline Pose pose_in_row(const TableReader& rows, std::size_t first) {
  static constexpr const char* kNames[] = {"tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  double values[7];
  for (std::size_t i = 0; i < 7; ++i) values[i] = rows.number(first + i, kNames[i]);
  const std::optional<Pose> pose =
      pose_from_quaternion({values[6], values[3], values[4], values[5]}, {values[0], values[1], values[2]});
  if (!pose) rows.fail("a quaternion of length zero", "qx qy qz qw of length one");
  return *pose;
}

/// Reads a trajectory. Quaternions of any length but zero are taken and normalised; a file without a row is an empty
/// trajectory.
/// @throws Error with file and line for a row that is not eight finite numbers, a quaternion of length zero, or a time
///         before that of the row above.
inline Trajectory read_trajectory(const std::filesystem::path& file) {
  Trajectory trajectory;
  TableReader rows(file);
  for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
    rows.require_columns(8, "timestamp tx ty tz qx qy qz qw");
    StampedPose pose;
    pose.timestamp_s = rows.time(0, previous_s);
    pose.world_from_camera = pose_in_row(rows, 1);
    trajectory.push_back(pose);
  }
  return trajectory;
}

/// A row of the format, without the line's end: six decimals or more for the time, nine for the rest, qw not negative.
inline std::string format_pose(const StampedPose& pose) {
  Eigen::Quaterniond rotation(pose.world_from_camera.linear());
  if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
  const Vector3d translation = pose.world_from_camera.translation();
  std::string row = format_timestamp(pose.timestamp_s);
  for (const double value : {translation.x(), translation.y(), translation.z(),  //
                             rotation.x(), rotation.y(), rotation.z(), rotation.w()})
    row += ' ' + format_fixed(value, 9);
  return row;
}

/// A trajectory as it is written in files.
/// @param file  its name, for the message
/// @throws Error if a pose is not finite.
inline std::string format_trajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    if (!std::isfinite(pose.timestamp_s) || !pose.world_from_camera.matrix().allFinite())
      throw Error(file.string() + ": the pose at " + format_timestamp(pose.timestamp_s) +
                  " is not finite, expected finite poses to write");
    text += format_pose(pose) + '\n';
  }
  return text;
}

/// Writes a trajectory; the file appears when it is whole.
/// @throws Error if the file can't be written or a pose is not finite.
inline void write_trajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  AtomicFile output(file);
  output.write(format_trajectory(file, trajectory));
  output.commit();
}

}  // namespace stillpoint
