// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The fundamental matrix as RANSAC sees it: Eq. 1 and 2 of the paper.

#include <array>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/epipolar/fundamental_eight_point.hpp"
#include "stillpoint/motion/epipolar/fundamental_refinement.hpp"

namespace stillpoint {

/// An estimator for `ransac`: p_currentᵀ F p_reference = 0 (Eq. 1). Its residual is the distance in pixels of a point
/// of the current image from its epipolar line (Eq. 2). Computes with normalised points throughout; `in_pixels` leads
/// back.
/// @tparam Solver `FundamentalSevenPoint` or `FundamentalEightPoint`
template <class Solver>
class FundamentalEstimator {
 public:
  using Model = Matrix3d;  ///< F of the normalised points
  static constexpr std::size_t kSampleSize = Solver::kSampleSize;
  static constexpr std::size_t kMaxModels = Solver::kMaxModels;

  /// @param reference, current  undistorted pixels, aligned, in random order
  /// @param workspace           holds copies: the estimator lives no longer than the scope it was made in
  FundamentalEstimator(span<const Vector2d> reference, span<const Vector2d> current, Workspace& workspace)
      : from_reference_(reference),
        from_current_(current),
        reference_(workspace.take<Vector2d>(reference.size(), Vector2d::Zero())),
        current_(workspace.take<Vector2d>(reference.size(), Vector2d::Zero())),
        x_(workspace.take<float>(reference.size())),
        y_(workspace.take<float>(reference.size())),
        u_(workspace.take<float>(reference.size())),
        v_(workspace.take<float>(reference.size())),
        px2_per_unit_(static_cast<float>(1.0 / (from_current_.scale * from_current_.scale))) {
    for (std::size_t i = 0; i < reference.size(); ++i) {
      reference_[i] = from_reference_(reference[i]);
      current_[i] = from_current_(current[i]);
      x_[i] = static_cast<float>(reference_[i].x());
      y_[i] = static_cast<float>(reference_[i].y());
      u_[i] = static_cast<float>(current_[i].x());
      v_[i] = static_cast<float>(current_[i].y());
    }
  }

  std::size_t size() const noexcept { return x_.size(); }

  std::size_t solve(span<const std::size_t> sample, span<Model> models) const {
    std::array<Vector2d, kSampleSize> reference, current;
    for (std::size_t i = 0; i < kSampleSize; ++i) {
      reference[i] = reference_[sample[i]];
      current[i] = current_[sample[i]];
    }
    return Solver::solve(reference, current, models);
  }

  /// D² of Eq. 2, px². In single precision: the error is 1e-4 px, a thousandth of the paper's threshold.
  float squared_residual(const Model& f, std::size_t i) const noexcept {
    const auto at = [&f](int row, int column) { return static_cast<float>(f(row, column)); };
    const float a = at(0, 0) * x_[i] + at(0, 1) * y_[i] + at(0, 2);
    const float b = at(1, 0) * x_[i] + at(1, 1) * y_[i] + at(1, 2);
    const float c = at(2, 0) * x_[i] + at(2, 1) * y_[i] + at(2, 2);
    const float algebraic = a * u_[i] + b * v_[i] + c;
    return algebraic * algebraic / (a * a + b * b) * px2_per_unit_;
  }

  /// Least geometric error over the inliers: Gauss-Newton on Sampson's error, of both images' noise.
  bool refine(span<const std::uint32_t> inliers, Model& f) const {
    if (inliers.size() < 8) return false;
    const double scale_ratio = from_reference_.scale / from_current_.scale;
    FundamentalRefinement refinement(f, scale_ratio * scale_ratio);
    for (int iteration = 0; iteration < kRefinementSteps; ++iteration) {
      for (const std::uint32_t i : inliers) refinement.add(reference_[i], current_[i]);
      if (!refinement.step()) return false;
    }
    f = refinement.fundamental();
    return true;
  }

  /// F of the pixels, norm 1.
  Matrix3d in_pixels(const Model& model) const {
    const Matrix3d f = from_current_.matrix().transpose() * model * from_reference_.matrix();
    return f / f.norm();
  }

 private:
  static constexpr int kRefinementSteps = 1;

  Normalization from_reference_, from_current_;
  span<Vector2d> reference_, current_;  // normalised, for solving
  span<float> x_, y_, u_, v_;           // the same, reference and current, for scoring
  float px2_per_unit_;
};

}  // namespace stillpoint
