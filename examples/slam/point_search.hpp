// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which feature of a frame shows a point of the map: the one most like it, near where the point is expected.

#include <vector>

#include "frame.hpp"
#include "map.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/span.hpp"

namespace examples::slam {

using stillpoint::Camera;
using stillpoint::span;

struct PointMatch {
  PointId point = kNone;
  int feature = kNone;
  int bits = 0;  ///< in which the descriptors differ
};

/// Finds points by their descriptors within a window.
struct PointSearch {
  double window_px = 15.0;      ///< around where a point is expected, in the octave in which it is expected
  int farthest_bits = 100;      ///< of 256 in which two descriptors of one point may differ; motion blur takes many
  double second_best = 0.85;    ///< the best differs by less than this share of the second best of its octave
  double oblique_cosine = 0.5;  ///< seen more aslant than this from how it was seen so far, it looks different

  /// @param matches   appended to: at most one for each point and for each feature
  /// @param expected  appended to where it is given: points that lie in the image, found or not
  void operator()(const Map& map, span<const PointId> points, const Camera& camera, const Pose& camera_from_world,
                  const Frame& frame, std::vector<PointMatch>& matches, std::vector<PointId>* expected = nullptr) const;
};

/// A point in the image of a camera.
struct Projection {
  bool is_visible = false;
  Vector2d pixel = Vector2d::Zero();  ///< undistorted
  int octave = 0;                     ///< of the pyramid, in which it should be found
};

Projection project(const MapPoint& point, const Camera& camera, const Pose& camera_from_world, double oblique_cosine);

}  // namespace examples::slam
