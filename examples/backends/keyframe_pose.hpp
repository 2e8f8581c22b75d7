// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What small RGB-D odometries have in common, whatever their features: the pose of a frame from the points of the
// nearest keyframes, and which frames become keyframes. How a feature is found again is up to the caller.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "feature_depth.hpp"
#include "robust_pose.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "told_motion.hpp"

namespace examples {

/// A frame: its features and where they are. Where its camera stands is known once it is a keyframe.
template <class Features>
struct PointFrame {
  Features features;
  std::vector<Vector2d> pixel;       ///< of the features, undistorted
  std::vector<double> depth_m;       ///< of the features, 0 where there is none
  std::vector<double> lens_stretch;  ///< of the features, undistorted pixels to one of the image there
  Pose world_from_camera = Pose::Identity();
};

/// A feature of the current frame, found again in a keyframe.
struct FoundAgain {
  std::size_t feature;  ///< of the current frame
  Vector2d pixel;       ///< in the keyframe, undistorted
  double depth_m;       ///< in the keyframe
};

/// @tparam Features  has `keypoints`, cv::KeyPoint, and whatever finds them again
template <class Features>
class KeyframePose {
 public:
  using Frame = PointFrame<Features>;

  struct Options {
    std::size_t matched_keyframes = 4;
    std::size_t stored_keyframes = 20;  ///< where a lost camera is looked for
    double pixel_sigma = 0.7;           ///< of a feature that was found again
    double depth_sigma_factor = 3.0;    ///< times KinectNoise: depth and colour are not taken at the same moment
    DepthLimits depth_limits;
    double keyframe_share = 0.6;           ///< a new keyframe where the last explains less of the features with depth
    double keyframe_motion = 0.15;         ///< or the camera has moved this far: metres plus radians
    std::size_t fewest_for_velocity = 80;  ///< features that must have fitted for the own velocity to be believed
    int patience = 15;                     ///< frames without a pose; then it begins anew where it was lost
  };
  Options options;
  stillpoint::KinectNoise depth_noise;
  RobustPose solve;

  explicit KeyframePose(Camera camera) : camera_(std::move(camera)) {}

  const Camera& camera() const { return camera_; }

  /// What somebody else knows of the motion from the last frame to the coming one, such as the filter. Holds for that
  /// one, and is taken where the own velocity says little: the camera is lost, or few features fitted its last pose.
  void expect_motion(const Pose& current_from_last) { told_motion_.tell(current_from_last); }

  /// @param match  called as match(keyframe, current, camera_from_world, is_lost, found) and appends to `found`;
  ///               camera_from_world is the expected pose, which says nothing where the camera is lost
  /// @return world_from_camera. Nothing where too few features fit, or before a first frame with depth.
  template <class Match>
  std::optional<Pose> track(const stillpoint::FrameView& frame, Features features, Match&& match) {
    Frame current = prepare(frame, std::move(features));
    told_motion_.next_frame();
    if (keyframes_.empty()) return begin(std::move(current));
    Pose camera_from_world = stillpoint::orthonormalized(expected_motion() * camera_from_world_);
    const bool is_where_expected = solve_near(current, match, camera_from_world);
    if (!is_where_expected && !relocalize(current, match, camera_from_world)) {
      motion_ = Pose::Identity();
      if (++misses_ <= options.patience) return std::nullopt;
      keyframes_.clear();
      return begin(std::move(current));
    }
    // Where it was lost, where it is found is no velocity.
    const bool has_velocity = is_where_expected && misses_ == 0;
    motion_ = has_velocity ? camera_from_world * camera_from_world_.inverse() : Pose::Identity();
    count_from_here(has_velocity ? solve.fitting() : 0);
    camera_from_world_ = camera_from_world;
    current.world_from_camera = camera_from_world.inverse();
    const Pose world_from_camera = current.world_from_camera;
    if (wants_keyframe(current)) remember(std::move(current));
    return world_from_camera;
  }

 private:
  Frame prepare(const stillpoint::FrameView& frame, Features&& features) const {
    Frame current;
    current.features = std::move(features);
    for (const cv::KeyPoint& keypoint : current.features.keypoints) {
      current.pixel.push_back(camera_.undistort({keypoint.pt.x, keypoint.pt.y}));
      current.depth_m.push_back(depth_at(frame, keypoint.pt, options.depth_limits));
      current.lens_stretch.push_back(stillpoint::lens_stretch(camera_, current.pixel.back()));
    }
    return current;
  }

  std::optional<Pose> begin(Frame&& current) {
    if (count_depths(current) < solve.options.fewest) return std::nullopt;
    current.world_from_camera = camera_from_world_.inverse();
    count_from_here(0);
    remember(std::move(current));
    return keyframes_.back().world_from_camera;
  }

  /// There is a pose.
  void count_from_here(std::size_t fitted) {
    misses_ = 0;
    fitted_ = fitted;
    told_motion_.restart();
  }

  /// Since the last pose.
  const Pose& expected_motion() const {
    const bool has_velocity = misses_ == 0 && fitted_ >= options.fewest_for_velocity;
    return told_motion_.since_pose() && !has_velocity ? *told_motion_.since_pose() : motion_;
  }

  double depth_sigma(double depth_m) const { return options.depth_sigma_factor * depth_noise.sigma(depth_m); }

  template <class Match>
  void see(const Frame& current, const Frame& keyframe, const Match& match, const Pose& camera_from_world,
           bool is_lost) {
    found_.clear();
    match(keyframe, current, camera_from_world, is_lost, found_);
    for (const FoundAgain& there : found_) {
      const Vector3d p_keyframe = camera_.back_project(there.pixel, there.depth_m);
      const Vector3d p_keyframe_sigma_m = p_keyframe * (depth_sigma(there.depth_m) / there.depth_m);
      const double depth_m = current.depth_m[there.feature];
      observations_.push_back({keyframe.world_from_camera * p_keyframe, current.pixel[there.feature],
                               options.pixel_sigma * current.lens_stretch[there.feature], depth_m, depth_sigma(depth_m),
                               keyframe.world_from_camera.linear() * p_keyframe_sigma_m,
                               current.features.weights[there.feature], there.feature});
      source_.push_back(&keyframe);
    }
  }

  void forget_observations() {
    observations_.clear();
    source_.clear();
  }

  /// The pose from the keyframes that are nearest to the expected one.
  template <class Match>
  bool solve_near(const Frame& current, const Match& match, Pose& camera_from_world) {
    const Pose world_from_camera = camera_from_world.inverse();
    std::vector<std::pair<double, const Frame*>> nearest;
    for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe)
      nearest.emplace_back(distance(world_from_camera, keyframe->world_from_camera), &*keyframe);
    std::stable_sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    forget_observations();
    for (std::size_t i = 0; i < std::min(nearest.size(), options.matched_keyframes); ++i)
      see(current, *nearest[i].second, match, camera_from_world, false);
    return solve(observations_, camera_, camera_from_world, inlier_);
  }

  /// The pose from nothing but likeness: the latest keyframe that gives one, if the nearest ones then agree.
  template <class Match>
  bool relocalize(const Frame& current, const Match& match, Pose& camera_from_world) {
    for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe) {
      forget_observations();
      see(current, *keyframe, match, camera_from_world, true);
      Pose candidate = camera_from_world;
      if (!solve(observations_, camera_, candidate, inlier_) || !solve_near(current, match, candidate)) continue;
      camera_from_world = candidate;
      return true;
    }
    return false;
  }

  bool wants_keyframe(const Frame& current) const {
    const Frame& last = keyframes_.back();
    std::size_t explained = 0;  // a feature is found once in a keyframe
    for (std::size_t i = 0; i < source_.size(); ++i) explained += inlier_[i] != 0 && source_[i] == &last;
    return distance(last.world_from_camera, current.world_from_camera) > options.keyframe_motion ||
           static_cast<double>(explained) < options.keyframe_share * static_cast<double>(count_depths(current));
  }

  void remember(Frame&& keyframe) {
    keyframes_.push_back(std::move(keyframe));
    if (keyframes_.size() > options.stored_keyframes) keyframes_.pop_front();
  }

  Camera camera_;
  std::deque<Frame> keyframes_;
  std::vector<FoundAgain> found_;
  std::vector<PointObservation> observations_;
  std::vector<const Frame*> source_;  ///< which keyframe each observation's point is from
  std::vector<std::uint8_t> inlier_;
  Pose camera_from_world_ = Pose::Identity();
  Pose motion_ = Pose::Identity();  ///< current_from_last, of the last two frames with a pose
  ToldMotion told_motion_;
  std::size_t fitted_ = 0;  ///< features that fitted the last pose
  int misses_ = 0;          ///< frames in a row without a pose
};

}  // namespace examples
