// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Whole sequences with everything that is known of them, in memory: keypoints, labels, boxes, true poses.

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clip.hpp"
#include "stillpoint/evaluation/trajectory.hpp"

namespace stillpoint::bench {

inline constexpr std::size_t kAllFrames = std::numeric_limits<std::size_t>::max();

/// A frame with its truth.
struct LabelledFrame : ClipFrame {
  cv::Mat labels;                         ///< CV_8UC1, values of `PixelLabel`
  std::optional<Pose> world_from_camera;  ///< empty where the reference has none within 10 ms
};

struct LabelledSequence {
  Camera camera;
  std::vector<LabelledFrame> frames;
};

/// The slow box, of which all pixels are labelled as moving: 2 cm/s in a second, not in five frames.
inline synthetic::Scene slow_mover() {
  synthetic::Scene scene = synthetic::slow_mover();
  scene.motion_rule.window_frames = 30;
  return scene;
}

/// A rendered frame with its features.
inline LabelledFrame labelled_frame(const SyntheticFrame& rendered, cv::Feature2D& detector) {
  LabelledFrame frame;
  static_cast<ClipFrame&>(frame) = clip_frame(rendered);
  frame.labels = as_mat(rendered.labels.view()).clone();
  frame.world_from_camera = rendered.world_from_camera;
  detector.detect(frame.gray, frame.keypoints);
  return frame;
}

inline LabelledSequence rendered_sequence(const synthetic::Scene& scene, std::size_t most_frames) {
  SyntheticSequence source(scene);
  LabelledSequence sequence{source.camera(), {}};
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  SyntheticFrame rendered;
  for (int i = 0; i < source.size() && static_cast<std::size_t>(i) < most_frames; ++i) {
    source.render(i, rendered);
    sequence.frames.push_back(labelled_frame(rendered, *orb));
  }
  return sequence;
}

/// The reference pose of a time; empty where there is none within 10 ms.
inline std::optional<Pose> reference_pose(const TumSequence& source, double timestamp_s) {
  if (!source.ground_truth()) return std::nullopt;
  const AssociatedTrajectories pair = associate(*source.ground_truth(), {{timestamp_s, Pose::Identity()}});
  return pair.reference.empty() ? std::nullopt : std::optional(pair.reference.front().world_from_camera);
}

/// @throws Error where a file can't be read
inline LabelledSequence recorded_sequence(const std::filesystem::path& folder, std::size_t most_frames) {
  const TumSequence source(folder);
  const std::vector<FrameBoxes> boxes = read_boxes(folder / "boxes.txt");
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  LabelledSequence sequence{source.camera(), {}};
  for (std::size_t i = 0; i < std::min(source.frames().size(), most_frames); ++i) {
    LabelledFrame frame;
    static_cast<ClipFrame&>(frame) = recorded_frame(source, i);
    if (source.has_labels()) frame.labels = source.load_labels(i);
    frame.world_from_camera = reference_pose(source, frame.timestamp_s);
    frame.detections = detections_at(boxes, frame.timestamp_s);
    orb->detect(frame.gray, frame.keypoints);
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

}  // namespace stillpoint::bench
