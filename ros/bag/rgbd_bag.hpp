// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames with depth from a bag of ROS 1. Nothing of ROS is included here.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "stillpoint_ros/frame_pairing.hpp"

namespace stillpoint_ros {

/// Which topics of a bag are read. An empty name: the only one that fits; of camera_info the one beside the image.
struct BagTopics {
  std::string image, depth, camera_info;
};

/// Reads a bag from its beginning to its end, one frame after the other, whatever its size.
class RgbdBag {
 public:
  /// @param needs_camera_info  false: the camera is known otherwise, and the frames' `camera` has a size alone
  /// @throws stillpoint::Error where the file can't be read, or a topic is not there or can't be told from others
  RgbdBag(const std::filesystem::path& file, const BagTopics& wanted, bool needs_camera_info);
  ~RgbdBag();

  /// Nothing behind the last frame.
  /// @throws stillpoint::Error where the file is broken
  std::optional<PairedFrame> next();

  /// Those that are read.
  const BagTopics& topics() const noexcept;
  /// Images so far that had no depth of their time; behind the last frame, of the whole bag.
  std::size_t unpaired_images() const noexcept;
  /// Why no frame came, if none did.
  std::string why_nothing_pairs();

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace stillpoint_ros
