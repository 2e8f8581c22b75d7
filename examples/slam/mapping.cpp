// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "mapping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bundle_adjustment.hpp"
#include "stillpoint/motion/epipolar/triangulation.hpp"

namespace examples::slam {

KeyframeId Mapping::insert(Frame frame, Map& map) const {
  const KeyframeId id = map.add(std::move(frame));
  add_points_by_depth(id, map);
  return id;
}

void Mapping::connect(KeyframeId id, Map& map) const {
  fuse(id, map);
  add_points_by_two_views(id, map);
  for (const PointId seen : map.points_of({&id, 1})) map.describe(seen);
}

std::vector<KeyframeId> Mapping::neighbours(KeyframeId id, const Map& map) const {
  std::vector<KeyframeId> result = map.with_neighbours(id, options.fewest_shared, options.neighbours);
  result.erase(result.begin());
  return result;
}

/// Not those that deviate: a moving object makes a new point wherever it has come to, and all of them together drag the
/// pose along.
void Mapping::add_points_by_depth(KeyframeId id, Map& map) const {
  const Keyframe& keyframe = map.keyframe(id);
  const Pose world_from_camera = keyframe.camera_from_world.inverse();
  for (std::size_t i = 0; i < keyframe.size(); ++i) {
    const double depth_m = keyframe.depth_m[i];
    if (keyframe.point[i] != kNone || !(depth_m > 0) || keyframe.is_deviating(i)) continue;
    const Vector3d p_camera = camera_.back_project(keyframe.pixel[i], depth_m);
    const Vector3d ray_sigma_m = world_from_camera.linear() * (p_camera * (noise_.depth_m(depth_m) / depth_m));
    map.add_point(id, static_cast<int>(i), world_from_camera * p_camera, ray_sigma_m);
  }
}

/// Features without depth, by another keyframe that has one like it on its epipolar line.
void Mapping::add_points_by_two_views(KeyframeId id, Map& map) const {
  for (const KeyframeId other_id : neighbours(id, map)) {
    const Keyframe& keyframe = map.keyframe(id);
    const Keyframe& other = map.keyframe(other_id);
    const Pose other_from_keyframe = other.camera_from_world * keyframe.camera_from_world.inverse();
    for (std::size_t i = 0; i < keyframe.size(); ++i) {
      if (keyframe.point[i] != kNone || keyframe.depth_m[i] > 0 || keyframe.is_deviating(i)) continue;
      const int feature = static_cast<int>(i);
      const int twin = most_alike(keyframe, feature, other, other_from_keyframe);
      if (twin == kNone) continue;
      const Vector3d ray = camera_.back_project(keyframe.pixel[i], 1.0);
      const Vector3d other_ray = camera_.back_project(other.pixel[static_cast<std::size_t>(twin)], 1.0);
      const stillpoint::RayDepths depths = stillpoint::triangulate(other_from_keyframe, ray, other_ray);
      const double parallax_rad = std::acos(
          std::clamp((other_from_keyframe.linear() * ray).normalized().dot(other_ray.normalized()), -1.0, 1.0));
      if (!depths.in_front() || !(parallax_rad > options.least_parallax_rad)) continue;
      MapPoint candidate;
      candidate.p_world = keyframe.camera_from_world.inverse() * (ray * depths.reference);
      if (!fits(candidate, keyframe, feature) || !fits(candidate, other, twin)) continue;
      const double sigma_m = depths.reference * noise_.pixel(keyframe, feature) / camera_.fx() / parallax_rad;
      const Vector3d ray_sigma_m = keyframe.camera_from_world.linear().transpose() * (ray * sigma_m);
      const PointId made = map.add_point(id, feature, candidate.p_world, ray_sigma_m);
      map.add_observation(made, other_id, twin);
    }
  }
}

/// The feature of another keyframe that is most like one of this, on its epipolar line; kNone if there is none, or two.
int Mapping::most_alike(const Keyframe& keyframe, int feature, const Keyframe& other,
                        const Pose& other_from_keyframe) const {
  const Vector3d ray = camera_.back_project(keyframe.pixel[static_cast<std::size_t>(feature)], 1.0);
  const Vector3d plane = other_from_keyframe.translation().cross(other_from_keyframe.linear() * ray);
  int best = kNone, bits = kDescriptorBits, second_bits = kDescriptorBits;
  for (std::size_t j = 0; j < other.size(); ++j) {
    const int twin = static_cast<int>(j);
    if (other.point[j] != kNone || other.depth_m[j] > 0) continue;
    if (std::abs(other.octave(twin) - keyframe.octave(feature)) > 1) continue;
    const Vector3d there = camera_.back_project(other.pixel[j], 1.0);
    const double off_line_px = std::abs(plane.dot(there)) / plane.head<2>().norm() * camera_.fx();
    if (!(off_line_px < 2.0 * noise_.pixel(other, twin))) continue;
    const int difference = distance_bits(keyframe.descriptor(feature), other.descriptor(twin));
    if (difference < bits) {
      second_bits = std::exchange(bits, difference);
      best = twin;
    } else {
      second_bits = std::min(second_bits, difference);
    }
  }
  return bits <= options.farthest_bits && bits < options.second_best * second_bits ? best : kNone;
}

/// Whether a feature may show a point: by the noise of its pixel and its depth, and by that of the point.
bool Mapping::fits(const MapPoint& point, const Keyframe& keyframe, int feature) const {
  const auto i = static_cast<std::size_t>(feature);
  const Vector3d p = keyframe.camera_from_world * point.p_world;
  if (!(p.z() > 0.1)) return false;
  const double pixel_sigma = noise_.pixel_to_point(keyframe, feature, point.observations.size());
  const double pixel_error = (camera_.project(p) - keyframe.pixel[i]).norm() / pixel_sigma;
  const double depth_m = keyframe.depth_m[i];
  if (!(depth_m > 0)) return pixel_error * pixel_error < chi_squared_limit(false);
  const double of_point_m = (keyframe.camera_from_world.linear() * point.sigma_m()).z();
  const double depth_error = (p.z() - depth_m) / std::hypot(noise_.depth_m(depth_m), of_point_m);
  return pixel_error * pixel_error + depth_error * depth_error < chi_squared_limit(true);
}

/// Points of the neighbours are looked for in the keyframe, and its own in the neighbours.
void Mapping::fuse(KeyframeId id, Map& map) const {
  const std::vector<KeyframeId> others = neighbours(id, map);
  fuse_into(id, map.points_of(others), map);
  for (const KeyframeId other : others) fuse_into(other, map.points_of({&id, 1}), map);
}

void Mapping::fuse_into(KeyframeId id, const std::vector<PointId>& points, Map& map) const {
  std::vector<PointId> unnamed;
  for (const PointId point : points)
    if (map.has_point(point) && map.point(point).observation_in(id) == kNone) unnamed.push_back(point);
  std::vector<PointMatch> matches;
  const Keyframe& keyframe = map.keyframe(id);
  options.fuse(map, unnamed, camera_, keyframe.camera_from_world, keyframe, matches);
  for (const PointMatch& match : matches) {
    if (!map.has_point(match.point) || !fits(map.point(match.point), keyframe, match.feature)) continue;
    const PointId named = keyframe.point[static_cast<std::size_t>(match.feature)];
    if (named == kNone)
      map.add_observation(match.point, id, match.feature);
    else if (map.point(named).observations.size() < map.point(match.point).observations.size())
      map.merge(named, match.point);
    else
      map.merge(match.point, named);
  }
}

void Mapping::cull_points(KeyframeId newest, Map& map) const {
  for (PointId id = 0; id < map.point_ids(); ++id) {
    if (!map.has_point(id)) continue;
    const MapPoint& point = map.point(id);
    const bool is_found = point.found >= options.least_found_share * point.visible;
    const bool is_on_trial = newest - point.made_by < options.trial_keyframes;
    if (!is_found || (!is_on_trial && point.observations.size() < 2)) map.remove(id);
  }
}

std::vector<CulledKeyframe> Mapping::cull_keyframes(KeyframeId newest, KeyframeId in_use, Map& map) const {
  constexpr KeyframeId kFirst = 0;  // where the world is
  constexpr int kLatest = 3;        // tracking stands on them
  constexpr std::size_t kOthers = 3;
  std::vector<CulledKeyframe> culled;
  for (const auto& [id, shared] : map.covisible(newest, options.fewest_shared)) {
    if (id == kFirst || id == in_use || newest - id < kLatest) continue;
    int seen = 0, seen_by_others = 0;
    for (const PointId point : map.keyframe(id).point) {
      if (point == kNone) continue;
      ++seen;
      seen_by_others += map.point(point).observations.size() > kOthers;
    }
    if (seen_by_others <= options.redundant_share * seen) continue;
    const KeyframeId kept = map.covisible(id, 1).front().first;
    culled.push_back({id, kept, map.keyframe(id).camera_from_world * map.keyframe(kept).camera_from_world.inverse()});
    map.remove_keyframe(id);
  }
  return culled;
}

}  // namespace examples::slam
