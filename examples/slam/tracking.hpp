// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where the camera is: the local map's points are found in the frame, and the pose is solved from them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../backends/robust_pose.hpp"
#include "../backends/told_motion.hpp"
#include "frame.hpp"
#include "map.hpp"
#include "point_search.hpp"

namespace examples::slam {

class Tracking {
 public:
  struct Options {
    PointSearch search;          ///< from a pose that is only expected
    PointSearch refined_search;  ///< from one that was solved
    std::size_t local_keyframes = 12;
    int fewest_shared = 5;    ///< points by which a keyframe belongs to the local map
    std::size_t fewest = 20;  ///< features that fit: fewer are no pose
    Options() {
      refined_search.window_px = 5.0;
      refined_search.second_best = 0.95;
    }
  };
  Options options;
  RobustPose solve;

  explicit Tracking(Camera camera) : camera_(std::move(camera)) {}

  /// What the filter says of the motion from the last frame to the coming one.
  void expect_motion(const Pose& current_from_last) { told_motion_.tell(current_from_last); }

  /// The pose of the frame and the points that it shows, from where the camera is expected.
  /// @param frame  gets `camera_from_world`, `point` and `deviates`
  bool locate(Frame& frame, Map& map, const MeasurementNoise& noise);
  /// The same by a keyframe and its neighbours, from a pose that somebody has found when the camera was lost.
  bool locate_by(KeyframeId place, const Pose& camera_from_world, Frame& frame, Map& map,
                 const MeasurementNoise& noise);

  /// The frame is where it was found: the next is expected from here.
  /// @param keyframe  what it became, or kNone: then the one that shares most with it is its reference
  void go_on_from(const Frame& frame, const Map& map, KeyframeId keyframe);
  /// The frame has no pose.
  void miss();
  /// Of the coming frame, as far as anybody knows.
  Pose expected_camera_from_world(const Map& map) const;

  /// Where the last frame with a pose is, by the map as it is now.
  Pose last_camera_from_world(const Map& map) const;
  KeyframeId reference() const { return reference_; }
  /// Points of the map around where the last frame with a pose was looked for.
  span<const PointId> local_points() const { return local_; }
  int misses() const { return misses_; }

 private:
  bool locate_from(const Pose& camera_from_world, span<const PointId> seen, Frame& frame, Map& map,
                   const MeasurementNoise& noise);
  Pose expected_motion() const;
  std::vector<PointId> points_around(const Map& map, span<const PointId> seen) const;
  void see(const Frame& frame, const Map& map, span<const PointMatch> matches, const MeasurementNoise& noise);
  bool refine(Frame& frame, Map& map, span<const PointId> local, const MeasurementNoise& noise);
  void mark_deviating(Frame& frame, const Map& map, span<const PointMatch> matches,
                      const MeasurementNoise& noise) const;

  Camera camera_;
  std::vector<PointId> local_;
  std::vector<PointMatch> matches_;
  std::vector<PointObservation> observations_;
  std::vector<std::uint8_t> inlier_;
  KeyframeId reference_ = kNone;  ///< the keyframe that shares most with the last frame
  Pose camera_from_reference_ = Pose::Identity();
  Pose motion_ = Pose::Identity();  ///< current_from_last, of the last two frames with a pose
  ToldMotion told_motion_;
  std::vector<PointId> last_points_;
  int misses_ = 0;
};

}  // namespace examples::slam
