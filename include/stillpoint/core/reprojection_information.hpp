// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How precisely is it known where a point of uncertain depth appears in another frame?   Scoring and refinement ask it.

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// The information matrix (σ² I + a aᵀ)⁻¹ of a reprojected pixel: noise σ all round, and a, what one standard deviation
/// of the point's inverse depth moves it along its epipolar line. Where the depth is nearly unknown, what is left of a
/// residual is its distance from that line, as Sampson's.
/// @tparam Real  double, or a vector of doubles
template <class Real>
struct ReprojectionInformation {
  Real xx, xy, yy;  ///< per square pixel

  /// By the formula of Sherman and Morrison: (v I + a aᵀ)⁻¹ = (I − a aᵀ / (v + aᵀa)) / v.
  /// @param variance          σ², square pixels
  /// @param along_x, along_y  a, pixels
  ReprojectionInformation(const Real& variance, const Real& along_x, const Real& along_y) {
    const Real x_squared = along_x * along_x, y_squared = along_y * along_y;
    const Real scale = 1.0 / (variance * (variance + x_squared + y_squared));
    xx = scale * (variance + y_squared);
    xy = -scale * along_x * along_y;
    yy = scale * (variance + x_squared);
  }

  /// The squared Mahalanobis distance of a residual in pixels.
  Real squared_distance(const Real& off_x, const Real& off_y) const {
    return xx * off_x * off_x + 2.0 * xy * off_x * off_y + yy * off_y * off_y;
  }
};

}  // namespace stillpoint
