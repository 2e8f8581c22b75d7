// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Readers of lists: trajectories, boxes, images of a sequence, classes; and what is read of videos and networks by
// hand. The first byte says which reader.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "bytes.hpp"
#include "input_folder.hpp"
#include "stillpoint/detectors/class_list.hpp"
#include "stillpoint/detectors/model_input_size.hpp"
#include "stillpoint/io/boxes_file.hpp"
#include "stillpoint/io/euroc_sequence.hpp"
#include "stillpoint/io/image_folder.hpp"
#include "stillpoint/io/trajectory_file.hpp"
#include "stillpoint/io/tum_frames.hpp"
#include "stillpoint/io/whole_video.hpp"

namespace {

void expect_sound(const stillpoint::Trajectory& trajectory) {
  for (const stillpoint::StampedPose& pose : trajectory)
    fuzz::require(std::isfinite(pose.timestamp_s) && pose.world_from_camera.matrix().allFinite());
}

/// A folder in which the images 0 to 9 are there.
fuzz::InputFolder& sequence() {
  static fuzz::InputFolder folder;
  static const bool is_filled = [] {
    for (int i = 0; i < 10; ++i) {
      folder.write(std::to_string(i), "");
      folder.write("data/" + std::to_string(i), "");
    }
    return true;
  }();
  (void)is_filled;
  return folder;
}

void expect_rising(const std::vector<stillpoint::TumFrame>& frames) {
  fuzz::require(!frames.empty());
  for (std::size_t i = 1; i < frames.size(); ++i) fuzz::require(frames[i].timestamp_s > frames[i - 1].timestamp_s);
}

void read(int reader, const std::string& text) {
  fuzz::InputFolder& folder = sequence();
  switch (reader % 9) {
    case 0: return expect_sound(stillpoint::read_trajectory(folder.write("input", text)));
    case 1: return expect_sound(stillpoint::read_euroc_trajectory(folder.write("input", text)));
    case 2: stillpoint::boxes_at(stillpoint::read_boxes(folder.write("input", text)), 1.0); return;
    case 3: folder.write("associations.txt", text); return expect_rising(stillpoint::read_tum_frames(folder.path()));
    case 4: {
      const std::size_t cut = std::min(text.find('\0'), text.size());
      std::filesystem::remove(folder.path() / "associations.txt");
      folder.write("rgb.txt", text.substr(0, cut));
      folder.write("depth.txt", text.substr(std::min(cut + 1, text.size())));
      return expect_rising(stillpoint::read_tum_frames(folder.path()));
    }
    case 5: {
      std::size_t missing = 0;
      folder.write("data.csv", text);
      stillpoint::detail::read_euroc_images(folder.path(), missing);
      return;
    }
    case 6: fuzz::require(!stillpoint::ClassList::read(folder.write("input", text)).empty()); return;
    case 7: stillpoint::detail::missing_bytes(folder.write("input", text)); return;
    default:
      stillpoint::onnx_input_size(folder.write("input", text));
      stillpoint::darknet_input_size(folder.path() / "input");
      stillpoint::detail::naturally_less(text.substr(0, text.size() / 2), text.substr(text.size() / 2));
      return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_chosen(data, size, read);
  return 0;
}
