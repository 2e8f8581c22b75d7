// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How precisely is it known where a point of uncertain depth appears in another frame?   Scoring and refinement ask it.

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// What one standard deviation of a point's inverse depth moves its pixel in another frame, along its epipolar line.
/// there = R p + t with p = ray / ρ, so that ∂there / ∂ρ = −R p / ρ = (t − there) / ρ; ∂pixel / ∂there has the rows
/// fx (1, 0, −x) / z and fy (0, 1, −y) / z.
/// @tparam Real  double, or a vector of doubles
template <class Real>
struct EpipolarShift {
  Real x_px, y_px;

  /// @param translation      t, metres
  /// @param there_x …        R p + t, metres, and …
  /// @param x, y             … where that is on the plane z = 1
  /// @param relative_spread  σ of ρ, over ρ and over there_z; per metre
  template <class Camera>
  EpipolarShift(const Camera& camera, const Vector3d& translation, const Real& there_x, const Real& there_y,
                const Real& there_z, const Real& x, const Real& y, const Real& relative_spread) {
    const Real back_z = translation.z() - there_z;
    x_px = camera.fx() * relative_spread * (translation.x() - there_x - x * back_z);
    y_px = camera.fy() * relative_spread * (translation.y() - there_y - y * back_z);
  }
};

/// The information matrix (σ² I + a aᵀ)⁻¹ of a reprojected pixel: noise σ all round, and a, the `EpipolarShift`.
/// Where the depth is nearly unknown, what is left of a residual is its distance from the epipolar line, as Sampson's.
/// @tparam Real  double, or a vector of doubles
template <class Real>
struct ReprojectionInformation {
  Real xx, xy, yy;  ///< per square pixel

  /// By the formula of Sherman and Morrison: (v I + a aᵀ)⁻¹ = (I − a aᵀ / (v + aᵀa)) / v.
  /// @param variance  σ², square pixels
  ReprojectionInformation(const Real& variance, const EpipolarShift<Real>& a) {
    const Real x_squared = a.x_px * a.x_px, y_squared = a.y_px * a.y_px;
    const Real scale = 1.0 / (variance * (variance + x_squared + y_squared));
    xx = scale * (variance + y_squared);
    xy = -scale * a.x_px * a.y_px;
    yy = scale * (variance + x_squared);
  }

  /// The squared Mahalanobis distance of a residual in pixels.
  Real squared_distance(const Real& off_x, const Real& off_y) const {
    return xx * off_x * off_x + 2.0 * xy * off_x * off_y + yy * off_y * off_y;
  }
};

}  // namespace stillpoint
