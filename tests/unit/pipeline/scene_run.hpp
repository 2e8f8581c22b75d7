// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A filter over all frames of a synthetic scene.

#include <cstdint>
#include <opencv2/features2d.hpp>
#include <vector>

#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::scene_run {

/// Scenes of 320 × 240 pixels.
inline synthetic::SceneOptions small(int frames, std::uint64_t seed = 1) {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frames = frames;
  options.seed = seed;
  return options;
}

/// Where ORB finds corners in a frame.
inline std::vector<Vector2f> orb_corners(const SyntheticFrame& frame, int most) {
  std::vector<cv::KeyPoint> found;
  cv::ORB::create(most)->detect(as_mat(frame.gray.view()), found);
  std::vector<Vector2f> pixels;
  for (const cv::KeyPoint& keypoint : found) pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
  return pixels;
}

/// What a filter did to a scene; the first frame, which can't be judged, counts for the score alone.
struct Outcome {
  FilterScore score;
  int judged = 0, frames = 0;
};

/// @param filter_frame  `const FrameResult& (const SyntheticFrame&, std::vector<Vector2f>& pixels)`: fills in where its
///                      keypoints are
template <class FilterFrame>
Outcome run(const synthetic::Scene& scene, FilterFrame filter_frame) {
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  Outcome outcome;
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    std::vector<Vector2f> pixels;
    const FrameResult& result = filter_frame(frame, pixels);
    outcome.score.add_frame(frame.labels.view(), pixels, result.keep());
    if (f == 0) continue;
    ++outcome.frames;
    outcome.judged += judged(result.status());
  }
  return outcome;
}

}  // namespace stillpoint::scene_run
