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
    for (int top = 0; top < image.height; top += kTile_px)
      for (int left = 0; left < image.width; left += kTile_px)
        move_tile(frame.depth, left, top, Tile(image, left, top, to_depth, motion, camera));
    close_cracks();
    return DepthView(depth_m_.view());
  }

 private:
  static constexpr int kTile_px = 16;
  static constexpr float kNearest_m = 0.05f;
  static constexpr float kOneSurface = 0.03f;  // of the depth: what differs more across a crack is two surfaces

  /// The projection, linear around the middle of a tile: exact without a lens.
  struct Tile {
    float middle_x, middle_y;              ///< pixel of the depth image
    float middle_plane_x, middle_plane_y;  ///< … on the plane z = 1
    float plane_per_pixel[2][2], pixel_per_plane[2][2];
    float rotation[3][3], translation_m[3];

    template <class Camera>
    Tile(const ImageView& image, int left, int top, const DepthScale& to_depth, const Pose& motion,
         const Camera& camera) {
      const Vector2d step_px(1.0 / static_cast<double>(to_depth.x), 1.0 / static_cast<double>(to_depth.y));
      middle_x = 0.5f * static_cast<float>(left + std::min(left + kTile_px, image.width));
      middle_y = 0.5f * static_cast<float>(top + std::min(top + kTile_px, image.height));
      const Vector2d middle_px = to_depth.inverse({middle_x, middle_y}).template cast<double>();
      const auto plane_at = [&](double x_px, double y_px) {
        return camera.back_project(camera.undistort(Vector2d(x_px, y_px)), 1.0);
      };
      const Vector3d middle = plane_at(middle_px.x(), middle_px.y());
      const Vector3d right = plane_at(middle_px.x() + step_px.x(), middle_px.y());
      const Vector3d below = plane_at(middle_px.x(), middle_px.y() + step_px.y());
      middle_plane_x = static_cast<float>(middle.x());
      middle_plane_y = static_cast<float>(middle.y());
      const double a = right.x() - middle.x(), b = below.x() - middle.x();
      const double c = right.y() - middle.y(), d = below.y() - middle.y();
      const double determinant = a * d - b * c;
      const double forward[2][2] = {{a, b}, {c, d}}, adjugate[2][2] = {{d, -b}, {-c, a}};
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          plane_per_pixel[i][j] = static_cast<float>(forward[i][j]);
          pixel_per_plane[i][j] = static_cast<float>(adjugate[i][j] / determinant);
        }
      for (int i = 0; i < 3; ++i) {
        translation_m[i] = static_cast<float>(motion.translation()(i));
        for (int j = 0; j < 3; ++j) rotation[i][j] = static_cast<float>(motion.linear()(i, j));
      }
    }
  };

  void move_tile(const DepthView& depth, int left, int top, const Tile& tile) {
    const int right = std::min(left + kTile_px, depth.image.width);
    const int bottom = std::min(top + kTile_px, depth.image.height);
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u) {
        const float depth_m = depth.metres(u, v);
        if (depth_m > 0.0f)
          move(tile, static_cast<float>(u) - tile.middle_x, static_cast<float>(v) - tile.middle_y, depth_m);
      }
  }

  /// @param du, dv  from the middle of the tile
  void move(const Tile& tile, float du, float dv, float depth_m) {
    const float x = tile.middle_plane_x + tile.plane_per_pixel[0][0] * du + tile.plane_per_pixel[0][1] * dv;
    const float y = tile.middle_plane_y + tile.plane_per_pixel[1][0] * du + tile.plane_per_pixel[1][1] * dv;
    const auto row = [&](int i) {
      return depth_m * (tile.rotation[i][0] * x + tile.rotation[i][1] * y + tile.rotation[i][2]) +
             tile.translation_m[i];
    };
    const float there_m = row(2);
    if (!(there_m > kNearest_m)) return;
    const float off_x = row(0) / there_m - tile.middle_plane_x, off_y = row(1) / there_m - tile.middle_plane_y;
    const float u = tile.middle_x + tile.pixel_per_plane[0][0] * off_x + tile.pixel_per_plane[0][1] * off_y;
    const float v = tile.middle_y + tile.pixel_per_plane[1][0] * off_x + tile.pixel_per_plane[1][1] * off_y;
    if (!(depth_m_.view().border_distance_px(u, v) >= 0.0f)) return;
    float& seen_m = depth_m_.row<float>(rounded(v))[rounded(u)];
    if (seen_m == 0.0f || there_m < seen_m) seen_m = there_m;
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
