// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where are the pixels of a depth image after a small motion of the camera?   A tile of them at a time.

#include <algorithm>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// A rigid motion of what the pixels of one tile show. The projection is linear around the middle of the tile: exact
/// without a lens.
class TileMotion {
 public:
  static constexpr int kSide_px = 16;

  /// A pixel of the depth image, and the depth that is seen there; NaN, NaN and 0 for what came behind the camera.
  struct Place {
    float u, v, depth_m;
  };

  /// @param image      the depth image
  /// @param left, top  the tile's first pixel
  /// @param motion     moved_from_given: of what is seen, in the camera, metres
  template <class Camera>
  TileMotion(const ImageView& image, int left, int top, const DepthScale& to_depth, const Pose& motion,
             const Camera& camera) {
    const Vector2d step_px(1.0 / static_cast<double>(to_depth.x), 1.0 / static_cast<double>(to_depth.y));
    middle_x_ = 0.5f * static_cast<float>(left + std::min(left + kSide_px, image.width));
    middle_y_ = 0.5f * static_cast<float>(top + std::min(top + kSide_px, image.height));
    const Vector2d middle_px = to_double(to_depth.inverse({middle_x_, middle_y_}));
    const auto plane_at = [&](double x_px, double y_px) {
      return camera.back_project(camera.undistort(Vector2d(x_px, y_px)), 1.0);
    };
    const Vector3d middle = plane_at(middle_px.x(), middle_px.y());
    const Vector3d right = plane_at(middle_px.x() + step_px.x(), middle_px.y());
    const Vector3d below = plane_at(middle_px.x(), middle_px.y() + step_px.y());
    middle_plane_x_ = static_cast<float>(middle.x());
    middle_plane_y_ = static_cast<float>(middle.y());
    const double a = right.x() - middle.x(), b = below.x() - middle.x();
    const double c = right.y() - middle.y(), d = below.y() - middle.y();
    const double determinant = a * d - b * c;
    const double forward[2][2] = {{a, b}, {c, d}}, adjugate[2][2] = {{d, -b}, {-c, a}};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        plane_per_pixel_[i][j] = static_cast<float>(forward[i][j]);
        pixel_per_plane_[i][j] = static_cast<float>(adjugate[i][j] / determinant);
      }
    for (int i = 0; i < 3; ++i) {
      translation_m_[i] = static_cast<float>(motion.matrix()(i, 3));
      for (int j = 0; j < 3; ++j) rotation_[i][j] = static_cast<float>(motion.matrix()(i, j));
    }
  }

  /// @param u, v  pixel of the depth image, in the tile or not far from it
  Place operator()(float u, float v, float depth_m) const noexcept {
    const float du = u - middle_x_, dv = v - middle_y_;
    const float x = middle_plane_x_ + plane_per_pixel_[0][0] * du + plane_per_pixel_[0][1] * dv;
    const float y = middle_plane_y_ + plane_per_pixel_[1][0] * du + plane_per_pixel_[1][1] * dv;
    const auto row = [&](int i) {
      return depth_m * (rotation_[i][0] * x + rotation_[i][1] * y + rotation_[i][2]) + translation_m_[i];
    };
    const float there_m = row(2);
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    if (!(there_m > kNearest_m)) return {kNowhere, kNowhere, 0.0f};
    const float off_x = row(0) / there_m - middle_plane_x_, off_y = row(1) / there_m - middle_plane_y_;
    return {middle_x_ + pixel_per_plane_[0][0] * off_x + pixel_per_plane_[0][1] * off_y,
            middle_y_ + pixel_per_plane_[1][0] * off_x + pixel_per_plane_[1][1] * off_y, there_m};
  }

 private:
  static constexpr float kNearest_m = 0.05f;

  float middle_x_, middle_y_;              // pixel of the depth image
  float middle_plane_x_, middle_plane_y_;  // … on the plane z = 1
  float plane_per_pixel_[2][2], pixel_per_plane_[2][2];
  float rotation_[3][3], translation_m_[3];
};

}  // namespace stillpoint
