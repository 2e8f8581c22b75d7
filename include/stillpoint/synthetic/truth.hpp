// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Truth about motion: which pixels of a mover move now, since when, where silhouettes are, and the movers' boxes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/synthetic_frame.hpp"

namespace stillpoint::synthetic {

/// How far the points of a part have moved since two earlier moments.
class PartMotion {
 public:
  PartMotion() = default;  ///< stands still

  PartMotion(const Mover& mover, const Part& part, double now_s, double last_s, double window_start_s,
             const MotionRule& rule)
      : rule_(rule) {
    const Pose now = mover.world_from_part(part, now_s);
    since_last_ = now.matrix() - mover.world_from_part(part, last_s).matrix();
    since_window_ = now.matrix() - mover.world_from_part(part, window_start_s).matrix();
    const Vector3d origin_way =
        mover.world_from_object(now_s).translation() - mover.world_from_object(window_start_s).translation();
    origin_moved_ = origin_way.norm() > rule.window_m;
  }

  /// @param point  in the part's frame, metres
  bool moves(const Vector3d& point) const {
    return origin_moved_ || way(since_last_, point) > rule_.last_frame_m || way(since_window_, point) > rule_.window_m;
  }

 private:
  static double way(const Eigen::Matrix4d& change, const Vector3d& point) {
    return (change.topLeftCorner<3, 3>() * point + change.topRightCorner<3, 1>()).norm();
  }

  Eigen::Matrix4d since_last_ = Eigen::Matrix4d::Zero(), since_window_ = Eigen::Matrix4d::Zero();
  bool origin_moved_ = false;
  MotionRule rule_;
};

/// The first frame in which a mover, or a part of it, moves by the scene's rule; none where it never does.
/// @param mover  index into `Scene::movers`
inline std::optional<int> first_moving_frame(const Scene& scene, std::size_t mover) {
  const auto time_of = [&scene](int index) { return std::max(0, index) / scene.frame_rate_hz; };
  for (int i = 1; i < scene.frame_count; ++i)
    for (const Part& part : scene.movers.at(mover).parts) {
      const PartMotion motion(scene.movers[mover], part, time_of(i), time_of(i - 1),
                              time_of(i - scene.motion_rule.window_frames), scene.motion_rule);
      if (motion.moves(Vector3d::Zero())) return i;
    }
  return std::nullopt;
}

/// The labels of a frame where furniture of that name is seen, `kIgnored` everywhere else: to count features on static
/// objects apart from the rest of the background.
inline void labels_of(const Scene& scene, const std::string& name, const SyntheticFrame& frame, ImageBuffer& labels) {
  constexpr std::size_t kShared = 254;  // furniture from here on shares an identifier
  labels.assign(frame.labels.view());
  const ImageView ids = frame.furniture_ids.view();
  for (int v = 0; v < ids.height; ++v)
    for (int u = 0; u < ids.width; ++u) {
      const std::size_t id = ids.row<std::uint8_t>(v)[u];
      const bool is_named = id > 0 && id <= kShared && scene.furniture[id - 1].name == name;
      if (!is_named) labels.row<std::uint8_t>(v)[u] = kIgnored;
    }
}

/// Sets `kIgnored` where two different movers, or a mover and the static scene, are seen within 2 px of each other
/// (a square of 5 × 5): two pixels on both sides of every silhouette.
/// @param ids  gray8, 0 static, k + 1 for mover k   @param columns  scratch, at least 2 · width bytes
inline void ignore_silhouettes(const ImageView& ids, std::vector<std::uint8_t>& columns, ImageBuffer& labels) {
  constexpr int kRim = 2;
  const int width = ids.width, height = ids.height;
  columns.resize(2 * static_cast<std::size_t>(width));
  std::uint8_t* const lowest = columns.data();
  std::uint8_t* const highest = columns.data() + width;
  for (int v = 0; v < height; ++v) {
    std::fill(lowest, lowest + width, std::uint8_t{255});
    std::fill(highest, highest + width, std::uint8_t{0});
    for (int w = std::max(0, v - kRim); w <= std::min(height - 1, v + kRim); ++w) {
      const std::uint8_t* const row = ids.row<std::uint8_t>(w);
      for (int u = 0; u < width; ++u) {
        lowest[u] = std::min(lowest[u], row[u]);
        highest[u] = std::max(highest[u], row[u]);
      }
    }
    std::uint8_t* const out = labels.row<std::uint8_t>(v);
    for (int u = 0; u < width; ++u) {
      const int begin = std::max(0, u - kRim), end = std::min(width, u + kRim + 1);
      if (*std::min_element(lowest + begin, lowest + end) != *std::max_element(highest + begin, highest + end))
        out[u] = kIgnored;
    }
  }
}

/// Boxes around what is seen of each mover that has a class name.
inline void find_boxes(const ImageView& ids, const std::vector<Mover>& movers, std::vector<TruthBox>& boxes) {
  constexpr int kFewestPixels = 400, kPadding = 4;
  struct Extent {
    int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1, pixels = 0;
  };
  std::array<Extent, 256> extents;
  for (int v = 0; v < ids.height; ++v) {
    const std::uint8_t* const row = ids.row<std::uint8_t>(v);
    for (int u = 0; u < ids.width; ++u) {
      if (row[u] == 0) continue;
      Extent& extent = extents[row[u]];
      extent.left = std::min(extent.left, u);
      extent.right = std::max(extent.right, u);
      extent.top = std::min(extent.top, v);
      extent.bottom = v;
      ++extent.pixels;
    }
  }
  boxes.clear();
  for (std::size_t k = 0; k < std::min<std::size_t>(movers.size(), 254); ++k) {
    const Extent& extent = extents[k + 1];
    if (extent.pixels < kFewestPixels || movers[k].class_name.empty()) continue;
    const int x = std::max(0, extent.left - kPadding), y = std::max(0, extent.top - kPadding);
    const int right = std::min(ids.width, extent.right + 1 + kPadding);
    const int bottom = std::min(ids.height, extent.bottom + 1 + kPadding);
    boxes.push_back({movers[k].class_name, k, x, y, right - x, bottom - y, extent.pixels});
  }
}

}  // namespace stillpoint::synthetic
