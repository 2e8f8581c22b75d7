// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small RGB-D odometry: each frame's ORB corners are found again in the nearest keyframes by Lucas-Kanade; the
// keyframes' depth makes points of them, and the pose is solved from the points. A lost camera is looked for in all
// keyframes by descriptors. No map, no loop closing.

#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "keyframe.hpp"
#include "optical_flow.hpp"
#include "pose_refinement.hpp"
#include "robust_pose.hpp"
#include "stillpoint/core/depth_noise.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// A backend of `FilteredTracker`. The world is the camera of the first frame that is tracked. Equal frames give equal
/// bytes: nothing in it is drawn from a shared generator (solvePnPRansac seeds its own on every call).
class RgbdOdometry {
 public:
  struct Options {
    int features = 1000;
    int window_px = 11;                ///< of Lucas-Kanade: the prediction is good, so that a small one will do
    int pyramid_levels = 1;            ///< above the image itself
    float forward_backward_px = 1.0f;  ///< a match that does not come back this near is none
    std::size_t matched_keyframes = 3;
    std::size_t stored_keyframes = 20;  ///< where a lost camera is looked for
    double pixel_sigma = 0.5;           ///< of a Lucas-Kanade match
    double depth_sigma_factor = 3.0;    ///< times KinectNoise: depth and colour are not taken at the same moment
    DepthLimits depth_limits;
    double reprojection_px = 3.0;      ///< inlier limit of RANSAC
    std::size_t fewest_features = 12;  ///< fewer that fit are no pose
    double fewest_share = 0.3;         ///< of the features that were found again: fewer that fit are no pose
    double expected_share = 0.3;       ///< of what fits the best pose: one near the expected pose is kept down to it
    double keyframe_share = 0.6;       ///< a new keyframe where the last explains less of the features with depth
    double keyframe_motion = 0.15;     ///< or the camera has moved this far: metres plus radians
  };
  Options options;
  stillpoint::KinectNoise depth_noise;
  PoseRefinement refine;

  explicit RgbdOdometry(Camera camera) : RgbdOdometry(std::move(camera), Options{}) {}
  RgbdOdometry(Camera camera, const Options& settings)
      : options(settings), camera_(std::move(camera)), orb_(cv::ORB::create(settings.features)) {}

  OrbFeatures extract(const stillpoint::FrameView& frame) {
    OrbFeatures features;
    orb_->detectAndCompute(gray_of(frame), cv::noArray(), features.keypoints, features.descriptors);
    return features;
  }

  /// @return world_from_camera. Nothing where too few features fit, or before a first frame with depth; the next frames
  ///         are compared with the same keyframes again.
  std::optional<Pose> track(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    Keyframe current = prepare(frame, features);
    if (keyframes_.empty()) {
      if (count_depths(current) < options.fewest_features) return std::nullopt;
      remember(std::move(current));
      return camera_from_world_.inverse();
    }
    Pose camera_from_world = stillpoint::orthonormalized(motion_ * camera_from_world_);
    if (!solve_by_flow(current, camera_from_world) && !relocalize(current, camera_from_world)) {
      motion_ = Pose::Identity();
      lost_ = true;
      return std::nullopt;
    }
    motion_ = lost_ ? Pose::Identity() : stillpoint::orthonormalized(camera_from_world * camera_from_world_.inverse());
    lost_ = false;
    camera_from_world_ = camera_from_world;
    current.world_from_camera = camera_from_world.inverse();
    if (wants_keyframe(current)) remember(std::move(current));
    return camera_from_world.inverse();
  }

 private:
  /// Where a sighting comes from: a feature of the current frame, found in a keyframe.
  struct Source {
    std::size_t feature;
    const Keyframe* keyframe;
  };

  cv::Size window() const { return {options.window_px, options.window_px}; }

  cv::Mat gray_of(const stillpoint::FrameView& frame) {
    return stillpoint::as_mat(stillpoint::with_gray(frame, gray_).gray);
  }

  /// Everything a keyframe needs, copied: the frame's views may die.
  Keyframe prepare(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    Keyframe current;
    current.features = {features.keypoints, features.descriptors.clone(), features.weights};
    cv::buildOpticalFlowPyramid(gray_of(frame), current.pyramid, window(), options.pyramid_levels, true,
                                cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
    current.depth.assign(frame.depth.image);
    current.depth_factor = frame.depth.factor;
    for (const cv::KeyPoint& keypoint : features.keypoints)
      current.depth_m.push_back(depth_at(current, keypoint.pt, options.depth_limits));
    return current;
  }

  double depth_sigma(double depth_m) const { return options.depth_sigma_factor * depth_noise.sigma(depth_m); }

  Vector3d point(const cv::Point2f& pixel, double depth_m) const {
    return camera_.back_project(camera_.undistort({pixel.x, pixel.y}), depth_m);
  }

  void forget_sightings() {
    sightings_.clear();
    sources_.clear();
  }

  void add_sighting(const Keyframe& current, std::size_t feature, const Keyframe& keyframe, const cv::Point2f& there) {
    const double depth_there_m = depth_at(keyframe, there, options.depth_limits);
    if (!(depth_there_m > 0)) return;
    const cv::Point2f& here = current.features.keypoints[feature].pt;
    const double depth_m = current.depth_m[feature];
    const Vector3d p_keyframe = point(there, depth_there_m);
    const Vector3d p_keyframe_sigma_m = p_keyframe * (depth_sigma(depth_there_m) / depth_there_m);
    sightings_.push_back({keyframe.world_from_camera * p_keyframe, camera_.undistort({here.x, here.y}),
                          options.pixel_sigma, depth_m, depth_sigma(depth_m),
                          keyframe.world_from_camera.linear() * p_keyframe_sigma_m, current.features.weights[feature]});
    sources_.push_back({feature, &keyframe});
  }

  /// The pose from the keyframes that are nearest to the predicted one.
  bool solve_by_flow(const Keyframe& current, Pose& camera_from_world) {
    const Pose world_from_camera = camera_from_world.inverse();
    std::vector<std::pair<double, const Keyframe*>> nearest;
    for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe)
      nearest.emplace_back(distance(world_from_camera, keyframe->world_from_camera), &*keyframe);
    std::stable_sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    forget_sightings();
    for (std::size_t i = 0; i < std::min(nearest.size(), options.matched_keyframes); ++i)
      match_by_flow(current, camera_from_world, *nearest[i].second);
    return solve(current, camera_from_world);
  }

  /// The pose from nothing but descriptors: the latest keyframe that gives one, if Lucas-Kanade then agrees.
  bool relocalize(const Keyframe& current, Pose& camera_from_world) {
    for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe) {
      match_by_descriptor(current, *keyframe);
      Pose candidate = camera_from_world;
      if (!solve(current, candidate) || !solve_by_flow(current, candidate)) continue;
      camera_from_world = candidate;
      return true;
    }
    return false;
  }

  void match_by_flow(const Keyframe& current, const Pose& camera_from_world, const Keyframe& keyframe) {
    constexpr double kUsualDepth_m = 2.0;  // where there is none: it only begins the search
    const Pose keyframe_from_camera = (camera_from_world * keyframe.world_from_camera).inverse();
    std::vector<cv::Point2f> here, there;
    std::vector<std::size_t> feature;
    for (std::size_t i = 0; i < current.depth_m.size(); ++i) {
      const cv::Point2f& pixel = current.features.keypoints[i].pt;
      const double depth_m = current.depth_m[i] > 0 ? current.depth_m[i] : kUsualDepth_m;
      const Vector3d p_keyframe = keyframe_from_camera * point(pixel, depth_m);
      if (!(p_keyframe.z() > 0.1)) continue;
      const Vector2d guess = camera_.distort(camera_.project(p_keyframe));
      if (!(guess.x() > 0 && guess.y() > 0 && guess.x() < camera_.width() - 1 && guess.y() < camera_.height() - 1))
        continue;
      here.push_back(pixel);
      there.emplace_back(static_cast<float>(guess.x()), static_cast<float>(guess.y()));
      feature.push_back(i);
    }
    if (here.empty()) return;
    std::vector<cv::Point2f> back = here;
    const std::vector<std::uint8_t> found = follow(current.pyramid, keyframe.pyramid, here, there);
    const std::vector<std::uint8_t> found_back = follow(keyframe.pyramid, current.pyramid, there, back);
    for (std::size_t i = 0; i < here.size(); ++i)
      if (found[i] && found_back[i] && cv::norm(back[i] - here[i]) < options.forward_backward_px)
        add_sighting(current, feature[i], keyframe, there[i]);
  }

  std::vector<std::uint8_t> follow(const std::vector<cv::Mat>& from_image, const std::vector<cv::Mat>& to_image,
                                   const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>& to) const {
    constexpr int kIterations = 20;
    return flow(from_image, to_image, from, to, options.window_px, options.pyramid_levels, kIterations);
  }

  /// Finds the features by their descriptors, anywhere in a keyframe: when no prediction helps.
  void match_by_descriptor(const Keyframe& current, const Keyframe& keyframe) {
    constexpr float kFarthest = 64.0f, kRatio = 0.8f;  // of 256 bits; to the second best (Lowe, 2004)
    forget_sightings();
    if (current.features.keypoints.empty() || keyframe.features.keypoints.empty()) return;
    std::vector<std::vector<cv::DMatch>> matches;
    cv::BFMatcher(cv::NORM_HAMMING).knnMatch(current.features.descriptors, keyframe.features.descriptors, matches, 2);
    for (const std::vector<cv::DMatch>& best : matches)
      if (best.size() == 2 && best[0].distance < kFarthest && best[0].distance < kRatio * best[1].distance)
        add_sighting(current, static_cast<std::size_t>(best[0].queryIdx), keyframe,
                     keyframe.features.keypoints[static_cast<std::size_t>(best[0].trainIdx)].pt);
  }

  /// RANSAC, then refinement. Changes the pose only when enough features fit.
  bool solve(const Keyframe& current, Pose& camera_from_world) {
    constexpr int kIterations = 200;
    constexpr double kConfidence = 0.999;
    if (sightings_.size() < options.fewest_features) return false;
    Pose solution = Pose::Identity();
    if (!pose_by_ransac(sightings_, camera_, options.reprojection_px, kIterations, kConfidence, solution)) return false;
    refine(sightings_, camera_, solution, inlier_);
    double fitting = static_cast<double>(count_fitting(current, nullptr));
    // The world and a mover may both explain many features: near the expected pose lies the world.
    Pose expected = camera_from_world;
    const std::vector<std::uint8_t> fits_solution = inlier_;
    refine(sightings_, camera_, expected, inlier_);
    const double fitting_expected = static_cast<double>(count_fitting(current, nullptr));
    if (fitting_expected > options.expected_share * fitting) {
      solution = expected;
      fitting = fitting_expected;
    } else {
      inlier_ = fits_solution;
    }
    if (fitting < static_cast<double>(options.fewest_features) ||
        fitting < options.fewest_share * static_cast<double>(count_found(current)))
      return false;
    camera_from_world = solution;
    return true;
  }

  /// How many features have a sighting at all.
  std::size_t count_found(const Keyframe& current) const {
    std::vector<std::uint8_t> found(current.depth_m.size(), 0);
    for (const Source& source : sources_) found[source.feature] = 1;
    return static_cast<std::size_t>(std::count(found.begin(), found.end(), std::uint8_t{1}));
  }

  /// How many features fit the pose, by any keyframe (null) or by one.
  std::size_t count_fitting(const Keyframe& current, const Keyframe* keyframe) const {
    std::vector<std::uint8_t> fits(current.depth_m.size(), 0);
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (inlier_[i] && (keyframe == nullptr || sources_[i].keyframe == keyframe)) fits[sources_[i].feature] = 1;
    return static_cast<std::size_t>(std::count(fits.begin(), fits.end(), std::uint8_t{1}));
  }

  bool wants_keyframe(const Keyframe& current) const {
    const Keyframe& last = keyframes_.back();
    const double motion = distance(last.world_from_camera, current.world_from_camera);
    const double explained = static_cast<double>(count_fitting(current, &last));
    return motion > options.keyframe_motion ||
           explained < options.keyframe_share * static_cast<double>(count_depths(current));
  }

  void remember(Keyframe&& keyframe) {
    keyframes_.push_back(std::move(keyframe));
    if (keyframes_.size() > options.stored_keyframes) keyframes_.pop_front();
  }

  Camera camera_;
  cv::Ptr<cv::ORB> orb_;
  stillpoint::ImageBuffer gray_;
  std::deque<Keyframe> keyframes_;
  std::vector<PointSighting> sightings_;
  std::vector<Source> sources_;
  std::vector<std::uint8_t> inlier_;
  Pose camera_from_world_ = Pose::Identity();
  Pose motion_ = Pose::Identity();  ///< current_from_last, of the last two frames with a pose
  bool lost_ = false;
};

}  // namespace examples
