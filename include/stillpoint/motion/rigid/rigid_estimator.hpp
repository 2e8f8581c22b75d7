// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The rigid motion between two sets of 3D points as RANSAC sees it, with the noise of a depth camera.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/kabsch.hpp"

namespace stillpoint {

/// One pair of points, and what makes their offset o = Q − (R P + t) white: (o_z / σ_z, (o_x − u o_z) f_x / (d σ_px),
/// (o_y − v o_z) f_y / (d σ_px)), for a point Q = d (u, v, 1).
///
/// That is the inverse of Σ = J diag(σ_z², σ_px², σ_px²) Jᵀ with J = ∂Q/∂(d, u, v): noise along the ray and across it.
/// P's noise is taken along Q's ray as well: for an inlier both rays lead to the same point, and they differ only by
/// the angle under which it sees the camera's motion.
struct WhitenedPair {
  Vector3d reference = Vector3d::Zero(), current = Vector3d::Zero();  ///< P, Q, metres
  double u = 0, v = 0;                                                ///< Q's ray is (u, v, 1)
  double per_z = 0, per_x = 0, per_y = 0;                             ///< 1/σ, 1/m

  WhitenedPair() = default;
  template <class Camera>
  WhitenedPair(const Vector3d& p, double p_sigma_m, const Vector3d& q, double q_sigma_m, double pixel_sigma_px,
               const Camera& camera)
      : reference(p), current(q), u(q.x() / q.z()), v(q.y() / q.z()) {
    constexpr double kLeastSigma = 1e-4;  // metres and pixels; no sensor is better
    per_z = 1.0 / std::max(std::hypot(p_sigma_m, q_sigma_m), kLeastSigma);
    const double sigma_px = std::max(pixel_sigma_px, kLeastSigma) * std::sqrt(2.0);  // of both ends
    per_x = camera.fx() / (q.z() * sigma_px);
    per_y = camera.fy() / (q.z() * sigma_px);
  }

  /// What an offset is across the ray, metres.
  Vector2d across_ray(const Vector3d& offset) const {
    return {offset.x() - u * offset.z(), offset.y() - v * offset.z()};
  }

  /// The matrix that makes an offset white: along the ray, then across it.
  Matrix3d whitening() const {
    Matrix3d rows;
    rows << 0, 0, per_z,       //
        per_x, 0, -per_x * u,  //
        0, per_y, -per_y * v;
    return rows;
  }
};

/// Gauss-Newton on whitened offsets, for a small rotation ω and translation v after the pose:
/// p_current = Exp(ω) (R p_reference + t) + v.
class RigidNormalEquations {
 public:
  explicit RigidNormalEquations(const Pose& current_from_reference) : pose_(current_from_reference) {}

  /// 95 % efficiency on normal noise. Source: Holland and Welsch, 1977.
  static constexpr double kCauchy = 2.385;

  /// Adds a pair with Cauchy's weight 1 / (1 + r² / c²); an infinite c weighs all alike.
  void add(const WhitenedPair& pair, double cauchy = kCauchy) {
    const Vector3d moved = pose_ * pair.reference, offset = pair.current - moved;
    const Matrix3d rows = pair.whitening();
    const Vector3d residual = rows * offset;
    const double weight = 1.0 / (1.0 + residual.squaredNorm() / (cauchy * cauchy));
    Eigen::Matrix<double, 3, 6> jacobian;  // of the moved point, whitened: ∂(ω × x + v)
    jacobian.leftCols<3>() = -rows * skew(moved);
    jacobian.rightCols<3>() = rows;
    information_.noalias() += weight * jacobian.transpose() * jacobian;
    right_.noalias() += weight * jacobian.transpose() * residual;
  }

  /// The pose one step nearer to the minimum; nothing when the pairs do not determine it.
  std::optional<Pose> step() const {
    const Vector6d update = Cholesky<6>(information_).solve(right_);
    if (!update.allFinite()) return std::nullopt;
    Pose pose = Pose::Identity();
    const Matrix3d turn = rotation_from_vector(update.head<3>());
    pose.linear() = turn * pose_.linear();
    pose.translation() = turn * pose_.translation() + update.tail<3>();
    return orthonormalized(pose);
  }

  /// Of (ω, v), rad and m; nothing when it is not positive definite.
  std::optional<Matrix6d> covariance() const {
    const Cholesky<6> factors(information_);
    if (!factors.positive_definite()) return std::nullopt;
    return factors.inverse();
  }

 private:
  Pose pose_;
  Matrix6d information_ = Matrix6d::Zero();
  Vector6d right_ = Vector6d::Zero();
};

/// An estimator for `ransac`: three pairs give a pose (Kabsch), the residual is the whitened distance (no unit).
class RigidEstimator {
 public:
  using Model = Pose;  ///< current_from_reference
  static constexpr std::size_t kSampleSize = 3;
  static constexpr std::size_t kMaxModels = 1;

  /// @param pairs in random order; a view that must outlive the estimator
  RigidEstimator(span<const WhitenedPair> pairs, Workspace& workspace)
      : pairs_(pairs), columns_(workspace.take<float>(kColumns * pairs.size())) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const WhitenedPair& p = pairs[i];
      const double values[kColumns] = {
          p.reference.x(), p.reference.y(), p.reference.z(), p.current.x(), p.current.y(), p.current.z(), p.u, p.v,
          p.per_z,         p.per_x,         p.per_y};
      for (std::size_t c = 0; c < kColumns; ++c) columns_[c * pairs.size() + i] = static_cast<float>(values[c]);
    }
  }

  std::size_t size() const noexcept { return pairs_.size(); }

  std::size_t solve(span<const std::size_t> sample, span<Model> models) const {
    std::array<Vector3d, kSampleSize> source, target;
    for (std::size_t i = 0; i < kSampleSize; ++i) {
      source[i] = pairs_[sample[i]].reference;
      target[i] = pairs_[sample[i]].current;
    }
    std::optional<Pose> pose = kabsch(source, target);
    // Kabsch takes depth for as good as the rest, so that its rotation is off by many pixels: weigh as the noise does.
    for (int iteration = 0; pose && iteration < kSampleSteps; ++iteration) {
      RigidNormalEquations equations(*pose);
      for (const std::size_t i : sample) equations.add(pairs_[i], std::numeric_limits<double>::infinity());
      pose = equations.step();
    }
    if (!pose) return 0;
    models[0] = *pose;
    return 1;
  }

  /// In single precision: a micrometre at 8 m.
  float squared_residual(const Model& pose, std::size_t i) const noexcept {
    const auto m = [&pose](int row, int column) { return static_cast<float>(pose.matrix()(row, column)); };
    const float px = at(0, i), py = at(1, i), pz = at(2, i);
    const float ox = at(3, i) - (m(0, 0) * px + m(0, 1) * py + m(0, 2) * pz + m(0, 3));
    const float oy = at(4, i) - (m(1, 0) * px + m(1, 1) * py + m(1, 2) * pz + m(1, 3));
    const float oz = at(5, i) - (m(2, 0) * px + m(2, 1) * py + m(2, 2) * pz + m(2, 3));
    const float z = oz * at(8, i), x = (ox - at(6, i) * oz) * at(9, i), y = (oy - at(7, i) * oz) * at(10, i);
    return z * z + x * x + y * y;
  }

  bool refine(span<const std::uint32_t> inliers, Model& pose) const {
    for (int iteration = 0; iteration < kRefinementSteps; ++iteration) {
      RigidNormalEquations equations(pose);
      for (const std::uint32_t i : inliers) equations.add(pairs_[i]);
      const std::optional<Pose> next = equations.step();
      if (!next) return false;
      pose = *next;
    }
    return true;
  }

  /// Of (ω, v) at a pose, from its inliers; nothing when they do not determine it.
  std::optional<Matrix6d> covariance(const Model& pose, span<const std::uint8_t> inlier) const {
    RigidNormalEquations equations(pose);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      if (inlier[i] != 0) equations.add(pairs_[i]);
    return equations.covariance();
  }

 private:
  static constexpr std::size_t kColumns = 11;
  static constexpr int kSampleSteps = 2, kRefinementSteps = 2;

  float at(std::size_t column, std::size_t i) const noexcept { return columns_[column * pairs_.size() + i]; }

  span<const WhitenedPair> pairs_;
  span<float> columns_;  ///< the same, one column a coordinate, for scoring
};

}  // namespace stillpoint
