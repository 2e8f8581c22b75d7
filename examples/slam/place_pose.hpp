// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where a camera stands that sees a known place: descriptors are matched, and the library's own rigid RANSAC finds the
// motion that most of the pairs agree on.

#include <cstddef>
#include <optional>
#include <vector>

#include "frame.hpp"
#include "map.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/workspace.hpp"

namespace examples::slam {

using stillpoint::Camera;

class PlacePose {
 public:
  struct Options {
    int farthest_bits = 50;      ///< of 256 in which two descriptors of one point may differ
    double second_best = 0.8;    ///< the best differs by less than this share of the second best
    std::size_t fewest = 20;     ///< pairs that agree: fewer are no pose
    double fewest_share = 0.25;  ///< of the pairs must agree
    std::size_t most_trials = 500;
  };
  Options options;

  PlacePose(Camera camera, const MeasurementNoise& noise) : camera_(std::move(camera)), noise_(noise) {}

  /// camera_from_world of a frame whose features have depth, by the points that a keyframe and its neighbours show.
  std::optional<Pose> operator()(const Frame& frame, KeyframeId place, const Map& map);

 private:
  Camera camera_;
  MeasurementNoise noise_;
  stillpoint::Workspace workspace_;
};

}  // namespace examples::slam
