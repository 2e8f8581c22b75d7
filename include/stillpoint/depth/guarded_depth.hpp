// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Depth that is used only where its neighbours agree.

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// Depth at the rounded pixel, if its 3 × 3 neighbourhood is one surface: at a hole or a jump there is none, and
/// nothing is interpolated across an edge. In images whose longer side has 960 pixels or more the neighbourhood is
/// wider by as much: how far a depth edge lies beside that of the image is an angle.
struct GuardedDepth {
  // No option in files.
  int fewest_neighbours = 6;  ///< of nine pixels that must have a depth
  double jump_m = 0.03;       ///< more difference within the neighbourhood is an edge …
  double jump_sigmas = 7.0;   ///< … with this many standard deviations of the depth: the extremes of nine and a slope

  /// @param noise  of the sensor, `double sigma(double depth_m)`
  /// @return       metres, 0 where there is none.
  template <class Noise = KinectNoise>
  double at(const DepthView& depth, const Vector2f& pixel, const Noise& noise = {}) const {
    // Also false for NaN, and for what is too far away for an int.
    if (!(depth.image.border_distance_px(pixel.x(), pixel.y()) >= 0.5f)) return 0.0;
    const int u = rounded(pixel.x()), v = rounded(pixel.y()), r = reach_px(depth.image);
    if (u < r || v < r || u + r >= depth.image.width || v + r >= depth.image.height) return 0.0;
    return depth.image.format == PixelFormat::depth16 ? of_surface<std::uint16_t>(depth, u, v, r, noise)
                                                      : of_surface<float>(depth, u, v, r, noise);
  }

  /// The same at a pixel of the gray image, whose depth image may have another size.
  template <class Noise = KinectNoise>
  double at(const FrameView& frame, const Vector2f& pixel, const Noise& noise = {}) const {
    return frame.depth.empty() ? 0.0 : at(frame.depth, DepthScale(frame.gray, frame.depth.image)(pixel), noise);
  }

 private:
  static constexpr int kUsualSide_px = 640;

  /// From the centre of the neighbourhood to its border.
  static int reach_px(const ImageView& depth) noexcept {
    return std::max(1, (depth.longer_side_px() + kUsualSide_px / 2) / kUsualSide_px);
  }

  /// Compared in the units of the image: metres of the extremes alone.
  template <class Depth, class Noise>
  double of_surface(const DepthView& depth, int u, int v, int r, const Noise& noise) const {
    const Depth centre = depth.image.row<Depth>(v)[u];
    if (!DepthView::is_depth(centre)) return 0.0;
    int neighbours = 0;
    Depth nearest = centre, farthest = centre;
    for (int j = -r; j <= r; ++j) {
      const Depth* const row = depth.image.row<Depth>(v + j) + u;
      for (int i = -r; i <= r; ++i) {
        const bool counts = DepthView::is_depth(row[i]);
        neighbours += counts;
        nearest = counts && row[i] < nearest ? row[i] : nearest;
        farthest = counts && row[i] > farthest ? row[i] : farthest;
      }
    }
    if (9 * neighbours < fewest_neighbours * (2 * r + 1) * (2 * r + 1)) return 0.0;
    const auto centre_m = static_cast<double>(depth.metres(centre));
    const double difference_m =
        static_cast<double>(depth.metres(farthest)) - static_cast<double>(depth.metres(nearest));
    const bool is_surface = difference_m <= jump_m || difference_m <= jump_m + jump_sigmas * noise.sigma(centre_m);
    return is_surface ? centre_m : 0.0;
  }
};

template <class Visit, std::enable_if_t<sees_code_only<Visit>::value, int> = 0>
void each_option(GuardedDepth& lookup, Visit& visit) {
  visit("fewest_neighbours", lookup.fewest_neighbours, OptionRange{1, 9});
  visit("jump_m", lookup.jump_m, OptionRange{0, 1e6});
  visit("jump_sigmas", lookup.jump_sigmas, OptionRange{0, 1e6});
}

}  // namespace stillpoint
