// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The features of a frame as objects see them: how fast each went, and which object it is of.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/rigid/rigid_estimator.hpp"

namespace stillpoint {

/// How fast a feature went.
struct FeatureVelocity {
  bool is_known = false;
  Vector3d value = Vector3d::Zero();  ///< relative to the world, in the current camera's axes, m/s
  double depth_sigma_m_s = 0;         ///< of it, along the ray; across it is much better known

  /// How far it is from another velocity, m/s; its noise along the ray is taken off.
  /// @param point  of the feature, in the current camera
  double difference(const Vector3d& other, const Vector3d& point) const {
    constexpr double kSigmas = 3.0;
    const Vector3d apart = value - other;
    const double x = apart.x() - point.x() / point.z() * apart.z(), y = apart.y() - point.y() / point.z() * apart.z();
    const double z = std::max(0.0, std::abs(apart.z()) - kSigmas * depth_sigma_m_s);
    return std::sqrt(x * x + y * y + z * z);
  }
};

/// What is known of the features of one frame. Owns nothing.
template <class Camera>
struct MovingFeatures {
  static constexpr std::int32_t kNone = -1;

  const FrameView& frame;
  const Matches& matches;
  span<const Label> labels;
  const Pose& current_from_reference;  ///< of the camera
  const Camera& camera;
  double pixel_sigma;            ///< of a match, pixels
  span<std::int32_t> object_of;  ///< of each feature, or `kNone`

  double elapsed_s() const noexcept { return matches.elapsed_s; }
  bool is_dynamic(std::size_t i) const noexcept { return labels[i].verdict == Verdict::dynamic; }

  /// Where a feature would be had it stood still, and where it is.
  WhitenedPair pair(std::size_t i) const {
    return {current_from_reference * matches.reference.point[i],
            matches.reference.depth_sigma_m[i],
            matches.current.point[i],
            matches.current.depth_sigma_m[i],
            pixel_sigma,
            camera};
  }

  /// By its own step, else by that of the nearest feature on its surface that has one.
  /// @param followed  the features with a step
  FeatureVelocity velocity(std::size_t i, const PixelGrid& followed) const {
    const std::size_t beside = with_step(i, followed);
    if (beside == PixelGrid::kNone) return {};
    FeatureVelocity velocity;
    velocity.is_known = true;
    velocity.value =
        (matches.current.point[beside] - current_from_reference * matches.reference.point[beside]) / elapsed_s();
    velocity.depth_sigma_m_s =
        std::hypot(matches.current.depth_sigma_m[beside], matches.reference.depth_sigma_m[beside]) / elapsed_s();
    return velocity;
  }

  /// The feature itself if it has a step, else the nearest on its surface that has one, else `PixelGrid::kNone`.
  std::size_t with_step(std::size_t i, const PixelGrid& followed) const {
    return matches.metric(i) ? i : followed_beside(i, followed);
  }

  /// How far a feature is from those whose steps it may borrow: a cell of support corners.
  float beside_px() const noexcept { return 24.0f * matches.pixel_scale; }

 private:
  std::size_t followed_beside(std::size_t i, const PixelGrid& followed) const {
    constexpr double kSameSurface_m = 0.05;
    return followed.nearest(matches.current.pixel[i], beside_px(), [&](std::size_t j, float) {
      return std::abs(matches.current.depth_m[j] - matches.current.depth_m[i]) < kSameSurface_m;
    });
  }
};

}  // namespace stillpoint
