// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// 02_opencv_tracker: an RGB-D tracker of OpenCV's ORB, matcher and PnP, behind the filter and without it.

#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <optional>
#include <stillpoint/adapters/opencv_tracker.hpp>
#include <stillpoint/evaluation/trajectory_error.hpp>
#include <stillpoint/filtered_tracker.hpp>
#include <stillpoint/null_filter.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/synthetic/renderer.hpp>
#include <stillpoint/synthetic/scenes.hpp>
#include <type_traits>
#include <vector>

namespace {
using stillpoint::FrameView, stillpoint::Pose, stillpoint::Vector2d, stillpoint::Vector3d;

/// ORB features are matched with those of a keyframe, whose depth makes points of them; PnP gives the pose.
class OrbTracker {
 public:
  using Features = stillpoint::opencv_tracker::Features<>;  // keypoints and descriptors, which it compacts together
  explicit OrbTracker(const stillpoint::Camera& camera) : camera_(camera) {}

  Features extract(const FrameView& frame) {
    Features features;
    orb_->detectAndCompute(stillpoint::as_mat(frame.gray), cv::noArray(), features.keypoints, features.descriptors);
    return features;
  }

  /// @return world_from_camera; the world is the first camera with depth
  std::optional<Pose> track(const FrameView& frame, const Features& features) {
    if (points_.empty()) return make_keyframe(frame, features, Pose::Identity());
    std::vector<cv::DMatch> matches;
    cv::BFMatcher(cv::NORM_HAMMING, true).match(features.descriptors, descriptors_, matches);
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (const cv::DMatch& match : matches) {
      points.push_back(points_[static_cast<std::size_t>(match.trainIdx)]);
      const cv::Point2f pixel = features.keypoints[static_cast<std::size_t>(match.queryIdx)].pt;
      const Vector2d undistorted = camera_.undistort({pixel.x, pixel.y});
      pixels.emplace_back(undistorted.x(), undistorted.y());
    }
    const cv::Matx33d k(camera_.fx(), 0, camera_.cx(), 0, camera_.fy(), camera_.cy(), 0, 0, 1);
    cv::Vec3d rvec, tvec;  // camera_from_world
    std::vector<int> inliers;
    if (points.size() < 4 || !cv::solvePnPRansac(points, pixels, k, {}, rvec, tvec, false, 200, 2.0f, 0.99, inliers))
      return std::nullopt;
    const Vector3d r(rvec[0], rvec[1], rvec[2]), t(tvec[0], tvec[1], tvec[2]);
    const Pose camera_from_world = Eigen::Translation3d(t) * Eigen::AngleAxisd(r.norm(), r.stableNormalized());
    if (3 * inliers.size() < points_.size()) make_keyframe(frame, features, camera_from_world.inverse());
    return camera_from_world.inverse();
  }

 private:
  std::optional<Pose> make_keyframe(const FrameView& frame, const Features& features, const Pose& world_from_camera) {
    std::vector<cv::Point3d> points;
    cv::Mat descriptors;
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const cv::Point2f pixel = features.keypoints[i].pt;
      const double depth_m = stillpoint::RoundedDepth().at(frame.depth, {pixel.x, pixel.y});
      if (!(depth_m > 0)) continue;
      const Vector3d p_world = world_from_camera * camera_.back_project(camera_.undistort({pixel.x, pixel.y}), depth_m);
      points.emplace_back(p_world.x(), p_world.y(), p_world.z());
      descriptors.push_back(features.descriptors.row(static_cast<int>(i)));
    }
    if (points.size() < 4) return std::nullopt;  // PnP needs four: the keyframe before stays
    points_ = points;
    descriptors_ = descriptors;
    return world_from_camera;
  }

  stillpoint::Camera camera_;
  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(1000);
  std::vector<cv::Point3d> points_;  // of the keyframe, in the world
  cv::Mat descriptors_;              // one a point
};

template <class Tracker>
void run(const char* name, Tracker tracker, stillpoint::SyntheticSequence& sequence) {
  stillpoint::SyntheticFrame frame;
  stillpoint::Trajectory truth, path;
  std::size_t kept = 0;
  const char* hint = "";
  const auto observe = [&](const auto&, const auto& result) {
    kept += stillpoint::kept_count(result.keep());
    if constexpr (std::is_same_v<decltype(result), const stillpoint::FrameResult&>) hint = result.hint();
  };
  for (int i = 0; i < 60; ++i) {  // two seconds
    sequence.render(i, frame);
    truth.push_back({frame.timestamp_s, frame.world_from_camera});
    if (const auto pose = tracker.track(frame.view(), observe)) path.push_back({frame.timestamp_s, *pose});
  }
  const auto ate = stillpoint::absolute_trajectory_error(truth, path, stillpoint::Alignment::se3);
  std::printf("%s: %zu features per frame, %zu frames tracked, ATE %.4f m %s\n", name, kept / truth.size(), path.size(),
              stillpoint::error_statistics(ate.errors.translation_m).rmse, hint);
}

}  // namespace

int main() {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::walking_people());
  const OrbTracker tracker(sequence.camera());
  run("filtered", stillpoint::FilteredTracker(stillpoint::FrameFilter<>(sequence.camera()), tracker), sequence);
  run("unfiltered", stillpoint::FilteredTracker(stillpoint::NullFilter(), tracker), sequence);
}
