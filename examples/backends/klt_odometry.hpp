// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A visual odometry on tracks: points are carried from frame to frame by Lucas-Kanade and topped up where there are
// few; the depth of the keyframes makes points of the tracks, and the pose is solved from the points.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "feature_weights.hpp"
#include "keyframe_pose.hpp"
#include "optical_flow.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/match/grid_corners.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// Points of a frame and the tracks they belong to.
struct TrackedPoints {
  std::vector<cv::KeyPoint> keypoints;
  std::vector<std::uint64_t> ids;  ///< ascending; one that is gone never comes back
  FeatureWeights weights;

  void compact(span<const std::uint8_t> keep) {
    stillpoint::compact(keep, keypoints, ids);
    weights.compact(keep);
  }
  void weigh(span<const float> some) { weights.assign(some); }
};

/// A backend of `FilteredTracker`. A track that the filter drops has ended: no keyframe's point is found by it again,
/// also where its object was when the keyframe was taken. Equal frames give equal bytes.
class KltOdometry {
 public:
  struct Options {
    int cell_px = 28;                  ///< each cell of this side shall have a track
    float weakest_corner = 5000.0f;    ///< a cell with nothing stronger stays empty: see grid_corners
    int window_px = 15;                ///< of Lucas-Kanade
    int pyramid_levels = 3;            ///< above the image itself
    float forward_backward_px = 0.7f;  ///< a track that does not come back this near ends
  };
  Options options;
  KeyframePose<TrackedPoints> pose;

  explicit KltOdometry(Camera camera) : KltOdometry(std::move(camera), Options{}) {}
  KltOdometry(Camera camera, const Options& settings) : options(settings), pose(std::move(camera)) {}

  /// The tracks of the last frame that are found in this one, and new ones where there are none.
  TrackedPoints extract(const stillpoint::FrameView& frame) {
    const stillpoint::FrameView with_gray = stillpoint::with_gray(frame, gray_);
    std::swap(pyramid_, last_pyramid_);
    cv::buildOpticalFlowPyramid(stillpoint::as_mat(with_gray.gray), pyramid_, window(), options.pyramid_levels, true,
                                cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
    TrackedPoints points = carry();
    top_up(with_gray.gray, points);
    return points;
  }

  void expect_motion(const Pose& current_from_last) { pose.expect_motion(current_from_last); }

  std::optional<Pose> track(const stillpoint::FrameView& frame, const TrackedPoints& points) {
    last_ = points;
    return pose.track(frame, points, [](const auto& keyframe, const auto& current, const Pose&, bool, auto& found) {
      match(keyframe, current.features.ids, found);
    });
  }

 private:
  cv::Size window() const { return {options.window_px, options.window_px}; }

  TrackedPoints carry() const {
    TrackedPoints points;
    if (last_.keypoints.empty()) return points;
    std::vector<cv::Point2f> from, to, back;
    cv::KeyPoint::convert(last_.keypoints, from);
    to = from;
    const std::vector<std::uint8_t> found = follow(last_pyramid_, pyramid_, from, to);
    back = from;
    const std::vector<std::uint8_t> found_back = follow(pyramid_, last_pyramid_, to, back);
    points = last_;
    points.weights = {};  // of the last frame
    std::vector<std::uint8_t> keep(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      points.keypoints[i].pt = to[i];
      keep[i] =
          found[i] && found_back[i] && cv::norm(back[i] - from[i]) < options.forward_backward_px && is_inside(to[i]);
    }
    points.compact(keep);
    return points;
  }

  bool is_inside(const cv::Point2f& pixel) const {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= static_cast<float>(pose.camera().width() - 1) &&
           pixel.y <= static_cast<float>(pose.camera().height() - 1);
  }

  std::vector<std::uint8_t> follow(const std::vector<cv::Mat>& from_image, const std::vector<cv::Mat>& to_image,
                                   const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>& to) const {
    constexpr int kIterations = 30;
    return flow(from_image, to_image, from, to, options.window_px, options.pyramid_levels, kIterations);
  }

  void top_up(const stillpoint::ImageView& gray, TrackedPoints& points) {
    const int columns = gray.width / options.cell_px + 1, rows = gray.height / options.cell_px + 1;
    std::vector<std::uint8_t> taken(static_cast<std::size_t>(columns * rows), 0);
    const auto cell = [&](float u, float v) {
      return static_cast<std::size_t>(static_cast<int>(v) / options.cell_px * columns +
                                      static_cast<int>(u) / options.cell_px);
    };
    for (const cv::KeyPoint& keypoint : points.keypoints) taken[cell(keypoint.pt.x, keypoint.pt.y)] = 1;
    corners_.clear();
    stillpoint::grid_corners(gray, options.cell_px, options.weakest_corner, corners_, workspace_);
    for (const stillpoint::Vector2f& corner : corners_) {
      if (taken[cell(corner.x(), corner.y())]) continue;
      points.keypoints.emplace_back(corner.x(), corner.y(), static_cast<float>(options.window_px));
      points.ids.push_back(next_id_++);
    }
  }

  /// Both frames' ids ascend.
  static void match(const PointFrame<TrackedPoints>& keyframe, const std::vector<std::uint64_t>& current,
                    std::vector<FoundAgain>& found) {
    const std::vector<std::uint64_t>& there = keyframe.features.ids;
    for (std::size_t i = 0, k = 0; i < current.size() && k < there.size();) {
      if (current[i] == there[k] && keyframe.depth_m[k] > 0)
        found.push_back({i, keyframe.pixel[k], keyframe.depth_m[k]});
      const bool next_current = current[i] <= there[k], next_keyframe = there[k] <= current[i];
      i += next_current;
      k += next_keyframe;
    }
  }

  stillpoint::ImageBuffer gray_;
  stillpoint::Workspace workspace_;
  std::vector<cv::Mat> pyramid_, last_pyramid_;
  TrackedPoints last_;
  std::uint64_t next_id_ = 0;
  std::vector<stillpoint::Vector2f> corners_;
};

}  // namespace examples
