// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One object as it is remembered from frame to frame, and when it counts as moving, parked or lost.

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/movers/constant_velocity.hpp"

namespace stillpoint {

/// What an object looks like: a histogram of its gray levels.
class Appearance {
 public:
  static constexpr std::size_t kBins = 16;

  void add(const ImageView& gray, const Vector2f& pixel) {
    constexpr int kStep_px = 3;
    const int u = rounded(pixel.x()), v = rounded(pixel.y());
    for (int dv = -kStep_px; dv <= kStep_px; dv += kStep_px)
      for (int du = -kStep_px; du <= kStep_px; du += kStep_px)
        if (gray.contains(u + du, v + dv))
          bins_[gray.row<std::uint8_t>(v + dv)[u + du] * kBins / 256] += 1.0f, sum_ += 1.0f;
  }

  /// Hellinger's distance, 0 (alike) to 1; ½ where nothing is known.
  float distance(const Appearance& other) const noexcept {
    if (!(sum_ > 0) || !(other.sum_ > 0)) return 0.5f;
    float overlap = 0;
    for (std::size_t b = 0; b < kBins; ++b) overlap += std::sqrt(bins_[b] / sum_ * (other.bins_[b] / other.sum_));
    return std::sqrt(std::max(0.0f, 1.0f - overlap));
  }

  /// Learns what it looks like now.
  void blend(const Appearance& now, float share) noexcept {
    if (!(now.sum_ > 0)) return;
    if (!(sum_ > 0)) share = 1.0f;
    for (std::size_t b = 0; b < kBins; ++b) {
      const float old = sum_ > 0 ? bins_[b] / sum_ : 0.0f;
      bins_[b] = old + share * (now.bins_[b] / now.sum_ - old);
    }
    sum_ = 1.0f;
  }

 private:
  std::array<float, kBins> bins_{};
  float sum_ = 0;
};

/// An object that is followed. Vectors are in the axes of the last frame's camera.
struct TrackedObject {
  static constexpr std::size_t kMostPoints = 320;

  Mover mover;
  std::vector<Vector3d> points;  ///< on its surface, at most `kMostPoints`
  ConstantVelocity linear{1.0}, angular{1.0};
  Appearance appearance;
  Vector3d mean_velocity = Vector3d::Zero();    ///< of the last half second: limbs swing about it, m/s
  Vector3d long_velocity = Vector3d::Zero();    ///< of the last second
  Vector3d mean_turn = Vector3d::Zero();        ///< of the last half second, rad/s
  Matrix3d mean_turn_covariance = Matrix3d::Identity();
  bool turns = false;  ///< that is more than noise
  Vector3d path = Vector3d::Zero();             ///< the way gone since it was seen first, metres
  Matrix3d path_covariance = Matrix3d::Zero();  ///< of it
  int seen_frames = 0;
  double slow_s = 0;         ///< for how long it has hardly moved
  double rigid_share = 0.5;  ///< mean over time of the share of its points that move as one rigid body
  bool is_confirmed = false;
  bool is_seen = true;  ///< in the last frame

  TrackedObject() { points.reserve(kMostPoints); }

  Vector3d centroid_of_points() const {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& point : points) sum += point;
    return points.empty() ? mover.centroid : Vector3d(sum / static_cast<double>(points.size()));
  }

  /// Of a point of the object, relative to the world: with its turn where that is known.
  Vector3d velocity_at(const Vector3d& point) const {
    Vector3d velocity = linear.velocity();
    if (turns) velocity += angular.velocity().cross(point - mover.centroid);
    return velocity;
  }

  /// How much faster or slower than the object a point of it may be: limbs of what does not move rigidly.
  double limbs_m_s() const {
    const double speed = linear.velocity().norm();
    return 0.15 + 0.2 * speed + (1.0 - rigid_share) * (0.3 + 0.6 * speed);
  }

  double mean_speed() const { return mean_velocity.norm(); }

  /// The two hang together: some points of the one are near points of the other. A sample of the points is compared.
  static bool touch(const TrackedObject& a, const TrackedObject& b, double reach_m) {
    constexpr std::size_t kSample = 64, kFewest = 3;
    constexpr double kShare = 0.1;
    const std::size_t every_a = a.points.size() / kSample + 1, every_b = b.points.size() / kSample + 1;
    std::size_t near = 0, compared = 0;
    for (std::size_t i = 0; i < b.points.size(); i += every_b, ++compared)
      for (std::size_t j = 0; j < a.points.size(); j += every_a)
        if ((a.points[j] - b.points[i]).squaredNorm() <= reach_m * reach_m) {
          ++near;
          break;
        }
    return near >= kFewest && static_cast<double>(near) >= kShare * static_cast<double>(compared);
  }
};

}  // namespace stillpoint
