// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A rendered scene through filter and SLAM, and how far each pose is off.

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "slam/slam.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"

namespace slam_run {

using stillpoint::Pose;

constexpr double kSlamRate_hz = 10;

struct RenderedFrame {
  cv::Mat gray, depth;
  double depth_factor;
  Pose world_from_camera;
};

inline std::vector<RenderedFrame> rendered(const stillpoint::synthetic::Scene& scene) {
  stillpoint::SyntheticSequence sequence(scene);
  stillpoint::SyntheticFrame frame;
  std::vector<RenderedFrame> frames;
  for (int i = 0; i < sequence.size(); ++i) {
    sequence.render(i, frame);
    frames.push_back({stillpoint::as_mat(frame.gray.view()).clone(), stillpoint::as_mat(frame.depth.view()).clone(),
                      frame.depth_factor, frame.world_from_camera});
  }
  return frames;
}

inline examples::slam::SlamOptions in_step() {
  examples::slam::SlamOptions options;
  options.maps_in_step = true;
  options.noise.depth_sigma_factor = 1.0;  // the synthetic sensor has KinectNoise
  return options;
}

/// A SLAM behind a filter that is given frames ten times a second.
template <class Filter>
struct SlamRun {
  SlamRun(const stillpoint::Camera& camera, Filter filter, const examples::slam::SlamOptions& options = in_step())
      : tracker(std::move(filter), examples::slam::Slam(camera, options)) {}

  /// @return how far the pose is off, as it is known at the time, metres; NaN where there is none
  double track(const RenderedFrame& frame) {
    if (count == 0) first_from_world = frame.world_from_camera.inverse();
    const stillpoint::FrameView view(frame.gray, stillpoint::DepthView(frame.depth, frame.depth_factor),
                                     1.0 + count++ / kSlamRate_hz);
    const std::optional<Pose> found = tracker.track(view);
    if (!found) return std::nan("");
    return (found->translation() - (first_from_world * frame.world_from_camera).translation()).norm();
  }

  const std::vector<examples::slam::Loop>& loops() { return tracker.backend.keeper().loops; }
  const examples::slam::Map& map() { return tracker.backend.keeper().map; }

  stillpoint::FilteredTracker<Filter, examples::slam::Slam> tracker;
  Pose first_from_world = Pose::Identity();
  int count = 0;
};

}  // namespace slam_run
