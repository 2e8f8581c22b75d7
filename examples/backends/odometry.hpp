// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small RGB-D odometry: each frame's ORB corners are found again in the nearest keyframes by Lucas-Kanade; the
// keyframes' depth makes points of them, and the pose is solved from the points. A lost camera is looked for in all
// keyframes by descriptors. No map, no loop closing.

#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "keyframe_pose.hpp"
#include "optical_flow.hpp"
#include "orb_features.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// A frame's corners and its images: a corner may be found again where the frame has none.
struct PicturedFeatures : OrbFeatures {
  std::vector<cv::Mat> pyramid;  ///< of the gray image
  stillpoint::ImageBuffer depth;
  double depth_factor = 1.0;
};

/// A backend of `FilteredTracker`. The world is the camera of the first frame that is tracked. Equal frames give equal
/// bytes.
class RgbdOdometry {
 public:
  struct Options {
    int features = 1000;
    int window_px = 11;                ///< of Lucas-Kanade: the prediction is good, so that a small one will do
    int pyramid_levels = 1;            ///< above the image itself
    float forward_backward_px = 1.0f;  ///< a match that does not come back this near is none
  };
  Options options;
  KeyframePose<PicturedFeatures> pose;

  explicit RgbdOdometry(Camera camera) : RgbdOdometry(std::move(camera), Options{}) {}
  RgbdOdometry(Camera camera, const Options& settings)
      : options(settings), pose(std::move(camera)), orb_(cv::ORB::create(settings.features)) {
    pose.options.matched_keyframes = 3;
    pose.options.pixel_sigma = 0.5;
  }

  OrbFeatures extract(const stillpoint::FrameView& frame) {
    OrbFeatures features;
    orb_->detectAndCompute(gray_of(frame), cv::noArray(), features.keypoints, features.descriptors);
    return features;
  }

  void expect_motion(const Pose& current_from_last) { pose.expect_motion(current_from_last); }

  std::optional<Pose> track(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    return pose.track(frame, prepare(frame, features),
                      [this](const Frame& keyframe, const Frame& current, const Pose& camera_from_world, bool is_lost,
                             std::vector<FoundAgain>& found) {
                        if (is_lost)
                          match_by_descriptor(keyframe, current, found);
                        else
                          match_by_flow(keyframe, current, camera_from_world, found);
                      });
  }

 private:
  using Frame = KeyframePose<PicturedFeatures>::Frame;

  cv::Size window() const { return {options.window_px, options.window_px}; }

  cv::Mat gray_of(const stillpoint::FrameView& frame) {
    return stillpoint::as_mat(stillpoint::with_gray(frame, gray_).gray);
  }

  /// Everything a keyframe needs, copied: the frame's views may die.
  PicturedFeatures prepare(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    PicturedFeatures current{{features.keypoints, features.descriptors.clone(), features.weights}, {}, {}, 1.0};
    cv::buildOpticalFlowPyramid(gray_of(frame), current.pyramid, window(), options.pyramid_levels, true,
                                cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
    current.depth.assign(frame.depth.image);
    current.depth_factor = frame.depth.factor;
    return current;
  }

  void append(std::size_t feature, const Frame& keyframe, const cv::Point2f& there,
              std::vector<FoundAgain>& found) const {
    const stillpoint::DepthView depth(keyframe.features.depth.view(), keyframe.features.depth_factor);
    const stillpoint::FrameView frame(keyframe.features.pyramid.front(), depth, 0.0);  // its time does not matter
    const double depth_m = depth_at(frame, there, pose.options.depth_limits);
    if (depth_m > 0) found.push_back({feature, pose.camera().undistort({there.x, there.y}), depth_m});
  }

  void match_by_flow(const Frame& keyframe, const Frame& current, const Pose& camera_from_world,
                     std::vector<FoundAgain>& found) const {
    constexpr double kUsualDepth_m = 2.0;  // where there is none: it only begins the search
    const Camera& camera = pose.camera();
    const Pose keyframe_from_camera = (camera_from_world * keyframe.world_from_camera).inverse();
    std::vector<cv::Point2f> here, there;
    std::vector<std::size_t> feature;
    for (std::size_t i = 0; i < current.depth_m.size(); ++i) {
      const double depth_m = current.depth_m[i] > 0 ? current.depth_m[i] : kUsualDepth_m;
      const Vector3d p_keyframe = keyframe_from_camera * camera.back_project(current.pixel[i], depth_m);
      if (!(p_keyframe.z() > 0.1)) continue;
      const Vector2d guess = camera.distort(camera.project(p_keyframe));
      if (!(guess.x() > 0 && guess.y() > 0 && guess.x() < camera.width() - 1 && guess.y() < camera.height() - 1))
        continue;
      here.push_back(current.features.keypoints[i].pt);
      there.emplace_back(static_cast<float>(guess.x()), static_cast<float>(guess.y()));
      feature.push_back(i);
    }
    if (here.empty()) return;
    std::vector<cv::Point2f> back = here;
    const std::vector<cv::Mat>&image_here = current.features.pyramid, &image_there = keyframe.features.pyramid;
    const std::vector<std::uint8_t> is_there = follow(image_here, image_there, here, there);
    const std::vector<std::uint8_t> is_back = follow(image_there, image_here, there, back);
    for (std::size_t i = 0; i < here.size(); ++i)
      if (is_there[i] && is_back[i] && cv::norm(back[i] - here[i]) < options.forward_backward_px)
        append(feature[i], keyframe, there[i], found);
  }

  std::vector<std::uint8_t> follow(const std::vector<cv::Mat>& from_image, const std::vector<cv::Mat>& to_image,
                                   const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>& to) const {
    constexpr int kIterations = 20;
    return flow(from_image, to_image, from, to, options.window_px, options.pyramid_levels, kIterations);
  }

  /// Finds the features by their descriptors, anywhere in a keyframe: when no prediction helps.
  void match_by_descriptor(const Frame& keyframe, const Frame& current, std::vector<FoundAgain>& found) const {
    constexpr float kFarthest = 64.0f, kRatio = 0.8f;  // of 256 bits; to the second best (Lowe, 2004)
    if (current.features.keypoints.empty() || keyframe.features.keypoints.empty()) return;
    std::vector<std::vector<cv::DMatch>> matches;
    cv::BFMatcher(cv::NORM_HAMMING).knnMatch(current.features.descriptors, keyframe.features.descriptors, matches, 2);
    for (const std::vector<cv::DMatch>& best : matches)
      if (best.size() == 2 && best[0].distance < kFarthest && best[0].distance < kRatio * best[1].distance)
        append(static_cast<std::size_t>(best[0].queryIdx), keyframe,
               keyframe.features.keypoints[static_cast<std::size_t>(best[0].trainIdx)].pt, found);
  }

  cv::Ptr<cv::ORB> orb_;
  stillpoint::ImageBuffer gray_;
};

}  // namespace examples
