// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where the prior says that something may move, and which features lie there.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// What is known of an object's class (the paper, 3.2: static, dynamic, "potential dynamic").
enum class Mobility : std::uint8_t {
  unknown,
  fixed,    ///< wall, television, table: the paper's "static"
  movable,  ///< chair, mouse, bottle: moves when it is moved
  dynamic,  ///< people, animals, cars
};

constexpr const char* to_string(Mobility mobility) noexcept {
  switch (mobility) {
    case Mobility::fixed: return "static";
    case Mobility::movable: return "movable";
    case Mobility::dynamic: return "dynamic";
    default: return "unknown";
  }
}

/// Axis-aligned rectangle in the image, pixels, corner (x, y) at the top left.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;

  bool contains(const Vector2f& pixel) const noexcept {
    return pixel.x() >= x && pixel.y() >= y && pixel.x() <= x + width && pixel.y() <= y + height;
  }

  /// Distance from a pixel to the nearest point of the outline, inside or outside.
  float edge_distance_px(const Vector2f& pixel) const noexcept {
    const float inside_x = std::min(pixel.x() - x, x + width - pixel.x());
    const float inside_y = std::min(pixel.y() - y, y + height - pixel.y());
    if (inside_x >= 0 && inside_y >= 0) return std::min(inside_x, inside_y);
    return Vector2f(std::max(-inside_x, 0.0f), std::max(-inside_y, 0.0f)).norm();
  }
};

/// What of a box is the object itself: a raster stretched over the box, so that it moves and grows with it.
struct BoxMask {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> inside;  ///< row by row, 0 is not the object

  /// @param x, y  share of the box's width and height, 0 to 1; beyond, the cells at the border count on
  bool at(float x, float y) const noexcept {
    if (columns <= 0 || rows <= 0) return false;
    const auto cell = [](float share, int count) {
      const float place = share * static_cast<float>(count);
      if (!(place > 0.0f)) return 0;  // nor is NaN
      return place < static_cast<float>(count) ? std::min(static_cast<int>(place), count - 1) : count - 1;
    };
    const auto row = static_cast<std::size_t>(cell(y, rows)), column = static_cast<std::size_t>(cell(x, columns));
    return inside[row * static_cast<std::size_t>(columns) + column] != 0;
  }
};

/// One answer of a detector.
struct Detection {
  Box box;
  Mobility mobility = Mobility::unknown;
  float confidence = 1.0f;  ///< 0 to 1
  double nearest_m = 0.0;   ///< depth of the object itself: what is nearer or farther in its box is something else …
  double farthest_m = std::numeric_limits<double>::infinity();  ///< … seen past it; metres, half way down the box
  /// An object that leans, or is looked down on: so much farther from the top to the bottom.
  double depth_slope_m = 0.0;
  std::shared_ptr<const BoxMask> mask =
      nullptr;                    ///< none: all of the box; shared, so that a detection can be copied freely
  std::int16_t class_index = -1;  ///< in the detector's list of classes, for overlays; -1: not known

  /// Features without a depth (0) are taken to be of the object.
  bool holds(const Vector2f& pixel, double depth_m) const noexcept {
    return box.contains(pixel) && (!(depth_m > 0.0) || reaches(depth_m, (pixel.y() - box.y) / box.height)) &&
           (!mask || mask->at((pixel.x() - box.x) / box.width, (pixel.y() - box.y) / box.height));
  }

 private:
  /// @param down  share of the box's height
  bool reaches(double depth_m, float down) const noexcept {
    const double level_m = depth_m - depth_slope_m * (static_cast<double>(down) - 0.5);
    return level_m >= nearest_m && level_m <= farthest_m;
  }
};

/// How one feature lies to the regions.
struct Membership {
  static constexpr std::int32_t kNone = -1;

  bool in_fixed = false;
  bool in_movable = false;
  bool in_dynamic = false;
  std::int32_t dynamic_region = kNone;  ///< the smallest dynamic region that holds it
  float edge_distance_px =
      std::numeric_limits<float>::infinity();  ///< to the nearest outline of a fixed or dynamic one
};

/// The prior's answer for one frame.
struct Regions {
  std::vector<Detection> detections;
  std::vector<Membership> of_feature;  ///< one entry per feature, filled by `locate`

  /// Finds the regions of each feature. O(features × regions).
  /// @param depth_m  of each feature, 0 none; or none of them at all
  void locate(span<const Vector2f> pixels, span<const double> depth_m = {}) {
    refill(of_feature, pixels.size(), Membership{});
    for (std::size_t r = 0; r < detections.size(); ++r) {
      const Detection& detection = detections[r];
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        Membership& feature = of_feature[i];
        if (detection.mobility == Mobility::fixed || detection.mobility == Mobility::dynamic)
          feature.edge_distance_px = std::min(feature.edge_distance_px, detection.box.edge_distance_px(pixels[i]));
        if (!detection.holds(pixels[i], depth_m.empty() ? 0.0 : depth_m[i])) continue;
        if (detection.mobility == Mobility::fixed) feature.in_fixed = true;
        if (detection.mobility == Mobility::movable) feature.in_movable = true;
        if (detection.mobility == Mobility::dynamic) {
          feature.in_dynamic = true;
          if (feature.dynamic_region == Membership::kNone ||
              area(detection.box) < area(detections[static_cast<std::size_t>(feature.dynamic_region)].box))
            feature.dynamic_region = static_cast<std::int32_t>(r);
        }
      }
    }
  }

 private:
  static float area(const Box& box) noexcept { return box.width * box.height; }
};

}  // namespace stillpoint
