// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "tracking.hpp"

#include <algorithm>
#include <utility>

#include "dynamic_features.hpp"

namespace examples::slam {

bool Tracking::locate(Frame& frame, Map& map, const MeasurementNoise& noise) {
  told_motion_.next_frame();
  const bool is_by_reference = last_points_.empty() && map.has(reference_);
  return locate_from(expected_camera_from_world(map), is_by_reference ? map.keyframe(reference_).point : last_points_,
                     frame, map, noise);
}

bool Tracking::locate_by(KeyframeId place, const Pose& camera_from_world, Frame& frame, Map& map,
                         const MeasurementNoise& noise) {
  if (!locate_from(camera_from_world, map.keyframe(place).point, frame, map, noise)) return false;
  ++misses_;  // it was lost: where it is found is no velocity
  return true;
}

Pose Tracking::expected_camera_from_world(const Map& map) const {
  return stillpoint::orthonormalized(expected_motion() * last_camera_from_world(map));
}

bool Tracking::locate_from(const Pose& camera_from_world, span<const PointId> seen, Frame& frame, Map& map,
                           const MeasurementNoise& noise) {
  local_ = points_around(map, seen);
  matches_.clear();
  options.search(map, local_, camera_, camera_from_world, frame, matches_);
  see(frame, map, matches_, noise);
  Pose pose = camera_from_world;
  if (!solve(observations_, camera_, pose, inlier_)) return false;
  frame.camera_from_world = pose;
  return refine(frame, map, local_, noise);
}

/// The pose is nearly right: more points are found, and false matches hardly any.
bool Tracking::refine(Frame& frame, Map& map, span<const PointId> local, const MeasurementNoise& noise) {
  const std::vector<PointMatch> wide = matches_;
  matches_.clear();
  std::vector<PointId> expected;
  options.refined_search(map, local, camera_, frame.camera_from_world, frame, matches_, &expected);
  see(frame, map, matches_, noise);
  Pose pose = frame.camera_from_world;
  if (solve.refine(observations_, camera_, pose, inlier_) < options.fewest) return false;
  frame.camera_from_world = pose;
  for (const PointId id : expected) ++map.point(id).visible;
  std::fill(frame.point.begin(), frame.point.end(), kNone);
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    ++map.point(matches_[i].point).found;
    if (inlier_[i] != 0) frame.point[static_cast<std::size_t>(matches_[i].feature)] = matches_[i].point;
  }
  frame.deviates.assign(frame.size(), 0);
  mark_deviating(frame, map, wide, noise);
  mark_deviating(frame, map, matches_, noise);
  return true;
}

/// It may be wrongly matched, too: then nothing is lost if it makes no point.
void Tracking::mark_deviating(Frame& frame, const Map& map, span<const PointMatch> matches,
                              const MeasurementNoise& noise) const {
  for (const PointMatch& match : matches) {
    const auto i = static_cast<std::size_t>(match.feature);
    if (frame.point[i] == kNone)
      frame.deviates[i] = deviates(map.point(match.point), frame, match.feature, camera_, noise);
  }
}

void Tracking::go_on_from(const Frame& frame, const Map& map, KeyframeId keyframe) {
  const Pose last = map.has(reference_) ? last_camera_from_world(map) : frame.camera_from_world;
  motion_ = misses_ > 0 ? Pose::Identity() : Pose(frame.camera_from_world * last.inverse());
  if (keyframe != kNone) {
    reference_ = keyframe;
  } else {
    const auto sharing = map.that_see(frame.point, 1);
    if (!sharing.empty()) reference_ = sharing.front().first;
  }
  camera_from_reference_ = frame.camera_from_world * map.keyframe(reference_).camera_from_world.inverse();
  last_points_ = keyframe != kNone ? map.keyframe(keyframe).point : frame.point;
  told_motion_.restart();
  misses_ = 0;
}

void Tracking::miss() {
  motion_ = Pose::Identity();
  ++misses_;
}

Pose Tracking::last_camera_from_world(const Map& map) const {
  if (!map.has(reference_)) return Pose::Identity();
  return stillpoint::orthonormalized(camera_from_reference_ * map.keyframe(reference_).camera_from_world);
}

/// As the filter says, or as it went on last. A velocity from few points is soon a mover's.
Pose Tracking::expected_motion() const { return told_motion_.since_pose().value_or(motion_); }

std::vector<PointId> Tracking::points_around(const Map& map, span<const PointId> seen) const {
  std::vector<KeyframeId> keyframes;
  for (const auto& [id, shared] : map.that_see(seen, options.fewest_shared)) {
    keyframes.push_back(id);
    if (keyframes.size() == options.local_keyframes) break;
  }
  if (keyframes.empty() && map.has(reference_)) keyframes.push_back(reference_);
  return map.points_of(keyframes);
}

void Tracking::see(const Frame& frame, const Map& map, span<const PointMatch> matches, const MeasurementNoise& noise) {
  observations_.clear();
  for (const PointMatch& match : matches) {
    const MapPoint& point = map.point(match.point);
    const auto i = static_cast<std::size_t>(match.feature);
    const double depth_m = frame.depth_m[i];
    const double pixel_sigma = noise.pixel_to_point(frame, match.feature, point.observations.size());
    observations_.push_back({point.p_world, frame.pixel[i], pixel_sigma, depth_m, noise.depth_m(depth_m),
                             point.sigma_m(), frame.features.weights[i], i});
  }
}

}  // namespace examples::slam
