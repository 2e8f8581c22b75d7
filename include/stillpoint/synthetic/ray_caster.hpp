// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Rays against solids: what each pixel's ray meets first, and what colour is there.
//
// All inner loops use plain floats: they run millions of times per frame, in debug builds too.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// A ray (x, y, 1) from the camera's centre: what it travels is depth.
struct Ray {
  float x = 0, y = 0;
};

/// Where a ray meets a solid.
struct Hit {
  float depth_m = 0.0f;
  int face = 0;
};

/// How a surface is lit and how finely it is seen: hardly changes within a pixel.
struct Shading {
  float lit;     ///< factor of brightness
  float cosine;  ///< of the angle between ray and normal, in [0, 1]
  float level;   ///< of the texture's pyramid
};

/// A solid as the camera sees it at one moment.
class PlacedSolid {
 public:
  PlacedSolid(const Solid& solid, const Pose& camera_from_solid, const Pose& world_from_camera)
      : solid_(&solid), camera_from_solid_(camera_from_solid) {
    const Pose solid_from_camera = camera_from_solid.inverse();
    const Vector3d light = (camera_from_solid.linear().transpose() * world_from_camera.linear().transpose() *
                            Vector3d(0.35, -0.8, -0.5).normalized());  // the lamp, up and behind the first view
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) turn_[axis][k] = static_cast<float>(solid_from_camera.linear()(axis, k));
      origin_[axis] = static_cast<float>(solid_from_camera.translation()[axis]);
      half_[axis] = static_cast<float>(solid.half_extents[axis]);
      light_[axis] = static_cast<float>(light[axis]);
    }
  }

  const Solid& solid() const noexcept { return *solid_; }
  const Pose& camera_from_solid() const noexcept { return camera_from_solid_; }

  /// Corners of the cuboid around it, in the camera's frame.
  std::array<Vector3d, 8> corners() const {
    std::array<Vector3d, 8> result;
    for (int i = 0; i < 8; ++i)
      result[static_cast<std::size_t>(i)] = camera_from_solid_ * Vector3d((i & 1 ? 1 : -1) * solid_->half_extents.x(),
                                                                          (i & 2 ? 1 : -1) * solid_->half_extents.y(),
                                                                          (i & 4 ? 1 : -1) * solid_->half_extents.z());
    return result;
  }

  /// The first meeting before `limit_m`; false when there is none.
  bool meets(const Ray& ray, float limit_m, Hit& hit) const noexcept {
    const float d[3] = {along(0, ray), along(1, ray), along(2, ray)};
    return solid_->shape == Shape::ellipsoid ? meets_ellipsoid(d, limit_m, hit) : meets_cuboid(d, limit_m, hit);
  }

  /// Depth at which the ray meets the plane of a face that a near-by ray has hit; of an ellipsoid the meeting itself,
  /// or `depth_m` where the ray just misses.
  float depth_on_face(const Ray& ray, int face, float depth_m) const noexcept {
    if (solid_->shape == Shape::ellipsoid) {
      Hit hit;
      const float d[3] = {along(0, ray), along(1, ray), along(2, ray)};
      return meets_ellipsoid(d, 1e9f, hit) ? hit.depth_m : depth_m;
    }
    const int axis = face / 2;
    return ((face & 1 ? half_[axis] : -half_[axis]) - origin_[axis]) / along(axis, ray);
  }

  /// Point of the surface in the solid's frame, metres.
  std::array<float, 3> point(const Ray& ray, float depth_m) const noexcept {
    return {origin_[0] + depth_m * along(0, ray), origin_[1] + depth_m * along(1, ray),
            origin_[2] + depth_m * along(2, ray)};
  }

  /// @param sample_width  distance between two samples of the image at a depth of 1 m, metres
  Shading shading(const Ray& ray, const Hit& hit, float sample_width) const noexcept {
    const float d[3] = {along(0, ray), along(1, ray), along(2, ray)};
    const int axis = hit.face / 2;
    float normal[3] = {0, 0, 0};
    if (solid_->shape == Shape::ellipsoid) {
      for (int k = 0; k < 3; ++k) normal[k] = (origin_[k] + hit.depth_m * d[k]) / (half_[k] * half_[k]);
      const float unit = 1.0f / std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      for (float& n : normal) n *= unit;
    } else {
      normal[axis] = ((hit.face & 1) != 0) == (solid_->shape != Shape::room) ? 1.0f : -1.0f;
    }
    const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const float cosine = std::abs(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / length;
    const float lit = 0.8f + 0.2f * (normal[0] * light_[0] + normal[1] * light_[1] + normal[2] * light_[2]);
    // Slanted surfaces: between the footprint's short and long side, neither too blurred nor too rough.
    const float texels = hit.depth_m * length * sample_width *
                         solid_->textures[static_cast<std::size_t>(hit.face)]->texels_per_metre() /
                         std::sqrt(std::max(cosine, 0.05f));
    return {lit, cosine, std::log2(std::max(texels, 1.0f))};
  }

  /// Of a face, for `colour`.
  /// @param level  of the texture's pyramid
  TextureSampler sampler(int face, float level) const noexcept {
    return solid_->textures[static_cast<std::size_t>(face)]->sampler(level);
  }

  /// Colour of the surface where a ray meets it, not lit.
  Bgr colour(const Ray& ray, const Hit& hit, const TextureSampler& sampler) const noexcept {
    const int axis = hit.face / 2, across = axis == 0 ? 2 : 0, down = axis == 1 ? 2 : 1;
    const float shift = 0.37f * static_cast<float>(hit.face);  // another part of the tile on every face
    const float x = origin_[across] + hit.depth_m * along(across, ray) + half_[across] + shift;
    const float y = origin_[down] + hit.depth_m * along(down, ray) + half_[down] + shift;
    return sampler(x, y);
  }

 private:
  static constexpr float kNearest = 0.02f;  ///< metres: what touches the lens is not seen

  float along(int axis, const Ray& ray) const noexcept {
    return turn_[axis][0] * ray.x + turn_[axis][1] * ray.y + turn_[axis][2];
  }

  /// Slabs (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986). A ray within a face's plane meets it nowhere: the
  /// comparisons fail for the NaN of 0 · ∞.
  bool meets_cuboid(const float* d, float limit_m, Hit& hit) const noexcept {
    float enter = -1e30f, leave = 1e30f;
    int enter_face = 0, leave_face = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float inverse = 1.0f / d[axis];
      const bool forward = d[axis] >= 0.0f;
      const float end = forward ? half_[axis] : -half_[axis];
      const float entered = (-end - origin_[axis]) * inverse, left = (end - origin_[axis]) * inverse;
      if (entered > enter) enter = entered, enter_face = 2 * axis + (forward ? 0 : 1);
      if (left < leave) leave = left, leave_face = 2 * axis + (forward ? 1 : 0);
    }
    const bool inside = solid_->shape == Shape::room;
    hit.depth_m = inside ? leave : enter;
    hit.face = inside ? leave_face : enter_face;
    return enter <= leave && hit.depth_m > kNearest && hit.depth_m < limit_m;
  }

  bool meets_ellipsoid(const float* d, float limit_m, Hit& hit) const noexcept {
    float dd = 0, od = 0, oo = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float unit = 1.0f / half_[axis], direction = d[axis] * unit, start = origin_[axis] * unit;
      dd += direction * direction;
      od += start * direction;
      oo += start * start;
    }
    const float discriminant = od * od - dd * (oo - 1.0f);
    if (!(discriminant >= 0.0f)) return false;
    hit.depth_m = (-od - std::sqrt(discriminant)) / dd;
    if (!(hit.depth_m > kNearest && hit.depth_m < limit_m)) return false;
    float farthest = -1.0f;
    for (int axis = 0; axis < 3; ++axis) {  // the face of the cuboid around it that this point looks to
      const float place = (origin_[axis] + hit.depth_m * d[axis]) / half_[axis];
      if (std::abs(place) > farthest) farthest = std::abs(place), hit.face = 2 * axis + (place > 0.0f ? 1 : 0);
    }
    return true;
  }

  const Solid* solid_;
  Pose camera_from_solid_;
  float turn_[3][3] = {};
  float origin_[3] = {};
  float half_[3] = {};
  float light_[3] = {};
};

/// The ray of every pixel, and which pixels a solid can fall on.
class RayGrid {
 public:
  explicit RayGrid(const Camera& camera)
      : width_(camera.width()), height_(camera.height()), stride_(static_cast<std::size_t>(width_) + 2) {
    rays_.reserve(stride_ * (static_cast<std::size_t>(height_) + 2));
    for (int v = -1; v <= height_; ++v)
      for (int u = -1; u <= width_; ++u) {
        const Vector3d ray = camera.back_project(camera.undistort(Vector2d(u, v)), 1.0);
        rays_.push_back({static_cast<float>(ray.x()), static_cast<float>(ray.y())});
      }
    columns_.assign(static_cast<std::size_t>(width_), {});
    rows_.assign(static_cast<std::size_t>(height_), {});
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) {
        columns_[static_cast<std::size_t>(u)].widen(at(u, v).x);
        rows_[static_cast<std::size_t>(v)].widen(at(u, v).y);
      }
  }

  /// Ray through the centre of a pixel; one pixel beyond the image's border is there too.
  const Ray& at(int u, int v) const noexcept {
    return rays_[static_cast<std::size_t>(v + 1) * stride_ + static_cast<std::size_t>(u + 1)];
  }

  /// Rays through one pixel.
  struct Pixel {
    Ray centre, per_column, per_row;  ///< the latter two: twice the change from pixel to pixel

    /// The ray beside its centre, by parts of a pixel.
    Ray beside(float du, float dv) const noexcept {
      return {centre.x + 0.5f * (du * per_column.x + dv * per_row.x),
              centre.y + 0.5f * (du * per_column.y + dv * per_row.y)};
    }
  };

  Pixel pixel(int u, int v) const noexcept {
    const Ray &left = at(u - 1, v), &right = at(u + 1, v), &up = at(u, v - 1), &down = at(u, v + 1);
    return {at(u, v), {right.x - left.x, right.y - left.y}, {down.x - up.x, down.y - up.y}};
  }

  /// Pixels [u_begin, u_end) × [v_begin, v_end).
  struct Window {
    int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
    bool contains(int u, int v) const noexcept { return u >= u_begin && u < u_end && v >= v_begin && v < v_end; }
  };

  /// All pixels whose ray can meet the solid (with any lens), one more on each side.
  Window window(const PlacedSolid& placed) const {
    constexpr double kNear = 0.02;
    Range x, y;
    int behind = 0;
    for (const Vector3d& corner : placed.corners()) {
      if (!(corner.z() > kNear)) {
        ++behind;
        continue;
      }
      x.widen(static_cast<float>(corner.x() / corner.z()));
      y.widen(static_cast<float>(corner.y() / corner.z()));
    }
    if (behind == 8) return {};
    if (behind > 0) return {0, width_, 0, height_};
    Window result;
    overlap(columns_, x, result.u_begin, result.u_end);
    overlap(rows_, y, result.v_begin, result.v_end);
    return result;
  }

 private:
  struct Range {
    float low = 1e30f, high = -1e30f;
    void widen(float value) noexcept {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  };

  static void overlap(const std::vector<Range>& lines, const Range& range, int& begin, int& end) noexcept {
    const int count = static_cast<int>(lines.size());
    begin = count;
    end = 0;
    for (int i = 0; i < count; ++i) {
      const Range& line = lines[static_cast<std::size_t>(i)];
      if (line.high < range.low || line.low > range.high) continue;
      begin = std::min(begin, std::max(0, i - 1));
      end = std::min(count, i + 2);
    }
  }

  int width_, height_;
  std::size_t stride_;
  std::vector<Ray> rays_;
  std::vector<Range> columns_, rows_;
};

}  // namespace stillpoint::synthetic
