// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The methods that the accuracy tables compare.

#include <opencv2/calib3d.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy_sequence.hpp"
#include "filter_run.hpp"
#include "host_tracks.hpp"
#include "run/switch_off.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"
#include "tally.hpp"

namespace stillpoint::bench {

/// A row of the tables.
struct Method {
  std::string name;
  std::function<Outcome(const LabelledSequence&, bool gives_boxes)> run;
};

/// A filter of ours, set by `adjust(filter)`.
template <class Policies, class Adjust>
Method filter_method(std::string name, Adjust adjust) {
  return {std::move(name), [adjust](const LabelledSequence& sequence, bool gives_boxes) {
            FrameFilter<Policies> filter(sequence.camera);
            adjust(filter);
            Tally tally;
            const LabelledFrame* last = nullptr;
            for (const LabelledFrame& frame : sequence.frames) {
              if (gives_boxes) filter.prior.detections = frame.detections;
              detail::give_tracks(filter.matcher, frame, 0);
              const FrameResult& result = filter.filter_frame(frame.view(), frame.keypoints);
              const Motion& motion = result.motion();
              tally.add(frame, last, result.keep(),
                        motion.usable() ? std::optional(motion.current_from_reference) : std::nullopt);
              last = &frame;
            }
            return tally.outcome();
          }};
}

/// A method on corners that Lucas-Kanade has followed, in place of ORB's keypoints.
inline Method on_followed_corners(std::string name, Method method) {
  return {std::move(name), [run = std::move(method.run)](const LabelledSequence& sequence, bool gives_boxes) {
            return run(with_followed_corners(sequence), gives_boxes);
          }};
}

/// What is often done: every feature in a box of a moving class is dropped.
inline Method drop_boxes() {
  return {"all of the box dropped", [](const LabelledSequence& sequence, bool gives_boxes) {
            Tally tally;
            std::vector<std::uint8_t> keep;
            for (const LabelledFrame& frame : sequence.frames) {
              keep.assign(frame.keypoints.size(), 1);
              for (std::size_t i = 0; gives_boxes && i < keep.size(); ++i)
                for (const Detection& detection : frame.detections)
                  if (detection.mobility == Mobility::dynamic &&
                      detection.box.contains({frame.keypoints[i].pt.x, frame.keypoints[i].pt.y}))
                    keep[i] = 0;
              tally.add(frame, nullptr, keep, std::nullopt);
            }
            return tally.outcome();
          }};
}

/// What a user writes with OpenCV: Lucas-Kanade from the last frame's points with depth, solvePnPRansac, and whatever
/// is more than 3 px from where the pose puts it is dropped. OpenCV's defaults but for the 3 px.
class PnpByHand {
 public:
  std::optional<Pose> judge(const LabelledFrame& last, const LabelledFrame& current, const Camera& camera,
                            std::vector<std::uint8_t>& keep) const {
    std::vector<cv::Point2f> here, there;
    for (const cv::KeyPoint& keypoint : current.keypoints) here.push_back(keypoint.pt);
    keep.assign(here.size(), 1);
    if (here.empty()) return std::nullopt;
    std::vector<unsigned char> found;
    cv::calcOpticalFlowPyrLK(current.gray, last.gray, here, there, found, cv::noArray());
    std::vector<cv::Point3f> points;
    std::vector<cv::Point2f> pixels;
    std::vector<std::size_t> feature;
    const cv::Rect image(0, 0, last.gray.cols, last.gray.rows);
    for (std::size_t i = 0; i < here.size(); ++i) {
      const cv::Point at(cvRound(there[i].x), cvRound(there[i].y));
      if (found[i] == 0 || !image.contains(at)) continue;
      const double depth_m = last.depth.at<std::uint16_t>(at) / last.depth_factor;
      if (!(depth_m > 0)) continue;
      const Vector3d point =
          camera.back_project(Vector2d(static_cast<double>(there[i].x), static_cast<double>(there[i].y)), depth_m);
      points.emplace_back(point.x(), point.y(), point.z());
      pixels.push_back(here[i]);
      feature.push_back(i);
    }
    constexpr std::size_t kFewest = 6;
    constexpr float kThreshold_px = 3.0f;
    if (points.size() < kFewest) return std::nullopt;
    const cv::Matx33d matrix(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
    cv::Vec3d rotation, translation;
    std::vector<int> inliers;
    if (!cv::solvePnPRansac(points, pixels, matrix, cv::noArray(), rotation, translation, false, 100, kThreshold_px,
                            0.99, inliers))
      return std::nullopt;
    for (const std::size_t i : feature) keep[i] = 0;
    for (const int inlier : inliers) keep[feature[static_cast<std::size_t>(inlier)]] = 1;
    const Vector3d axis(rotation[0], rotation[1], rotation[2]);
    Pose pose = Pose::Identity();
    pose.translation() = Vector3d(translation[0], translation[1], translation[2]);
    if (axis.norm() > 0) pose.linear() = Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
    return pose;
  }
};

inline Method pnp_by_hand() {
  return {"solvePnPRansac, 3 px", [](const LabelledSequence& sequence, bool) {
            Tally tally;
            std::vector<std::uint8_t> keep;
            const LabelledFrame* last = nullptr;
            for (const LabelledFrame& frame : sequence.frames) {
              keep.assign(frame.keypoints.size(), 1);
              const auto motion =
                  last != nullptr ? PnpByHand().judge(*last, frame, sequence.camera, keep) : std::nullopt;
              tally.add(frame, last, keep, motion);
              last = &frame;
            }
            return tally.outcome();
          }};
}

/// All rows, in the order of the tables.
inline std::vector<Method> methods() {
  using stillpoint_run::SwitchedMotion;
  using stillpoint_run::SwitchedPolicies;
  const auto as_it_is = [](auto&) {};
  std::vector<Method> rows = {filter_method<DefaultPolicies>("`DefaultPolicies`", as_it_is)};
  for (const auto& correction : stillpoint_run::kCorrections) {
    const stillpoint_run::Without without{{correction.name}};
    rows.push_back(filter_method<SwitchedPolicies>(std::string("without ") + correction.name, [without](auto& filter) {
      stillpoint_run::switch_off(without, filter);
    }));
  }
  for (const auto& [kind, name] : {std::pair(SwitchedMotion::Kind::rigid, "`RigidMotion`"),
                                   std::pair(SwitchedMotion::Kind::epipolar, "`EpipolarMotion`")})
    rows.push_back(filter_method<SwitchedPolicies>(std::string("with ") + name,
                                                   [kind = kind](auto& filter) { filter.ego_motion.kind = kind; }));
  rows.push_back(on_followed_corners("`DefaultPolicies`, followed corners", rows.front()));
  rows.push_back(
      on_followed_corners("`ProvidedMatches`, followed corners", filter_method<TrackPolicies>({}, as_it_is)));
  rows.push_back(filter_method<PaperPolicies>("`PaperPolicies`", as_it_is));
  rows.push_back(
      filter_method<PaperPolicies>("as printed: eq3", [](auto& f) { f.ego_motion.options.printed_eq3 = true; }));
  rows.push_back(filter_method<PaperPolicies>("as printed: unit-t",
                                              [](auto& f) { f.ego_motion.options.unit_translation = true; }));
  rows.push_back(filter_method<PaperPolicies>("as printed: eq8", [](auto& f) { f.scorer.options.printed_eq8 = true; }));
  rows.push_back(filter_method<PaperRigidPolicies>("`PaperRigidPolicies`", as_it_is));
  rows.push_back(drop_boxes());
  rows.push_back(pnp_by_hand());
  return rows;
}

}  // namespace stillpoint::bench
