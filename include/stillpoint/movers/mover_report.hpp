// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The answer about movers: objects → `Movers`.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/movers/moving_features.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Writes the movers of a frame.
class MoverReport {
 public:
  template <class Camera>
  static void write(std::vector<TrackedObject>& objects, const MovingFeatures<Camera>& features, const Regions& regions,
                    Movers& result, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const Matches& matches = features.matches;
    take_in_depthless(features, workspace);
    const span<std::size_t> order = workspace.take<std::size_t>(objects.size());
    std::size_t count = 0;
    for (std::size_t o = 0; o < objects.size(); ++o)
      if (objects[o].is_confirmed) order[count++] = o;
    std::sort(order.begin(), order.begin() + count,
              [&](std::size_t a, std::size_t b) { return objects[a].mover.id < objects[b].mover.id; });
    for (const std::size_t o : order.first(count)) {
      TrackedObject& object = objects[o];
      Mover mover = object.mover;
      mover.velocity = object.linear.velocity();
      mover.velocity_covariance = object.linear.covariance();
      mover.first_feature = result.feature.size();
      mover.first_pixel = result.pixel.size();
      for (std::size_t i = 0; i < matches.size(); ++i) {
        if (!object.is_seen || features.object_of[i] != static_cast<std::int32_t>(o)) continue;
        result.pixel.push_back(matches.current.pixel[i]);
        result.match.push_back(static_cast<std::uint32_t>(i));
        if (i >= matches.host_count) continue;
        result.feature.push_back(static_cast<std::uint32_t>(i));
        result.of_feature[i] = static_cast<std::int32_t>(result.list.size());
      }
      mover.feature_count = result.feature.size() - mover.first_feature;
      mover.pixel_count = result.pixel.size() - mover.first_pixel;
      name(features, regions, static_cast<std::int32_t>(o), mover, workspace);
      object.mover.class_index = mover.class_index;  // kept for frames in which no detector speaks
      object.mover.confidence = mover.confidence;
      if (object.is_seen)
        mover.box = box_of({result.pixel.data() + mover.first_pixel, mover.pixel_count});
      else
        mover.box = predicted_box(object, features.camera, workspace);
      result.list.push_back(mover);
    }
  }

 private:
  static constexpr std::int32_t kNone = -1;

  /// Dynamic features without a depth go with those beside them.
  template <class Camera>
  static void take_in_depthless(const MovingFeatures<Camera>& features, Workspace& workspace) {
    const Matches& matches = features.matches;
    const float reach_px = 16.0f * matches.pixel_scale;
    const PixelGrid members(matches.current.pixel, reach_px, workspace,
                            [&](std::size_t i) { return features.object_of[i] != kNone; });
    if (members.size() == 0) return;
    const span<std::int32_t> found = workspace.take<std::int32_t>(matches.size(), kNone);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches.current.has_depth(i) || !features.is_dynamic(i)) continue;
      const std::size_t nearest = members.nearest(matches.current.pixel[i], reach_px, [&](std::size_t, float squared) {
        return squared < reach_px * reach_px;
      });
      if (nearest != PixelGrid::kNone) found[i] = features.object_of[nearest];
    }
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (found[i] != kNone) features.object_of[i] = found[i];
  }

  /// The detection that holds most of its features, and at least half of them, names it.
  template <class Camera>
  static void name(const MovingFeatures<Camera>& features, const Regions& regions, std::int32_t index, Mover& mover,
                   Workspace& workspace) {
    if (regions.detections.empty() || mover.pixel_count == 0) return;
    const Workspace::Scope scope(workspace);
    const span<std::size_t> held = workspace.take<std::size_t>(regions.detections.size());
    for (std::size_t i = 0; i < features.matches.size(); ++i)
      if (features.object_of[i] == index)
        for (std::size_t r = 0; r < held.size(); ++r)
          held[r] +=
              regions.detections[r].holds(features.matches.current.pixel[i], features.matches.current.depth_m[i]);
    const std::size_t best = static_cast<std::size_t>(std::max_element(held.begin(), held.end()) - held.begin());
    if (2 * held[best] < mover.pixel_count) return;
    mover.class_index = regions.detections[best].class_index;
    mover.confidence = regions.detections[best].confidence;
  }

  static Box box_of(span<const Vector2f> pixels) {
    if (pixels.empty()) return {};
    Vector2f low = pixels[0], high = low;
    for (const Vector2f& pixel : pixels) {
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
    return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  }

  template <class Camera>
  static Box predicted_box(const TrackedObject& object, const Camera& camera, Workspace& workspace) {
    constexpr double kNearest_m = 0.05;
    const Workspace::Scope scope(workspace);
    const span<Vector2f> pixels = workspace.take<Vector2f>(object.points.size(), Vector2f::Zero());
    std::size_t count = 0;
    for (const Vector3d& point : object.points)
      if (point.z() > kNearest_m) pixels[count++] = image_pixel(camera, point);
    return box_of(pixels.first(count));
  }
};

}  // namespace stillpoint
