// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host that keeps recordings: it writes two frames as files, and reads back what it wrote.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stillpoint/evaluation/trajectory_error.hpp>
#include <stillpoint/io/boxes_file.hpp>
#include <stillpoint/io/euroc_sequence.hpp>
#include <stillpoint/io/image_folder.hpp>
#include <stillpoint/io/trajectory_file.hpp>
#include <stillpoint/io/tum_sequence.hpp>
#include <stillpoint/io/video_source.hpp>
#include <string>

const std::filesystem::path kFolder = "recording";

void write(const char* name, const std::string& text) { std::ofstream(kFolder / name) << text; }

template <class Source>
bool refuses(const std::filesystem::path& path) {
  try {
    const Source source(path);
  } catch (const stillpoint::Error&) {
    return true;
  }
  return false;
}

int main() {
  std::filesystem::create_directories(kFolder);
  const cv::Mat colour(48, 64, CV_8UC3, cv::Scalar(10, 20, 30)), depth(48, 64, CV_16UC1, cv::Scalar(2000));
  cv::imwrite((kFolder / "colour.png").string(), colour);
  cv::imwrite((kFolder / "depth.png").string(), depth);
  write("rgb.txt", "1.0 colour.png\n1.1 colour.png\n");
  write("depth.txt", "1.0 depth.png\n1.1 depth.png\n");
  write("camera.yaml", "fx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\nwidth: 64\nheight: 48\ndepth_factor: 1000\n");
  write("boxes.txt", "1.1 traffic_light 0.5 8 4 16 12\n");
  stillpoint::Trajectory trajectory(2);
  trajectory[0].timestamp_s = 1.0;
  trajectory[1].timestamp_s = 1.1;
  trajectory[1].world_from_camera.translation().x() = 0.25;
  stillpoint::write_trajectory(kFolder / "groundtruth.txt", trajectory);

  int wrong = 0;
  const auto expect = [&wrong](bool holds, const char* what) {
    if (!holds) std::printf("%d: not %s\n", ++wrong, what);
  };
  const stillpoint::TumSequence sequence(kFolder);
  std::size_t same = 0;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const stillpoint::RgbdImages images = sequence.load(i);
    same += !(cv::norm(images.colour, colour) > 0) && !(cv::norm(images.depth, depth) > 0);
  }
  expect(same == 2, "the images of two frames");
  expect(sequence.camera().fx() > 59 && sequence.camera().width() == 64, "the camera");
  const auto errors = stillpoint::relative_trajectory_error(trajectory, sequence.ground_truth().value());
  expect(errors.translation_m.size() == 1 && errors.translation_m[0] < 1e-9, "the trajectory");
  const auto boxes = stillpoint::read_boxes(kFolder / "boxes.txt");
  const stillpoint::FrameBoxes* found = stillpoint::boxes_at(boxes, 1.1);
  expect(found != nullptr && found->boxes[0].class_name == "traffic light", "the box");
  expect(stillpoint::read_image_folder(kFolder, 30.0).images.size() == 2, "two images in the folder");
  expect(refuses<stillpoint::VideoSource>(kFolder / "none.avi"), "refused: a video that is not there");
  expect(refuses<stillpoint::EurocSequence>(kFolder), "refused: a folder of another layout");
  std::printf("kept %zu of 2\n", same);
  return wrong == 0 ? 0 : 1;
}
