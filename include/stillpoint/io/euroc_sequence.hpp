// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A stereo sequence in the layout of the EuRoC datasets: mav0/cam0, mav0/cam1, and where there is one the ground truth.
//
// Layout: Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016. Times are whole nanoseconds.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/io/euroc_sensor.hpp"
#include "stillpoint/io/listed_files.hpp"
#include "stillpoint/io/stereo_images.hpp"
#include "stillpoint/io/table_reader.hpp"

namespace stillpoint {

namespace detail {

/// A time that must rise from row to row.
inline std::int64_t nanoseconds(const TableReader& rows, std::int64_t& previous_ns) {
  const std::string_view text = rows[0];
  std::int64_t time_ns = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), time_ns);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    rows.fail_at(0, "timestamp", "a whole number of nanoseconds");
  if (!(time_ns > previous_ns))
    rows.fail_at(0, "timestamp", "later than " + std::to_string(previous_ns) + " ns, the time of the row before");
  return previous_ns = time_ns;
}
inline constexpr std::int64_t kBeforeAllTime_ns = std::numeric_limits<std::int64_t>::min();

inline double seconds(std::int64_t time_ns) { return static_cast<double>(time_ns) * 1e-9; }

struct EurocImage {
  std::int64_t time_ns;
  std::filesystem::path file;
};

/// Reads data.csv of a camera: `timestamp [ns],filename`, the images in data/ beside it.
/// @param missing_files  grows by those that are left out
inline std::vector<EurocImage> read_euroc_images(const std::filesystem::path& camera_folder,
                                                 std::size_t& missing_files) {
  std::vector<EurocImage> images;
  ListedFiles files;
  TableReader rows(camera_folder / "data.csv", TableReader::Columns::between_commas);
  for (std::int64_t previous_ns = kBeforeAllTime_ns; rows.next_row();) {
    rows.require_columns(2, "timestamp [ns],filename");
    const std::int64_t time_ns = nanoseconds(rows, previous_ns);
    const std::filesystem::path file = camera_folder / "data" / std::string(rows[1]);
    if (files.is_there(rows, 1, file)) images.push_back({time_ns, file});
  }
  missing_files += files.missing();
  return images;
}

}  // namespace detail

/// Reads data.csv of a ground truth: `timestamp [ns], p x y z, q w x y z`; what columns follow (speed, biases) is not
/// looked at.
/// @return        world_from_body.
/// @throws Error with file and line for a row of fewer columns, what is no number, a quaternion of length zero, or a
///         time that does not rise.
inline Trajectory read_euroc_trajectory(const std::filesystem::path& file) {
  static constexpr const char* kNames[] = {"timestamp", "p_x", "p_y", "p_z", "q_w", "q_x", "q_y", "q_z"};
  Trajectory trajectory;
  TableReader rows(file, TableReader::Columns::between_commas);
  for (std::int64_t previous_ns = detail::kBeforeAllTime_ns; rows.next_row();) {
    if (rows.column_count() < 8)
      rows.fail(std::to_string(rows.column_count()) + " columns", "at least 8: timestamp [ns], p x y z, q w x y z");
    double values[8];
    for (std::size_t i = 1; i < 8; ++i) values[i] = rows.number(i, kNames[i]);
    const std::optional<Pose> pose =
        pose_from_quaternion({values[4], values[5], values[6], values[7]}, {values[1], values[2], values[3]});
    if (!pose) rows.fail("a quaternion of length zero", "q w x y z of length one");
    trajectory.push_back({detail::seconds(detail::nanoseconds(rows, previous_ns)), *pose});
  }
  return trajectory;
}

/// Opens a folder of EuRoC's layout and hands out its stereo pairs. Copies share nothing; const calls are thread-safe.
class EurocSequence {
 public:
  /// Reads the lists, both cameras and, if it is there, state_groundtruth_estimate0; images are read by `load`. Pairs
  /// are images of equal time: one that the other camera missed is no frame.
  /// @param folder  the one that mav0 is in, or mav0 itself.
  /// @throws Error with file, and line or field, for what is missing or broken; if the lists have no time in common.
  explicit EurocSequence(std::filesystem::path folder)
      : folder_(std::move(folder)),
        sensors_(sensor_folder(folder_)),
        left_(read_euroc_camera(sensors_ / "cam0" / "sensor.yaml")),
        right_(read_euroc_camera(sensors_ / "cam1" / "sensor.yaml")) {
    const auto left = detail::read_euroc_images(sensors_ / "cam0", missing_files_),
               right = detail::read_euroc_images(sensors_ / "cam1", missing_files_);
    for (std::size_t i = 0, j = 0; i < left.size() && j < right.size();) {
      if (left[i].time_ns == right[j].time_ns)
        frames_.push_back({detail::seconds(left[i].time_ns), left[i].file, right[j].file});
      const bool left_is_next = left[i].time_ns <= right[j].time_ns,
                 right_is_next = right[j].time_ns <= left[i].time_ns;
      i += left_is_next ? 1 : 0;
      j += right_is_next ? 1 : 0;
    }
    if (frames_.empty())
      throw Error(sensors_.string() + ": found no pair among " + std::to_string(left.size()) + " images of cam0 and " +
                  std::to_string(right.size()) + " of cam1, expected equal times");
    images_without_partner_ = left.size() - frames_.size();
    const std::filesystem::path truth = sensors_ / "state_groundtruth_estimate0" / "data.csv";
    std::error_code ignored;
    if (!std::filesystem::exists(truth, ignored)) return;
    ground_truth_ = read_euroc_trajectory(truth);
    for (StampedPose& pose : *ground_truth_) pose.world_from_camera = pose.world_from_camera * left_.body_from_camera;
  }

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<StereoFrame>& frames() const { return frames_; }
  /// Images that the lists name and that are not there: a tenth at most, and their frames are left out.
  std::size_t missing_files() const { return missing_files_; }
  /// Images of the left camera that have no partner of their time: they are no frames.
  std::size_t images_without_partner() const { return images_without_partner_; }
  const Camera& left_camera() const { return left_.camera; }
  const Camera& right_camera() const { return right_.camera; }
  Pose right_from_left() const { return right_.body_from_camera.inverse() * left_.body_from_camera; }

  /// Reference poses of the left camera, world_from_camera; empty where the folder has none.
  const std::optional<Trajectory>& ground_truth() const { return ground_truth_; }

  /// Reads the images of a frame; they are not rectified.
  /// @param index  below `frames().size()`.
  /// @throws Error if an image cannot be read or is not of its camera's size.
  StereoImages load(std::size_t index) const {
    if (index >= frames_.size())
      throw Error(folder_.string() + ": frame " + std::to_string(index) + " is asked for, expected one below " +
                  std::to_string(frames_.size()));
    return load_stereo_images(frames_[index], left_.camera, right_.camera);
  }

 private:
  static std::filesystem::path sensor_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const std::filesystem::path& sensors : {folder / "mav0", folder})
      if (std::filesystem::is_directory(sensors / "cam0", ignored)) return sensors;
    throw Error(folder.string() + ": found " +
                (std::filesystem::exists(folder, ignored) ? "no mav0/cam0 in it" : "no such folder") +
                ", expected the folder of a EuRoC sequence");
  }

  std::filesystem::path folder_, sensors_;
  EurocCamera left_, right_;
  std::vector<StereoFrame> frames_;
  std::size_t missing_files_ = 0, images_without_partner_ = 0;
  std::optional<Trajectory> ground_truth_;
};

}  // namespace stillpoint
