// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames to measure on: a camera in a hand, people who walk, and ORB's keypoints.

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/mobility_table.hpp"
#include "stillpoint/io/boxes_file.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::bench {

inline constexpr int kFeatures = 1000;  // of ORB in a frame, as in ORB-SLAM2

/// Owns its images.
struct ClipFrame {
  cv::Mat gray, depth;
  double depth_factor = 5000.0, timestamp_s = 0.0;
  std::vector<cv::KeyPoint> keypoints;
  std::vector<Vector2f> reference_pixels;  ///< where a host has seen them in the last frame; empty: it does not follow
  std::vector<Detection> detections;

  FrameView view() const { return FrameView(gray, DepthView(depth, depth_factor), timestamp_s); }
};

/// Some frames in a row of one camera, all in memory.
struct Clip {
  std::string name;
  Camera camera;
  std::vector<ClipFrame> frames;
};

namespace detail {

inline void detect_keypoints(Clip& clip) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  for (ClipFrame& frame : clip.frames) orb->detect(frame.gray, frame.keypoints);
}

}  // namespace detail

/// A rendered frame, without keypoints; its true boxes are what a detector would say.
inline ClipFrame clip_frame(const SyntheticFrame& rendered) {
  const MobilityTable mobility;
  ClipFrame frame;
  frame.gray = as_mat(rendered.gray.view()).clone();
  frame.depth = as_mat(rendered.depth.view()).clone();
  frame.depth_factor = rendered.depth_factor;
  frame.timestamp_s = rendered.timestamp_s;
  for (const synthetic::TruthBox& box : rendered.boxes)
    frame.detections.push_back({{static_cast<float>(box.x), static_cast<float>(box.y), static_cast<float>(box.width),
                                 static_cast<float>(box.height)},
                                mobility[box.class_name],
                                1.0f});
  return frame;
}

/// Two people walk through a room; their true boxes are what a detector would say.
inline Clip synthetic_clip(std::size_t frames) {
  SyntheticSequence sequence(synthetic::walking_people());
  Clip clip{"synthetic walking_people", sequence.camera(), {}};
  SyntheticFrame rendered;
  for (std::size_t i = 0; i < frames; ++i) {
    sequence.render(static_cast<int>(i), rendered);
    clip.frames.push_back(clip_frame(rendered));
  }
  detail::detect_keypoints(clip);
  return clip;
}

/// Whether there is a sequence in the layout of the TUM benchmark, with a camera and boxes.
inline bool is_recorded_clip(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / "camera.yaml", ignored) &&
         std::filesystem::exists(folder / "boxes.txt", ignored);
}

/// What a detector would say of the frame at that time, in images of the recording's size or `scale` times it.
inline std::vector<Detection> detections_at(const std::vector<FrameBoxes>& boxes, double timestamp_s,
                                            float scale = 1.0f) {
  const MobilityTable mobility;
  std::vector<Detection> detections;
  if (const FrameBoxes* const found = boxes_at(boxes, timestamp_s))
    for (const DetectedBox& seen : found->boxes) {
      const Box& box = seen.box;
      detections.push_back({{scale * box.x, scale * box.y, scale * box.width, scale * box.height},
                            mobility[seen.class_name],
                            seen.confidence});
    }
  return detections;
}

/// A recorded frame, without keypoints and detections.
/// @throws Error where a file can't be read
inline ClipFrame recorded_frame(const TumSequence& sequence, std::size_t index) {
  const RgbdImages images = sequence.load(index);
  ClipFrame frame;
  cv::cvtColor(images.colour, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth = images.depth;
  frame.depth_factor = sequence.depth_factor();
  frame.timestamp_s = sequence.frames()[index].timestamp_s;
  return frame;
}

/// The first frames of such a folder.
/// @throws Error where a file can't be read
inline Clip recorded_clip(const std::filesystem::path& folder, std::size_t frames) {
  const TumSequence sequence(folder);
  const std::vector<FrameBoxes> boxes = read_boxes(folder / "boxes.txt");
  Clip clip{folder.filename().string(), sequence.camera(), {}};
  for (std::size_t i = 0; i < std::min(frames, sequence.frames().size()); ++i) {
    clip.frames.push_back(recorded_frame(sequence, i));
    clip.frames.back().detections = detections_at(boxes, clip.frames.back().timestamp_s);
  }
  detail::detect_keypoints(clip);
  return clip;
}

}  // namespace stillpoint::bench
