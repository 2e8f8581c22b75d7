// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is measured beside each other: our part of the filter, and what OpenCV has for the same task on the same data.
// Both the microbenchmarks and bench/ratios.cpp run these. `ours` and `theirs` do the work once; a pair is built
// outside of what is timed.

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clip.hpp"
#include "stillpoint/cluster/k_means.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/match/lucas_kanade.hpp"
#include "stillpoint/motion/epipolar/fundamental_estimator.hpp"
#include "stillpoint/motion/epipolar/fundamental_seven_point.hpp"
#include "stillpoint/motion/ransac.hpp"
#include "stillpoint/motion/rigid/rigid_motion.hpp"
#include "two_views.hpp"

namespace stillpoint::bench {

/// From each frame back to the last one and forth again, 21 px windows, four levels. Ours keeps the pyramid of the last
/// frame; OpenCV's function is called as it is in trackers, with images.
class LucasKanadePair {
 public:
  explicit LucasKanadePair(const Clip& clip) : clip_(clip) {
    for (const ClipFrame& frame : clip.frames) {
      points_.emplace_back();
      pixels_.emplace_back();
      for (const cv::KeyPoint& keypoint : frame.keypoints) {
        points_.back().push_back(keypoint.pt);
        pixels_.back().emplace_back(keypoint.pt.x, keypoint.pt.y);
      }
    }
  }

  /// @param i  from 1; the frames in their order, as a filter meets them
  void ours(std::size_t i) {
    matches_.begin(pixels_[i]);
    matcher_.match(clip_.frames[i - 1].view(), clip_.frames[i].view(), matches_);
  }

  void theirs(std::size_t i) {
    const cv::Mat &reference = clip_.frames[i - 1].gray, &current = clip_.frames[i].gray;
    cv::calcOpticalFlowPyrLK(current, reference, points_[i], forth_, found_, cv::noArray());
    cv::calcOpticalFlowPyrLK(reference, current, forth_, back_, found_back_, cv::noArray());
  }

  std::size_t our_matches() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < matches_.size(); ++i) count += matches_.matched(i);
    return count;
  }

  /// Those that come back to within a pixel, as ours.
  std::size_t their_matches(std::size_t i) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < forth_.size(); ++k)
      count += found_[k] != 0 && found_back_[k] != 0 &&
               std::hypot(back_[k].x - points_[i][k].x, back_[k].y - points_[i][k].y) <= 1.0f;
    return count;
  }

 private:
  const Clip& clip_;
  std::vector<std::vector<cv::Point2f>> points_;
  std::vector<std::vector<Vector2f>> pixels_;
  LucasKanade matcher_;
  Matches matches_;
  std::vector<cv::Point2f> forth_, back_;
  std::vector<unsigned char> found_, found_back_;
};

/// Lloyd's iteration from the same labels for the same number of iterations; ours runs to its end and tells how many.
class KMeansPair {
 public:
  /// Points of a few bodies of 0.3 m and a wall, as the features in boxes are.
  KMeansPair(std::size_t points, std::size_t clusters) : clusters_(clusters) {
    Random random(7);
    for (std::size_t i = 0; i < points; ++i) {
      const double body = std::floor(random.uniform(0, 5));
      const Vector3d spread(random.gaussian(), random.gaussian(), random.gaussian());
      points_.emplace_back(body < 4 ? Vector3d(Vector3d(body - 1.5, 0, 2 + 0.3 * body) + 0.3 * spread)
                                    : Vector3d(random.uniform(-2, 2), random.uniform(-1, 1), 4));
    }
    table_.create(static_cast<int>(points), 3, CV_32F);
    for (std::size_t i = 0; i < points; ++i)
      for (int c = 0; c < 3; ++c) table_.at<float>(static_cast<int>(i), c) = static_cast<float>(points_[i](c));
    start_labels();
    ours();
    iterations_ = our_iterations_;
  }

  void ours() {
    workspace_.rewind();
    PointArrays points(points_.size(), workspace_);
    for (std::size_t i = 0; i < points_.size(); ++i) points.set(i, points_[i]);
    const KMeansResult result = lloyd(points, centres_of_start(), kMostIterations, workspace_);
    our_cost_ = result.cost;
    our_iterations_ = result.iterations;
  }

  void theirs() {
    start_.copyTo(labels_);
    // The first of their iterations finds the centres of the given labels and assigns nothing.
    const cv::TermCriteria stop(cv::TermCriteria::COUNT, iterations_ + 1, 0.0);
    their_cost_ =
        cv::kmeans(table_, static_cast<int>(clusters_), labels_, stop, 1, cv::KMEANS_USE_INITIAL_LABELS, centres_);
  }

  double our_cost() const { return our_cost_; }
  double their_cost() const { return their_cost_; }
  int iterations() const { return iterations_; }

 private:
  static constexpr int kMostIterations = 100;

  /// Of the centres that k-means++ chooses.
  void start_labels() {
    PointArrays points(points_.size(), workspace_);
    for (std::size_t i = 0; i < points_.size(); ++i) points.set(i, points_[i]);
    Random random;
    stillpoint::detail::NearestCentre nearest(points, workspace_);
    nearest.offer(k_means_plus_plus(points, clusters_, random, workspace_), 0);
    start_.create(static_cast<int>(points_.size()), 1, CV_32S);
    for (std::size_t i = 0; i < points_.size(); ++i) start_.at<int>(static_cast<int>(i)) = nearest.index(i);
  }

  span<Eigen::Vector3f> centres_of_start() {
    const span<Vector3d> sum = workspace_.take<Vector3d>(clusters_, Vector3d::Zero());
    const span<double> count = workspace_.take<double>(clusters_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto c = static_cast<std::size_t>(start_.at<int>(static_cast<int>(i)));
      sum[c] += points_[i];
      count[c] += 1;
    }
    const span<Eigen::Vector3f> centres = workspace_.take<Eigen::Vector3f>(clusters_, Eigen::Vector3f::Zero());
    for (std::size_t c = 0; c < clusters_; ++c) centres[c] = (sum[c] / count[c]).cast<float>();
    return centres;
  }

  std::vector<Vector3d> points_;
  std::size_t clusters_;
  Workspace workspace_;
  cv::Mat table_, start_, labels_, centres_;
  double our_cost_ = 0, their_cost_ = 0;
  int iterations_ = 0, our_iterations_ = 0;
};

/// The fundamental matrix of two views: the same threshold, confidence and most trials.
class EpipolarPair {
 public:
  EpipolarPair(const TwoViews& scene, double threshold_px) : scene_(scene), options_(threshold_px) {
    for (std::size_t i = 0; i < scene.observations.matches.size(); ++i) {
      const Vector2d &p = scene.observations.matches.reference.undistorted[i],
                     &q = scene.observations.matches.current.undistorted[i];
      reference_.emplace_back(p.x(), p.y());
      current_.emplace_back(q.x(), q.y());
    }
  }

  void ours() {
    workspace_.rewind();
    const FundamentalEstimator<FundamentalSevenPoint> estimator(
        scene_.observations.matches.reference.undistorted, scene_.observations.matches.current.undistorted, workspace_);
    const auto report = ransac(estimator, options_, workspace_);
    our_fundamental_ = estimator.in_pixels(report.model);
    our_trials_ = report.trials;
  }

  void theirs() {
    their_fundamental_ =
        cv::findFundamentalMat(reference_, current_, cv::USAC_DEFAULT, options_.threshold, options_.confidence,
                               static_cast<int>(options_.max_trials), their_mask_);
  }

  std::size_t our_trials() const { return our_trials_; }
  PoseError our_error() const { return fundamental_error(our_fundamental_, scene_); }
  PoseError their_error() const {
    if (their_fundamental_.rows != 3 || their_fundamental_.cols != 3) return {};
    Matrix3d f;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) f(i, k) = their_fundamental_.at<double>(i, k);
    return fundamental_error(f, scene_);
  }

 private:
  const TwoViews& scene_;
  RansacOptions options_;
  std::vector<cv::Point2d> reference_, current_;
  Workspace workspace_;
  Matrix3d our_fundamental_ = Matrix3d::Zero();
  std::size_t our_trials_ = 0;
  cv::Mat their_fundamental_, their_mask_;
};

/// The motion between two sets of 3D points. OpenCV has no robust rigid one: its affine one has twelve degrees of
/// freedom, a threshold in metres, and is made rigid here (outside of what is timed) to have a pose error.
class RigidPair {
 public:
  explicit RigidPair(const TwoViews& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.observations.matches.size(); ++i) {
      const Vector3d &p = scene.observations.matches.reference.point[i],
                     &q = scene.observations.matches.current.point[i];
      reference_.emplace_back(p.x(), p.y(), p.z());
      current_.emplace_back(q.x(), q.y(), q.z());
    }
  }

  void ours() {
    workspace_.rewind();
    motion_ = ego_motion_.estimate(scene_.observations, scene_.camera, MotionPrior{}, workspace_);
  }

  void theirs() {
    constexpr double kThreshold_m = 0.05;  // a Kinect's noise at 4 m, doubled
    cv::estimateAffine3D(reference_, current_, affine_, their_mask_, kThreshold_m, ego_motion_.options.confidence);
  }

  PoseError our_error() const { return {motion_.current_from_reference, scene_.current_from_reference}; }
  PoseError their_error() const {
    if (affine_.rows != 3 || affine_.cols != 4) return {};
    Eigen::Affine3d affine = Eigen::Affine3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 4; ++k) affine(i, k) = affine_.at<double>(i, k);
    Pose pose = Pose::Identity();
    pose.linear() = affine.rotation();  // the nearest one
    pose.translation() = affine.translation();
    return {pose, scene_.current_from_reference};
  }

 private:
  const TwoViews& scene_;
  std::vector<cv::Point3f> reference_, current_;
  RigidMotion ego_motion_;
  Workspace workspace_;
  Motion motion_;
  cv::Mat affine_, their_mask_;
};

}  // namespace stillpoint::bench
