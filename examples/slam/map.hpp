// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The map: points, the keyframes that see them, and which keyframes see the same.

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "descriptor.hpp"
#include "frame.hpp"
#include "stillpoint/core/span.hpp"

namespace examples::slam {

/// A feature of a keyframe that shows a point.
struct Observation {
  KeyframeId keyframe = kNone;
  int feature = kNone;
};

/// Where a point was first seen. Its place in the map follows what is seen later: a slow mover takes its points along.
struct FirstSeen {
  KeyframeId keyframe = kNone;              ///< that holds it: a neighbour, once the one that made it is gone
  Vector3d p_camera = Vector3d::Zero();     ///< in the camera of that keyframe
  Vector3d ray_sigma_m = Vector3d::Zero();  ///< there, too: one standard deviation along its ray
};

struct MapPoint {
  Vector3d p_world = Vector3d::Zero();
  Vector3d ray_sigma_m = Vector3d::Zero();  ///< of the measurement that made it, one standard deviation along its ray
  Vector3d normal = Vector3d::Zero();       ///< mean direction to the cameras that see it
  double scale_distance_m = 0.0;            ///< from where it would be seen in the pyramid's octave 0
  Descriptor descriptor = {};               ///< the one that differs least from those of all observations
  std::vector<Observation> observations;    ///< by rising keyframe, one each
  KeyframeId made_by = kNone;
  FirstSeen first;
  int visible = 0, found = 0;  ///< frames that should have shown it, and that did
  cv::Vec3b colour;
  bool exists = false;

  int observation_in(KeyframeId keyframe) const {
    for (const Observation& observation : observations)
      if (observation.keyframe == keyframe) return observation.feature;
    return kNone;
  }
  /// The expected error along its ray: measurements are averaged.
  Vector3d sigma_m() const {
    return ray_sigma_m / std::sqrt(static_cast<double>(observations.empty() ? 1 : observations.size()));
  }
};

/// Points and keyframes refer to each other; every member leaves both sides alike. Not safe to share between threads:
/// who owns it locks it.
class Map {
 public:
  bool empty() const { return keyframes_.empty(); }
  const std::map<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  bool has(KeyframeId id) const { return keyframes_.count(id) > 0; }
  Keyframe& keyframe(KeyframeId id) { return keyframes_.at(id); }
  const Keyframe& keyframe(KeyframeId id) const { return keyframes_.at(id); }
  KeyframeId last_keyframe() const { return keyframes_.rbegin()->first; }

  bool has_point(PointId id) const { return id != kNone && points_[static_cast<std::size_t>(id)].exists; }
  MapPoint& point(PointId id) { return points_[static_cast<std::size_t>(id)]; }
  const MapPoint& point(PointId id) const { return points_[static_cast<std::size_t>(id)]; }
  /// One more than the greatest id; not all exist.
  PointId point_ids() const { return static_cast<PointId>(points_.size()); }
  std::size_t point_count() const { return points_.size() - free_.size(); }

  /// Takes a frame as keyframe; the points that it names observe it from now on.
  KeyframeId add(Frame frame);
  /// A point that a keyframe's feature shows.
  PointId add_point(KeyframeId keyframe, int feature, const Vector3d& p_world, const Vector3d& ray_sigma_m);
  void add_observation(PointId point, KeyframeId keyframe, int feature);
  /// A point that nobody sees any more is removed.
  void remove_observation(PointId point, KeyframeId keyframe);
  void remove(PointId point);
  /// `gone` is the same point as `kept`, which gets its observations.
  void merge(PointId gone, PointId kept);
  void remove_keyframe(KeyframeId id);

  /// Keyframes that see at least `fewest` points of this one, the most first, and how many.
  std::vector<std::pair<KeyframeId, int>> covisible(KeyframeId id, int fewest) const;
  /// This keyframe, and behind it those that see at least `fewest` points of it: `most` of them, the most points first.
  std::vector<KeyframeId> with_neighbours(KeyframeId id, int fewest, std::size_t most) const;
  /// As `covisible`, for the points of any frame.
  std::vector<std::pair<KeyframeId, int>> that_see(stillpoint::span<const PointId> points, int fewest) const;
  /// All points of some keyframes, by rising id.
  std::vector<PointId> points_of(stillpoint::span<const KeyframeId> ids) const;

  /// Descriptor, normal and scale, from the observations as they are now.
  void describe(PointId point);

 private:
  std::map<KeyframeId, Keyframe> keyframes_;
  std::vector<MapPoint> points_;
  std::vector<PointId> free_;  ///< ids of points that are gone: the map grows by the area seen, not by time
  KeyframeId next_keyframe_ = 0;
};

}  // namespace examples::slam
