// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where the camera was in each frame, by the keyframe that it was seen from: when that is moved, so is the frame.

#include <vector>

#include "map.hpp"
#include "mapping.hpp"
#include "stillpoint/evaluation/trajectory.hpp"

namespace examples::slam {

class Path {
 public:
  void add(double timestamp_s, KeyframeId reference, const Pose& camera_from_reference) {
    steps_.push_back({timestamp_s, reference, camera_from_reference});
  }

  /// A keyframe is gone: its frames are seen from another.
  void replace(const CulledKeyframe& culled) {
    for (Step& step : steps_) {
      if (step.reference != culled.id) continue;
      step.reference = culled.kept;
      step.camera_from_reference = step.camera_from_reference * culled.culled_from_kept;
    }
  }

  /// Each frame with a pose, as its keyframe stands now.
  stillpoint::Trajectory trajectory(const Map& map) const {
    stillpoint::Trajectory result;
    for (const Step& step : steps_) {
      const Pose camera_from_world = step.camera_from_reference * map.keyframe(step.reference).camera_from_world;
      result.push_back({step.timestamp_s, stillpoint::orthonormalized(camera_from_world.inverse())});
    }
    return result;
  }

 private:
  struct Step {
    double timestamp_s;
    KeyframeId reference;
    Pose camera_from_reference;
  };
  std::vector<Step> steps_;
};

}  // namespace examples::slam
