// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "map.hpp"

#include <algorithm>
#include <limits>

namespace examples::slam {

KeyframeId Map::add(Frame frame) {
  const KeyframeId id = next_keyframe_++;
  Keyframe& keyframe = keyframes_[id];
  static_cast<Frame&>(keyframe) = std::move(frame);
  keyframe.id = id;
  for (std::size_t i = 0; i < keyframe.size(); ++i) {
    const PointId seen = std::exchange(keyframe.point[i], kNone);
    if (has_point(seen)) add_observation(seen, id, static_cast<int>(i));
  }
  return id;
}

PointId Map::add_point(KeyframeId keyframe, int feature, const Vector3d& p_world, const Vector3d& ray_sigma_m) {
  PointId id = kNone;
  if (free_.empty()) {
    id = static_cast<PointId>(points_.size());
    points_.emplace_back();
  } else {
    id = free_.back();
    free_.pop_back();
  }
  MapPoint& made = point(id);
  made = MapPoint{};
  made.p_world = p_world;
  made.ray_sigma_m = ray_sigma_m;
  made.made_by = keyframe;
  const Pose& camera_from_world = this->keyframe(keyframe).camera_from_world;
  made.first = {keyframe, camera_from_world * p_world, camera_from_world.linear() * ray_sigma_m};
  made.visible = made.found = 1;
  made.colour = this->keyframe(keyframe).colour[static_cast<std::size_t>(feature)];
  made.exists = true;
  add_observation(id, keyframe, feature);
  describe(id);
  return id;
}

void Map::add_observation(PointId id, KeyframeId keyframe_id, int feature) {
  MapPoint& seen = point(id);
  PointId& named = keyframe(keyframe_id).point[static_cast<std::size_t>(feature)];
  if (named != kNone || seen.observation_in(keyframe_id) != kNone) return;
  named = id;
  const auto place = std::lower_bound(seen.observations.begin(), seen.observations.end(), keyframe_id,
                                      [](const Observation& a, KeyframeId b) { return a.keyframe < b; });
  seen.observations.insert(place, {keyframe_id, feature});
}

void Map::remove_observation(PointId id, KeyframeId keyframe_id) {
  MapPoint& seen = point(id);
  const auto place = std::find_if(seen.observations.begin(), seen.observations.end(),
                                  [&](const Observation& a) { return a.keyframe == keyframe_id; });
  if (place == seen.observations.end()) return;
  keyframe(keyframe_id).point[static_cast<std::size_t>(place->feature)] = kNone;
  seen.observations.erase(place);
  if (seen.observations.empty()) remove(id);
}

void Map::remove(PointId id) {
  MapPoint& gone = point(id);
  if (!gone.exists) return;
  for (const Observation& seen : gone.observations)
    keyframe(seen.keyframe).point[static_cast<std::size_t>(seen.feature)] = kNone;
  gone = MapPoint{};
  free_.push_back(id);
}

void Map::merge(PointId gone_id, PointId kept_id) {
  if (gone_id == kept_id) return;
  const std::vector<Observation> seen = point(gone_id).observations;
  const int visible = point(gone_id).visible, found = point(gone_id).found;
  if (point(gone_id).made_by < point(kept_id).made_by) {
    point(kept_id).first = point(gone_id).first;
    point(kept_id).made_by = point(gone_id).made_by;
  }
  remove(gone_id);
  for (const Observation& observation : seen) add_observation(kept_id, observation.keyframe, observation.feature);
  point(kept_id).visible += visible;
  point(kept_id).found += found;
  describe(kept_id);
}

void Map::remove_keyframe(KeyframeId id) {
  const std::vector<PointId> named = keyframe(id).point;
  for (const PointId seen : named)
    if (has_point(seen)) remove_observation(seen, id);
  for (MapPoint& point : points_) {
    if (!point.exists || point.first.keyframe != id) continue;
    const KeyframeId other = point.observations.front().keyframe;
    const Pose other_from_gone = keyframe(other).camera_from_world * keyframe(id).camera_from_world.inverse();
    point.first = {other, other_from_gone * point.first.p_camera, other_from_gone.linear() * point.first.ray_sigma_m};
  }
  keyframes_.erase(id);
}

std::vector<std::pair<KeyframeId, int>> Map::that_see(stillpoint::span<const PointId> points, int fewest) const {
  std::map<KeyframeId, int> shared;
  for (const PointId id : points)
    if (has_point(id))
      for (const Observation& seen : point(id).observations) ++shared[seen.keyframe];
  std::vector<std::pair<KeyframeId, int>> result;
  for (const auto& entry : shared)
    if (entry.second >= fewest) result.push_back(entry);
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return result;
}

std::vector<KeyframeId> Map::with_neighbours(KeyframeId id, int fewest, std::size_t most) const {
  std::vector<KeyframeId> result = {id};
  for (const auto& [other, shared] : covisible(id, fewest)) {
    if (result.size() > most) break;
    result.push_back(other);
  }
  return result;
}

std::vector<std::pair<KeyframeId, int>> Map::covisible(KeyframeId id, int fewest) const {
  std::vector<std::pair<KeyframeId, int>> result = that_see(keyframe(id).point, fewest);
  result.erase(std::remove_if(result.begin(), result.end(), [id](const auto& a) { return a.first == id; }),
               result.end());
  return result;
}

std::vector<PointId> Map::points_of(stillpoint::span<const KeyframeId> ids) const {
  std::vector<PointId> result;
  for (const KeyframeId id : ids)
    for (const PointId seen : keyframe(id).point)
      if (has_point(seen)) result.push_back(seen);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void Map::describe(PointId id) {
  MapPoint& described = point(id);
  std::vector<const std::uint8_t*> rows;
  Vector3d normal = Vector3d::Zero();
  for (const Observation& seen : described.observations) {
    const Keyframe& by = keyframe(seen.keyframe);
    rows.push_back(by.descriptor(seen.feature));
    const Vector3d to_camera = by.camera_from_world.inverse().translation() - described.p_world;
    normal += to_camera.normalized();
  }
  if (rows.empty()) return;
  described.normal = normal.normalized();
  const Observation& first = described.observations.front();
  const Keyframe& by = keyframe(first.keyframe);
  described.scale_distance_m =
      (by.camera_from_world * described.p_world).norm() * octave_scale(by.octave(first.feature));
  int least = std::numeric_limits<int>::max();
  for (const std::uint8_t* candidate : rows) {
    int sum = 0;
    for (const std::uint8_t* other : rows) sum += distance_bits(candidate, other);
    if (sum >= least) continue;
    least = sum;
    described.descriptor = descriptor_from(candidate);
  }
}

}  // namespace examples::slam
