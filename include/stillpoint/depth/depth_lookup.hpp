// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The depth that belongs to a keypoint: a pixel of the depth image, or nothing.

#include <cstddef>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// No depth, whatever the frame has: for policies that need none.
struct NoDepth {
  using Provides = Capabilities<>;

  double at(const DepthView&, const Vector2f&) const noexcept { return 0.0; }
};

/// The paper's: depth at the rounded pixel, whatever its neighbours say.
struct RoundedDepth {
  /// @return metres, 0 where there is none or the pixel is outside.
  double at(const DepthView& depth, const Vector2f& pixel) const noexcept {
    // Also false for NaN, and for what is too far away for an int.
    if (!(depth.image.border_distance_px(pixel.x(), pixel.y()) >= -0.5f)) return 0.0;
    const int u = rounded(pixel.x()), v = rounded(pixel.y());
    return depth.image.contains(u, v) ? static_cast<double>(depth.metres(u, v)) : 0.0;
  }
};

namespace detail {

/// The depth at a pixel, by a look-up that knows the sensor's noise or one that does not.
template <class Lookup, class Noise>
auto depth_by(const Lookup& lookup, const DepthView& depth, const Vector2f& pixel, const Noise& noise, int)
    -> decltype(lookup.at(depth, pixel, noise)) {
  return lookup.at(depth, pixel, noise);
}
template <class Lookup, class Noise>
double depth_by(const Lookup& lookup, const DepthView& depth, const Vector2f& pixel, const Noise&, long) {
  return lookup.at(depth, pixel);
}

}  // namespace detail

/// Undistorts the pixels of one side of the matches and looks their depths up.
/// @param noise a depth noise model, `double sigma(double depth_m)`.
template <class Lookup, class Camera, class Noise>
void lift(const FrameView& frame, const Lookup& lookup, const Camera& camera, const Noise& noise,
          FrameFeatures& observations) {
  const DepthScale to_depth(frame.image(), frame.depth.image);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Vector2f pixel = observations.pixel[i];
    if (!is_finite(pixel)) continue;
    observations.undistorted[i] = camera.undistort(to_double(pixel));
    const double depth_m = frame.depth.empty() ? 0.0 : detail::depth_by(lookup, frame.depth, to_depth(pixel), noise, 0);
    observations.set_depth(i, depth_m, depth_m > 0.0 ? noise.sigma(depth_m) : 0.0, camera);
  }
}

/// The median depth of the features that have one, metres; 0 where none has. O(n).
inline double median_depth_m(const FrameFeatures& observations, Workspace& workspace) {
  const Workspace::Scope scope(workspace);
  const span<double> depths = workspace.take<double>(observations.size());
  std::size_t count = 0;
  for (const double depth_m : observations.depth_m)
    if (depth_m > 0.0) depths[count++] = depth_m;
  return count > 0 ? median_in_place(depths.first(count)) : 0.0;
}

}  // namespace stillpoint
