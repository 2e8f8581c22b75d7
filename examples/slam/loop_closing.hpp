// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Has the camera come back? A keyframe that looks like one of long ago, shows the same objects, and fits it in space
// closes a loop: the error that has grown since is spread over all keyframes.

#include <cstddef>
#include <optional>
#include <vector>

#include "frame.hpp"
#include "map.hpp"
#include "place_index.hpp"
#include "place_pose.hpp"
#include "point_search.hpp"

namespace examples::slam {

/// A loop that was closed.
struct Loop {
  KeyframeId keyframe = kNone, place = kNone;
  double drift_m = 0.0;                    ///< by which the keyframe was off
  std::size_t points = 0;                  ///< of the place that the keyframe shows
  double keyframe_s = 0.0, place_s = 0.0;  ///< their times: keyframes may be gone from the map later
};

/// A keyframe that was recognised, and where it is by what it shows.
struct Recognised {
  Loop loop;
  Pose camera_from_world = Pose::Identity();
  std::vector<PointMatch> matches;  ///< points of the place by features of the keyframe
};

class LoopClosing {
 public:
  struct Options {
    bool closes = true;            ///< false: nothing is ever recognised as a loop
    bool compares_objects = true;  ///< a candidate's similarity is multiplied by that of the objects a detector saw
    int fewest_between = 10;       ///< keyframes: those nearer are no loop
    double least_similarity = 0.05;
    double share_of_neighbours =
        0.4;                     ///< a candidate is at least this share as similar as the most similar covisible one
    std::size_t candidates = 3;  ///< that are looked at
    std::size_t fewest_points = 50;  ///< of the place that the keyframe must show
    double fewest_share = 0.2;  ///< of the place's points in the image must be found; seen from aside, half are not
    double ambiguous = 0.9;     ///< another place of this share of the similarity must not fit as well
    PointSearch search;
    Options() {
      search.window_px = 8.0;
      search.second_best = 0.9;
    }
  };
  Options options;
  PlaceIndex index;
  PlacePose place_pose;

  LoopClosing(Camera camera, const MeasurementNoise& noise)
      : place_pose(camera, noise), camera_(std::move(camera)), noise_(noise) {}

  /// The place of long ago that the newest keyframe shows, if there is one, and no other that might be it.
  std::optional<Recognised> recognise(KeyframeId newest, const Map& map);
  /// Where a lost camera is: the most similar place that it fits.
  std::optional<Recognised> relocalise(const Frame& frame, const Map& map);
  /// Makes the map agree with what was recognised: pose graph, points, and those that are the same made one.
  void close(const Recognised& recognised, Map& map) const;

 private:
  struct Candidate {
    KeyframeId id;
    double similarity;
  };
  std::vector<Candidate> by_similarity(const Frame& frame, const Map& map) const;
  std::optional<Recognised> verify(const Keyframe& keyframe, KeyframeId place, const Map& map);
  bool agrees(const Keyframe& keyframe, const Pose& camera_from_world, span<const PointId> points, const Map& map,
              double share_of_fewest, std::vector<PointMatch>& matches, Pose& refined) const;

  Camera camera_;
  MeasurementNoise noise_;
};

}  // namespace examples::slam
