// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "slam.hpp"

#include <mutex>
#include <utility>

#include "map_ply.hpp"

namespace examples::slam {

Slam::Slam(Camera camera, const SlamOptions& settings)
    : options(settings),
      tracking(camera),
      find_dynamic(camera),
      camera_(camera),
      orb_(settings.orb),
      keeper_(std::make_unique<MapKeeper>(camera, settings.noise, !settings.maps_in_step)) {
  keeper_->compares_views = settings.uses_multi_view;
  keeper_->multi_view.options.adjusts = settings.uses_bundle;
  keeper_->loop_closing.options.closes = settings.uses_loops;
  keeper_->loop_closing.options.compares_objects = settings.uses_objects;
}

OrbFeatures Slam::extract(const stillpoint::FrameView& frame) {
  OrbFeatures features = orb_.extract(frame);
  extracted_ = {features.keypoints, finds_dynamic() ? features.descriptors.clone() : cv::Mat(), {}};
  is_dynamic_.assign(features.keypoints.size(), 0);
  return features;
}

void Slam::expect_detections(stillpoint::span<const stillpoint::Detection> detections) {
  objects_.clear();
  for (const stillpoint::Detection& seen : detections) {
    if (seen.mobility != stillpoint::Mobility::fixed && seen.mobility != stillpoint::Mobility::movable) continue;
    const auto u = static_cast<double>(seen.box.x + seen.box.width / 2);
    const auto v = static_cast<double>(seen.box.y + seen.box.height / 2);
    objects_.push_back({seen.class_index, u / camera_.width(), v / camera_.height()});
  }
}

std::optional<Pose> Slam::track(const stillpoint::FrameView& view, const OrbFeatures& features) {
  orb_.look_past(extracted_.keypoints, features.keypoints);
  Frame frame = prepare(view, features);
  std::unique_lock<std::mutex> lock(keeper_->mutex);
  Map& map = keeper_->map;
  const bool is_first = map.empty();
  bool is_new_beginning = is_first;
  if (!is_first && !locate(frame)) {
    frame.camera_from_world = tracking.expected_camera_from_world(map);
    tracking.miss();
    is_new_beginning = tracking.misses() > options.patience;
    if (!is_new_beginning) return std::nullopt;
  }
  if (is_new_beginning && count_depths(frame) < options.fewest_to_begin) return std::nullopt;
  KeyframeId keyframe = kNone;
  if (is_new_beginning || wants_keyframe(frame)) keyframe = keeper_->mapping.insert(frame, map);
  if (finds_dynamic() && !is_new_beginning) {
    Frame all = prepare(view, extracted_);
    all.camera_from_world = frame.camera_from_world;
    is_dynamic_ = find_dynamic(all, map, tracking.local_points(), options.noise);
  }
  tracking.go_on_from(frame, map, keyframe);
  const KeyframeId reference = keeper_->in_use = tracking.reference();
  keeper_->path.add(view.timestamp_s, reference,
                    frame.camera_from_world * map.keyframe(reference).camera_from_world.inverse());
  lock.unlock();
  if (keyframe != kNone) keeper_->add(keyframe);
  return frame.camera_from_world.inverse();
}

/// Where it is expected, or anywhere.
bool Slam::locate(Frame& frame) {
  Map& map = keeper_->map;
  if (tracking.locate(frame, map, options.noise)) return true;
  const std::optional<Recognised> found = keeper_->loop_closing.relocalise(frame, map);
  return found && tracking.locate_by(found->loop.place, found->camera_from_world, frame, map, options.noise);
}

stillpoint::Trajectory Slam::trajectory() {
  keeper_->finish();
  const std::lock_guard<std::mutex> lock(keeper_->mutex);
  return keeper_->path.trajectory(keeper_->map);
}

std::string Slam::map_ply() {
  keeper_->finish();
  const std::lock_guard<std::mutex> lock(keeper_->mutex);
  return map_as_ply(keeper_->map, camera_);
}

std::string Slam::map_ply_before_loop() {
  keeper_->finish();
  const std::lock_guard<std::mutex> lock(keeper_->mutex);
  return keeper_->before_loop;
}

Frame Slam::prepare(const stillpoint::FrameView& view, const OrbFeatures& features) {
  Frame frame;
  frame.timestamp_s = view.timestamp_s;
  frame.features = {features.keypoints, features.descriptors.clone(), features.weights};
  frame.objects = std::exchange(objects_, {});
  frame.point.assign(features.keypoints.size(), kNone);
  const bool has_lens = !has_no_lens(camera_.distortion());
  for (const cv::KeyPoint& keypoint : features.keypoints) {
    frame.pixel.push_back(camera_.undistort({keypoint.pt.x, keypoint.pt.y}));
    if (has_lens) frame.lens_stretch.push_back(stillpoint::lens_stretch(camera_, frame.pixel.back()));
    frame.depth_m.push_back(depth_at(view, keypoint.pt, options.depth_limits));
    const int u = cvRound(keypoint.pt.x), v = cvRound(keypoint.pt.y);
    if (!view.colour.empty()) {
      const std::uint8_t* bgr = view.colour.row<std::uint8_t>(v) + 3 * u;
      frame.colour.emplace_back(bgr[0], bgr[1], bgr[2]);
    } else {
      const std::uint8_t gray = view.gray.row<std::uint8_t>(v)[u];
      frame.colour.emplace_back(gray, gray, gray);
    }
  }
  frame.grid = FeatureGrid(frame.pixel, camera_.width(), camera_.height());
  return frame;
}

bool Slam::wants_keyframe(const Frame& frame) const {
  if (keeper_->waiting() > options.most_waiting) return false;
  const Map& map = keeper_->map;
  const Pose last_from_camera = map.keyframe(map.last_keyframe()).camera_from_world * frame.camera_from_world.inverse();
  if (distance(last_from_camera, Pose::Identity()) > options.keyframe_motion) return true;
  return explained_share(frame) < options.keyframe_share;
}

}  // namespace examples::slam
