// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features of a frame does the map call dynamic?   Those like a point of the map, near it, and not where it must
// be. A map remembers longer than the filter, so it finds slow movers: this goes back to the filter.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame.hpp"
#include "map.hpp"
#include "point_search.hpp"

namespace examples::slam {

/// A feature that deviates from the place where its point was first seen: a slow mover takes its points along.
/// @param pose_sigma_m  by which the map's keyframes may be off against each other
bool has_moved(const MapPoint& point, const Map& map, const Frame& frame, int feature, const Camera& camera,
               const MeasurementNoise& noise, double pose_sigma_m);
/// A feature that deviates from the point that it is like, by the noise of both: 99 % of right ones do not.
/// @param frame  with its pose
bool deviates(const MapPoint& point, const Frame& frame, int feature, const Camera& camera,
              const MeasurementNoise& noise);

class DynamicFeatures {
 public:
  struct Options {
    PointSearch search;
    std::size_t fewest_observations = 2;  ///< keyframes that have seen a point which may accuse a feature
    double neighbour_px = 50.0;           ///< features this near, on the same surface, vote
    double neighbour_depth = 0.1;         ///< the same surface: depths differ by less than this share
    std::size_t fewest_votes = 4;         ///< that deviate, the feature's own among them
    double majority = 0.5;                ///< of the votes
    double pose_sigma_m = 0.005;          ///< by which keyframes may be off against each other
  };
  Options options;

  explicit DynamicFeatures(Camera camera) : camera_(std::move(camera)) {}

  /// @param frame  all features, also those that the filter drops, with the pose that tracking has found
  /// @param local  points that may be in the image
  /// @return       one byte per feature, 1: dynamic
  std::vector<std::uint8_t> operator()(const Frame& frame, const Map& map, span<const PointId> local,
                                       const MeasurementNoise& noise) const;

 private:
  Camera camera_;
};

}  // namespace examples::slam
