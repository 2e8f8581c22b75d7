// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A depth image as it would be from another place, or at another time.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/tile_motion.hpp"

namespace stillpoint {

/// Moves each depth to the pixel where it is seen after a small motion: the nearest wins, cracks of one pixel within a
/// surface are closed, and what was hidden has no depth. Keeps its buffer.
class MovedDepth {
 public:
  /// @param frame   its depth image and, for the scale between the two, its image
  /// @param motion  moved_from_given: of what is seen, in the camera, metres
  /// @return        float metres of the same size; valid until the next call. O(pixels); within a tile a lens is
  /// linear.
  template <class Camera>
  DepthView operator()(const FrameView& frame, const Pose& motion, const Camera& camera) {
    const ImageView& image = frame.depth.image;
    depth_m_.resize(image.width, image.height, PixelFormat::depth32f);
    for (int v = 0; v < image.height; ++v) std::fill_n(depth_m_.row<float>(v), image.width, 0.0f);
    const DepthScale to_depth(frame.image(), image);
    for (int top = 0; top < image.height; top += TileMotion::kSide_px)
      for (int left = 0; left < image.width; left += TileMotion::kSide_px)
        move_tile(frame.depth, left, top, TileMotion(image, left, top, to_depth, motion, camera));
    close_cracks();
    return DepthView(depth_m_.view());
  }

 private:
  static constexpr float kOneSurface = 0.03f;  // of the depth: what differs more across a crack is two surfaces

  void move_tile(const DepthView& depth, int left, int top, const TileMotion& tile) {
    const int right = std::min(left + TileMotion::kSide_px, depth.image.width);
    const int bottom = std::min(top + TileMotion::kSide_px, depth.image.height);
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u) {
        const float depth_m = depth.metres(u, v);
        if (!(depth_m > 0.0f)) continue;
        const TileMotion::Place there = tile(static_cast<float>(u), static_cast<float>(v), depth_m);
        if (!(depth_m_.view().border_distance_px(there.u, there.v) >= 0.0f)) continue;
        float& seen_m = depth_m_.row<float>(rounded(there.v))[rounded(there.u)];
        if (seen_m == 0.0f || there.depth_m < seen_m) seen_m = there.depth_m;
      }
  }

  /// Where what came nearer, or turned, left single pixels open: along the row, then along the column.
  void close_cracks() {
    const ImageView view = depth_m_.view();
    const auto close = [&](int v, int u, float before_m, float behind_m) {
      const float nearer_m = std::min(before_m, behind_m);
      if (nearer_m > 0.0f && std::abs(before_m - behind_m) < kOneSurface * nearer_m)
        depth_m_.row<float>(v)[u] = 0.5f * (before_m + behind_m);
    };
    for (int v = 0; v < view.height; ++v) {
      const float* const row = view.row<float>(v);
      for (int u = 1; u + 1 < view.width; ++u)
        if (row[u] == 0.0f) close(v, u, row[u - 1], row[u + 1]);
    }
    for (int v = 1; v + 1 < view.height; ++v)
      for (int u = 0; u < view.width; ++u)
        if (view.row<float>(v)[u] == 0.0f) close(v, u, view.row<float>(v - 1)[u], view.row<float>(v + 1)[u]);
  }

  ImageBuffer depth_m_;
};

}  // namespace stillpoint
