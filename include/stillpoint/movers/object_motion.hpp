// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did one object move?   Its points in two frames → a rigid motion, or a translation where they do not determine a
// rotation.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/rigid/rigid_estimator.hpp"

namespace stillpoint {

/// An object's motion between two frames, the camera's own taken out: maps where its points would be had it stood still
/// to where they are. Metres, in the current camera.
struct ObjectMotion {
  Pose moved = Pose::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of a rotation and translation after `moved`
  bool has_rotation = false;
  double inlier_share = 0;  ///< of the pairs, those within three standard deviations
  std::size_t count = 0;    ///< of pairs
};

/// Squared whitened distance of a pair from a motion.
inline double squared_distance(const WhitenedPair& pair, const Pose& moved) {
  const Vector3d offset = pair.current - moved * pair.reference;
  const Vector2d across = pair.across_ray(offset);
  const double z = pair.per_z * offset.z(), x = pair.per_x * across.x(), y = pair.per_y * across.y();
  return x * x + y * y + z * z;
}

/// Gauss-Newton for a translation alone, with Cauchy's weights as `RigidNormalEquations`.
class TranslationNormalEquations {
 public:
  void add(const WhitenedPair& pair, const Pose& moved) {
    const Vector3d offset = pair.current - moved * pair.reference;
    const Matrix3d rows = pair.whitening();
    const Vector3d residual = rows * offset;
    constexpr double kCauchy = RigidNormalEquations::kCauchy;
    const double weight = 1.0 / (1.0 + residual.squaredNorm() / (kCauchy * kCauchy));
    information_.noalias() += weight * rows.transpose() * rows;
    right_.noalias() += weight * rows.transpose() * residual;
  }

  Cholesky<3> factors() const { return Cholesky<3>(information_); }
  Vector3d step() const { return factors().solve(right_); }

 private:
  Matrix3d information_ = Matrix3d::Zero();
  Vector3d right_ = Vector3d::Zero();
};

/// Estimates from the middle of the steps, so that half of the pairs may be of something else.
class ObjectMotionEstimator {
 public:
  static constexpr std::size_t kFewestPairs = 3, kFewestForRotation = 8;
  static constexpr double kInlier_sq = 9.0;
  static constexpr double kMostRotationSigma = 0.02;  // rad about the least certain axis between two frames

  /// The translation that most pairs agree with; nothing with fewer than three.
  static std::optional<ObjectMotion> translation(span<const WhitenedPair> pairs, Workspace& workspace) {
    if (pairs.size() < kFewestPairs) return std::nullopt;
    ObjectMotion motion;
    motion.count = pairs.size();
    motion.moved.translation() = median_step(pairs, workspace);
    TranslationNormalEquations last;
    for (int iteration = 0; iteration < kSteps; ++iteration) {
      last = TranslationNormalEquations();
      for (const WhitenedPair& pair : pairs) last.add(pair, motion.moved);
      const Vector3d step = last.step();
      if (!step.allFinite()) return std::nullopt;
      motion.moved.translation() += step;
    }
    motion.covariance.bottomRightCorner<3, 3>() = last.factors().inverse();
    motion.inlier_share = inlier_share(pairs, motion.moved);
    return motion;
  }

  /// The rigid motion near `start`; nothing where the pairs do not determine one.
  /// @param pixel_noise  standard deviation of the pixels over what the pairs say
  static std::optional<ObjectMotion> rigid(span<const WhitenedPair> pairs, const Pose& start,
                                           double pixel_noise = 1.0) {
    if (pairs.size() < kFewestForRotation) return std::nullopt;
    ObjectMotion motion;
    motion.count = pairs.size();
    motion.moved = start;
    for (int iteration = 0; iteration < kSteps; ++iteration) {
      const std::optional<Pose> next = equations_at(pairs, motion.moved, pixel_noise).step();
      if (!next) return std::nullopt;
      motion.moved = *next;
    }
    const std::optional<Matrix6d> covariance = equations_at(pairs, motion.moved, pixel_noise).covariance();
    if (!covariance || !(covariance->topLeftCorner<3, 3>().trace() <= kMostRotationSigma * kMostRotationSigma))
      return std::nullopt;
    motion.covariance = *covariance;
    motion.has_rotation = true;
    motion.inlier_share = inlier_share(pairs, motion.moved);
    return motion;
  }

  /// Standard deviation of the pixels over what the pairs say, from the offsets that a motion leaves: at least 0.5, at
  /// most 1. Limbs that swing leave more than the noise. So the median counts three times.
  static double pixel_noise(span<const WhitenedPair> pairs, const Pose& moved, Workspace& workspace) {
    constexpr double kLeast = 0.5, kPerMedian = 3.0 * kMadToSigma;
    if (pairs.empty()) return 1.0;
    const Workspace::Scope scope(workspace);
    const span<double> offsets = workspace.take<double>(2 * pairs.size());
    std::size_t count = 0;
    for (const WhitenedPair& pair : pairs) {
      const Vector2d across = pair.across_ray(pair.current - moved * pair.reference);
      offsets[count++] = std::abs(pair.per_x * across.x());
      offsets[count++] = std::abs(pair.per_y * across.y());
    }
    return std::clamp(kPerMedian * median_in_place(offsets), kLeast, 1.0);
  }

  /// How fast the parts of an object move against each other: mean square of what is left of their velocity across the
  /// ray after `moved`, less what noise leaves, (m/s)². The parts are cells of the box around it: limbs swing together,
  /// so that the mean of a part shows what no single pair does. Nothing where no part has enough pairs.
  static std::optional<double> bending_sq(span<const WhitenedPair> pairs, const Pose& moved, double elapsed_s) {
    constexpr std::size_t kColumns = 2, kRows = 4;
    constexpr double kFewest = 5, kCorrelation = 1.5, kOutlier_sq = 25.0;
    struct Part {
      double count = 0, noise = 0, x = 0, y = 0;  ///< sums of variances and of offsets across the ray
    };
    std::array<Part, kColumns * kRows> parts;
    if (pairs.empty()) return std::nullopt;
    Vector3d low = pairs[0].current, high = low;
    for (const WhitenedPair& pair : pairs) {
      low = low.cwiseMin(pair.current);
      high = high.cwiseMax(pair.current);
    }
    for (const WhitenedPair& pair : pairs) {
      if (!(squared_distance(pair, moved) <= kOutlier_sq)) continue;
      Part& part = parts[cell(pair.current.x(), low.x(), high.x(), kColumns) +
                         kColumns * cell(pair.current.y(), low.y(), high.y(), kRows)];
      const Vector2d across = pair.across_ray(pair.current - moved * pair.reference);
      part.x += across.x();
      part.y += across.y();
      part.noise += 1.0 / (pair.per_x * pair.per_x) + 1.0 / (pair.per_y * pair.per_y);
      part.count += 1.0;
    }
    double sum = 0, count = 0;
    for (const Part& part : parts) {
      if (!(part.count >= kFewest)) continue;
      // count · (squared mean - its variance)
      sum += (part.x * part.x + part.y * part.y - kCorrelation * part.noise) / part.count;
      count += part.count;
    }
    if (!(count > 0)) return std::nullopt;
    return sum / (count * elapsed_s * elapsed_s);
  }

 private:
  static constexpr int kSteps = 4;

  static RigidNormalEquations equations_at(span<const WhitenedPair> pairs, const Pose& moved, double pixel_noise) {
    RigidNormalEquations equations(moved);
    for (WhitenedPair pair : pairs) {
      pair.per_x /= pixel_noise;
      pair.per_y /= pixel_noise;
      equations.add(pair);
    }
    return equations;
  }

  /// Which of `cells` equal parts of the range from `low` to `high` a value is in.
  static std::size_t cell(double value, double low, double high, std::size_t cells) {
    const double share = high > low ? (value - low) / (high - low) : 0.0;
    return std::min(cells - 1, static_cast<std::size_t>(share * static_cast<double>(cells)));
  }

  static double inlier_share(span<const WhitenedPair> pairs, const Pose& moved) {
    std::size_t inliers = 0;
    for (const WhitenedPair& pair : pairs) inliers += squared_distance(pair, moved) <= kInlier_sq;
    return static_cast<double>(inliers) / static_cast<double>(pairs.size());
  }

  static Vector3d median_step(span<const WhitenedPair> pairs, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const span<double> values = workspace.take<double>(pairs.size());
    Vector3d median;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < pairs.size(); ++k) values[k] = pairs[k].current(axis) - pairs[k].reference(axis);
      median(axis) = median_in_place(values);
    }
    return median;
  }
};

}  // namespace stillpoint
