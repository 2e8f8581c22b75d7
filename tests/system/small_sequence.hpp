// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small folder in the layout of the TUM benchmark, for tests that break it.

#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <string>

#include "run_program.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/trajectory_file.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace system_test {

/// Writes a synthetic scene with all that such a folder can hold.
inline void write_scene(const fs::path& folder, const stillpoint::synthetic::Scene& scene) {
  stillpoint::SyntheticSequence sequence(scene);
  for (const char* name : {"rgb", "depth", "labels"}) fs::create_directories(folder / name);
  std::string associations, boxes = "# timestamp class_name confidence x y w h\n";
  stillpoint::Trajectory truth;
  stillpoint::SyntheticFrame frame;
  for (int i = 0; i < sequence.size(); ++i) {
    sequence.render(i, frame);
    const std::string time = stillpoint::format_fixed(frame.timestamp_s, 6), png = time + ".png";
    cv::imwrite((folder / "rgb" / png).string(), stillpoint::as_mat(frame.colour.view()));
    cv::imwrite((folder / "depth" / png).string(), stillpoint::as_mat(frame.depth.view()));
    cv::imwrite((folder / "labels" / png).string(), stillpoint::as_mat(frame.labels.view()));
    associations += time + " rgb/" + png + ' ' + time + " depth/" + png + '\n';
    for (const auto& box : frame.boxes)
      boxes += time + ' ' + box.class_name + " 1.0 " + std::to_string(box.x) + ' ' + std::to_string(box.y) + ' ' +
               std::to_string(box.width) + ' ' + std::to_string(box.height) + '\n';
    truth.push_back({frame.timestamp_s, frame.world_from_camera});
  }
  write_text(folder / "associations.txt", associations);
  write_text(folder / "boxes.txt", boxes);
  stillpoint::write_trajectory(folder / "groundtruth.txt", truth);
  const stillpoint::Camera& camera = sequence.camera();
  const auto number = [](double value) { return stillpoint::format_fixed(value, 3); };
  write_text(folder / "camera.yaml", "%YAML:1.0\n---\nfx: " + number(camera.fx()) + "\nfy: " + number(camera.fy()) +
                                         "\ncx: " + number(camera.cx()) + "\ncy: " + number(camera.cy()) +
                                         "\nwidth: " + std::to_string(camera.width()) +
                                         "\nheight: " + std::to_string(camera.height()) + "\ndepth_factor: 5000.0\n");
}

/// The first frames of the demo, 160 × 120 pixels.
inline void write_small_sequence(const fs::path& folder, int frame_count = 4) {
  stillpoint::synthetic::SceneOptions options;
  options.frames = frame_count;
  options.width = 160;
  options.height = 120;
  write_scene(folder, stillpoint::synthetic::demo(options));
}

}  // namespace system_test
