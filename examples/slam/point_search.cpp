// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "point_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace examples::slam {

Projection project(const MapPoint& point, const Camera& camera, const Pose& camera_from_world, double oblique_cosine) {
  constexpr double kNearest_m = 0.1;
  constexpr int kOctaves = SpreadOrb::kLevels;
  Projection result;
  const Vector3d p_camera = camera_from_world * point.p_world;
  if (!(p_camera.z() > kNearest_m)) return result;
  result.pixel = camera.project(p_camera);
  const Vector2d in_image = camera.distort(result.pixel);
  if (!(in_image.x() >= 0 && in_image.y() >= 0 && in_image.x() < camera.width() && in_image.y() < camera.height()))
    return result;
  const double distance_m = p_camera.norm();
  const Vector3d to_camera = camera_from_world.linear().transpose() * (-p_camera / distance_m);
  if (!(to_camera.dot(point.normal) > oblique_cosine)) return result;
  const auto octave = static_cast<int>(std::lround(octave_at(point.scale_distance_m / distance_m)));
  if (octave < -1 || octave > kOctaves) return result;
  result.octave = std::clamp(octave, 0, kOctaves - 1);
  result.is_visible = true;
  return result;
}

void PointSearch::operator()(const Map& map, span<const PointId> points, const Camera& camera,
                             const Pose& camera_from_world, const Frame& frame, std::vector<PointMatch>& matches,
                             std::vector<PointId>* expected) const {
  std::vector<PointMatch> of_feature(frame.size());
  for (const PointId id : points) {
    const MapPoint& point = map.point(id);
    const Projection place = project(point, camera, camera_from_world, oblique_cosine);
    if (!place.is_visible) continue;
    if (expected != nullptr) expected->push_back(id);
    const double reach_px = window_px * octave_scale(place.octave);
    DescriptorMatch most_alike;
    frame.grid.near(place.pixel, reach_px, [&](int i) {
      const Vector2d offset = frame.pixel[static_cast<std::size_t>(i)] - place.pixel;
      if (std::abs(offset.x()) > reach_px || std::abs(offset.y()) > reach_px) return;
      const int octave = frame.octave(i);
      if (std::abs(octave - place.octave) > 1) return;
      most_alike.compare(i, octave, distance_bits(point.descriptor.data(), frame.descriptor(i)));
    });
    if (most_alike.bits > farthest_bits || most_alike.bits > second_best * most_alike.second_bits()) continue;
    PointMatch& match = of_feature[static_cast<std::size_t>(most_alike.feature)];
    if (match.point == kNone || most_alike.bits < match.bits) match = {id, most_alike.feature, most_alike.bits};
  }
  for (const PointMatch& match : of_feature)
    if (match.point != kNone) matches.push_back(match);
}

}  // namespace examples::slam
