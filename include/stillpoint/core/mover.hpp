// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Moving objects, where they are and how they move: one entry per object.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

enum class MoverState : std::uint8_t {
  moving,
  parked,  ///< moved, is seen, and stands now
  lost,    ///< is not seen in this frame: place, box and motion are predicted
};

constexpr const char* to_string(MoverState state) noexcept {
  switch (state) {
    case MoverState::moving: return "moving";
    case MoverState::parked: return "parked";
    default: return "lost";
  }
}

/// An object that moves, or moved and is parked. All vectors are in the axes of the current camera: x right, y down,
/// z forward.
struct Mover {
  std::uint32_t id = 0;  ///< from 1 on; kept while the object is seen and for two seconds after
  MoverState state = MoverState::moving;
  Box box;                               ///< around its features, pixels
  Vector3d centroid = Vector3d::Zero();  ///< of its points, in the current camera, metres
  Vector3d extent_m = Vector3d::Zero();  ///< of its points along the camera's axes
  Vector3d velocity = Vector3d::Zero();  ///< of the centroid relative to the world, m/s, by the filter's own motion
  Matrix3d velocity_covariance = Matrix3d::Zero();  ///< (m/s)²
  /// Where a point of the object in the reference camera is in the current one. Without `has_rotation` the object keeps
  /// its orientation in the world.
  Pose current_from_reference = Pose::Identity();
  /// Of a small rotation and translation after that pose, as `Motion::covariance`; without `has_rotation` the block of
  /// the translation alone.
  Matrix6d covariance = Matrix6d::Zero();
  bool has_rotation = false;      ///< its points move rigidly and determine a rotation
  std::int16_t class_index = -1;  ///< as `Detection::class_index`; -1: no detector named it
  float confidence = 0;           ///< of that detection, 0 to 1
  double first_seen_s = 0, last_seen_s = 0;
  std::size_t first_feature = 0, feature_count = 0;  ///< in `Movers::feature`
  std::size_t first_pixel = 0, pixel_count = 0;      ///< in `Movers::pixel`
};

/// The movers of one frame with their features.
struct Movers {
  static constexpr std::int32_t kNone = -1;

  std::vector<Mover> list;               ///< in the order of their identifiers
  std::vector<std::uint32_t> feature;    ///< indices of the host's keypoints, mover by mover
  std::vector<Vector2f> pixel;           ///< of the keypoints and of the filter's own corners, mover by mover
  std::vector<std::uint32_t> match;      ///< of each of these: the host's keypoints first, then the corners
  std::vector<std::int32_t> of_feature;  ///< index into `list` of each host's keypoint, or `kNone`

  /// Nothing is allocated later, as long as there are not more.
  void reserve(std::size_t features, std::size_t movers) {
    list.reserve(movers);
    feature.reserve(features);
    pixel.reserve(features);
    match.reserve(features);
  }

  void begin(std::size_t feature_count) {
    list.clear();
    feature.clear();
    pixel.clear();
    match.clear();
    refill(of_feature, feature_count, kNone);
  }
};

}  // namespace stillpoint
