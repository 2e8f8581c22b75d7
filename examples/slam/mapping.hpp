// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From frames to a map: keyframes, their points by depth or by two views, the same point seen twice made one, and what
// the map can do without.

#include <vector>

#include "frame.hpp"
#include "map.hpp"
#include "point_search.hpp"

namespace examples::slam {

/// A keyframe that is gone, and one that stays near it.
struct CulledKeyframe {
  KeyframeId id = kNone, kept = kNone;
  Pose culled_from_kept = Pose::Identity();
};

class Mapping {
 public:
  struct Options {
    std::size_t neighbours = 10;  ///< covisible keyframes with which a new one is compared
    int fewest_shared = 15;       ///< points by which they are covisible
    int farthest_bits = 50;       ///< of two descriptors of one point, without its place being expected
    double second_best = 0.7;
    double least_parallax_rad = 0.02;  ///< of two views that make a point
    PointSearch fuse;                  ///< where a neighbour sees a point that it does not name yet
    double least_found_share = 0.25;   ///< of the frames that should show a point must show it
    int trial_keyframes = 3;           ///< after so many a point must have been seen twice
    double redundant_share = 0.9;      ///< of a keyframe's points in three others: it is not needed
    Options() {
      fuse.window_px = 4.0;
      fuse.farthest_bits = 50;
      fuse.second_best = 1.0;
    }
  };
  Options options;

  Mapping(Camera camera, const MeasurementNoise& noise) : camera_(std::move(camera)), noise_(noise) {}

  /// Takes a frame into the map, with points by depth.
  KeyframeId insert(Frame frame, Map& map) const;
  /// Compares a keyframe with its neighbours: points that are the same, and points by two views.
  void connect(KeyframeId id, Map& map) const;
  /// Removes points that prove to be none.
  void cull_points(KeyframeId newest, Map& map) const;
  /// Removes keyframes around the newest that others make needless, but for one that somebody stands on.
  std::vector<CulledKeyframe> cull_keyframes(KeyframeId newest, KeyframeId in_use, Map& map) const;

 private:
  void add_points_by_depth(KeyframeId id, Map& map) const;
  void add_points_by_two_views(KeyframeId id, Map& map) const;
  int most_alike(const Keyframe& keyframe, int feature, const Keyframe& other, const Pose& other_from_keyframe) const;
  void fuse(KeyframeId id, Map& map) const;
  void fuse_into(KeyframeId id, const std::vector<PointId>& points, Map& map) const;
  bool fits(const MapPoint& point, const Keyframe& keyframe, int feature) const;
  std::vector<KeyframeId> neighbours(KeyframeId id, const Map& map) const;

  Camera camera_;
  MeasurementNoise noise_;
};

}  // namespace examples::slam
