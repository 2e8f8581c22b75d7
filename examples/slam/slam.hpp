// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small RGB-D SLAM behind the filter. This file shows the order; each step has a file of its own:
//
// | step       | what                                                           | file               |
// |------------|----------------------------------------------------------------|--------------------|
// | track      | the local map's points are found in the frame: its pose        | tracking.hpp       |
// |            | a lost camera is looked for in all keyframes                   | loop_closing.hpp   |
// | keyframe   | a frame that the map explains badly joins it, with new points  | mapping.hpp        |
// | map        | points that are the same are made one; points by two views     | mapping.hpp        |
// | multi-view | a window is adjusted, what deviates is removed, until none does | multi_view.hpp     |
// | loop       | a place seen long ago, known by its features and objects       | loop_closing.hpp   |
//
// | feedback   | features that the map calls dynamic go back to the filter       | dynamic_features.hpp |
//
// The first two and the last run in the caller's thread (slam.cpp), the others behind it (map_keeper.cpp).

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../backends/feature_depth.hpp"
#include "../backends/orb_features.hpp"
#include "../backends/spread_orb.hpp"
#include "dynamic_features.hpp"
#include "frame.hpp"
#include "map_keeper.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "tracking.hpp"

namespace examples::slam {

struct SlamOptions {
  SpreadOrb::Options orb;
  MeasurementNoise noise;
  DepthLimits depth_limits;
  double keyframe_share = 0.4;        ///< a new keyframe where the map explains less: `explained_share`
  double keyframe_motion = 0.2;       ///< or the camera has moved this far from the last: metres plus radians
  std::size_t most_waiting = 2;       ///< keyframes that mapping has not come to; with more there is no new one
  std::size_t fewest_to_begin = 100;  ///< features with depth: fewer make no first keyframe
  int patience = 15;                  ///< frames without a pose; then the map goes on where the camera is expected
  bool maps_in_step = false;          ///< mapping is waited for: the same bytes each time
  /// Offers what its map calls dynamic to the filter, which finds slower movers by it. It has more false positives,
  /// too: docs/slam.md. Needs multi-view geometry.
  bool finds_dynamic = false;
  // The rows of the ablation.
  bool uses_multi_view = true;  ///< adjusts windows and removes what deviates
  bool uses_bundle = true;      ///< adjusts them
  bool uses_loops = true;
  bool uses_objects = true;  ///< as a cue of loops

  SlamOptions() {
    orb.cell_px = 64;  // smaller ones take corners where there are none worth it: they aren't found again
  }
};

/// A backend of `FilteredTracker`. The world is the camera of the first frame that is tracked.
class Slam {
 public:
  SlamOptions options;
  Tracking tracking;
  DynamicFeatures find_dynamic;

  Slam(Camera camera, const SlamOptions& settings);

  OrbFeatures extract(const stillpoint::FrameView& frame);
  void expect_motion(const Pose& current_from_last) { tracking.expect_motion(current_from_last); }
  /// What a detector has seen in the coming frame. People and cars are no part of a place: they are left out.
  void expect_detections(stillpoint::span<const stillpoint::Detection> detections);

  /// @return world_from_camera, as it is known at the time
  std::optional<Pose> track(const stillpoint::FrameView& view, const OrbFeatures& features);

  /// One byte per feature of the last `extract`, 1: moves, by the map; all 0 unless `finds_dynamic`.
  stillpoint::span<const std::uint8_t> dynamic_features() const { return is_dynamic_; }

  /// Each frame with a pose, as its keyframe stands when all mapping is done.
  stillpoint::Trajectory trajectory();
  /// The map as PLY when all mapping is done, and as it was before its last loop: empty where there was none.
  std::string map_ply();
  std::string map_ply_before_loop();
  /// The map and what is done to it. Lock its mutex, or call `trajectory` first.
  MapKeeper& keeper() { return *keeper_; }

 private:
  Frame prepare(const stillpoint::FrameView& view, const OrbFeatures& features);
  bool locate(Frame& frame);
  bool wants_keyframe(const Frame& frame) const;
  bool finds_dynamic() const { return options.finds_dynamic && options.uses_multi_view; }

  Camera camera_;
  SpreadOrb orb_;
  std::unique_ptr<MapKeeper> keeper_;  ///< stays where it is when this is moved
  std::vector<SeenObject> objects_;
  OrbFeatures extracted_;  ///< of the coming frame, before the filter drops any: descriptors with `finds_dynamic` alone
  std::vector<std::uint8_t> is_dynamic_;
};

}  // namespace examples::slam
