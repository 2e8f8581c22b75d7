// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which corners are fixed to the camera?   A gripper, a bumper, the hood of a car.

#include <cstddef>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/rigid/reprojection_residual.hpp"
#include "stillpoint/motion/rigid/stationary_camera.hpp"

namespace stillpoint {

/// What is fixed to the camera stays where it is in the image while the rest moves, and lies before the rest. A camera
/// that pivots about it explains it, and a world at one distance as well: a shift and a turn that cancel there. But
/// what is near moves most when a camera moves, so that what stays there is hardly part of the world. Where the camera
/// is stationary and others move, something farther is at rest, too.
struct FixedToCamera {
  bool is_enabled = true;  ///< false: everything may support the motion; no option in files

  /// Leaves such corners little weight in the motion, in all older frames. Whether they move is for the scorer to say.
  template <class Camera>
  void down_weight(span<PointConstraint> points, std::size_t features, const Camera& camera,
                   Workspace& workspace) const {
    if (!is_enabled) return;
    const Workspace::Scope scope(workspace);
    const span<std::uint8_t> is_fixed = workspace.take<std::uint8_t>(features, std::uint8_t{0});
    bool any = false;
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
      while (end < points.size() && points[end].frame == points[begin].frame) ++end;
      any |= find(points.subspan(begin, end - begin), camera, is_fixed, workspace);
    }
    if (!any) return;
    for (PointConstraint& point : points) {
      if (is_fixed[point.feature] == 0) continue;
      point.weight *= kWeight;
      point.weight_without_prior *= kWeight;
    }
  }

 private:
  static constexpr double kMoved_px = 1.0;     // the others move by so much on average, clearly more
  static constexpr double kNearer = 0.7;       // times their depth, what is fixed lies before them
  static constexpr double kLeastShare = 0.05;  // of the weight of all corners that is fixed
  static constexpr double kMostBehind = 0.1;   // of the weight of those that move is at rest and not before them
  static constexpr double kWeight = 0.01;      // what is left to a fixed corner

  /// @param points    of one older frame
  /// @param is_fixed  one flag per feature
  /// @return          were there any?
  template <class Camera>
  static bool find(span<const PointConstraint> points, const Camera& camera, span<std::uint8_t> is_fixed,
                   Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const span<std::uint8_t> rests = workspace.take<std::uint8_t>(points.size(), std::uint8_t{0});  // with a depth
    double moving = 0, moved_px = 0, with_depth = 0, inverse_depth = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const PointConstraint& point = points[k];
      const double step_px = (camera.project(point.point) - point.pixel).norm();
      if (step_px < StationaryCamera::kRest_px) {
        rests[k] = point.has_depth();
        continue;
      }
      moving += point.weight;
      moved_px += point.weight * step_px;
      if (!point.has_depth()) continue;
      with_depth += point.weight;
      inverse_depth += point.weight / point.point.z();
    }
    if (!(with_depth > 0) || moved_px < kMoved_px * moving) return false;
    const double nearest_m = kNearer * with_depth / inverse_depth;
    double fixed = 0, behind = 0;
    const auto lies_before = [nearest_m](const PointConstraint& point) { return point.point.z() < nearest_m; };
    for (std::size_t k = 0; k < points.size(); ++k)
      if (rests[k] != 0) (lies_before(points[k]) ? fixed : behind) += points[k].weight;
    if (fixed < kLeastShare * (fixed + moving) || behind > kMostBehind * moving) return false;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (rests[k] != 0 && lies_before(points[k])) is_fixed[points[k].feature] = 1;
    return true;
  }
};

}  // namespace stillpoint
