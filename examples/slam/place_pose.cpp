// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "place_pose.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stillpoint/core/random.hpp"
#include "stillpoint/motion/ransac.hpp"
#include "stillpoint/motion/rigid/rigid_estimator.hpp"

namespace examples::slam {

std::optional<Pose> PlacePose::operator()(const Frame& frame, KeyframeId place, const Map& map) {
  constexpr std::size_t kNeighbours = 4;
  constexpr int kFewestShared = 15;
  // From the place's camera, so that noise lies along its rays; equal up to there for all pairs.
  const Pose place_from_world = map.keyframe(place).camera_from_world;
  std::vector<stillpoint::WhitenedPair> pairs;
  for (const PointId id : map.points_of(map.with_neighbours(place, kFewestShared, kNeighbours))) {
    const MapPoint& point = map.point(id);
    int best = kNone, bits = kDescriptorBits, second_bits = kDescriptorBits;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const int feature = static_cast<int>(i);
      const int difference = distance_bits(point.descriptor.data(), frame.descriptor(feature));
      if (difference < bits) {
        // Neighbouring octaves hold the same corner: it is no rival.
        const bool is_same =
            best != kNone && (frame.pixel[i] - frame.pixel[static_cast<std::size_t>(best)]).norm() < 5.0;
        second_bits = is_same ? second_bits : bits;
        bits = difference;
        best = feature;
      } else if (difference < second_bits &&
                 !((frame.pixel[i] - frame.pixel[static_cast<std::size_t>(best)]).norm() < 5.0)) {
        second_bits = difference;
      }
    }
    if (bits > options.farthest_bits || bits > options.second_best * second_bits) continue;
    const auto i = static_cast<std::size_t>(best);
    const double depth_m = frame.depth_m[i];
    if (!(depth_m > 0)) continue;
    pairs.emplace_back(place_from_world * point.p_world, point.sigma_m().norm(),
                       camera_.back_project(frame.pixel[i], depth_m), noise_.depth_m(depth_m),
                       noise_.pixel(frame, best), camera_);
  }
  if (pairs.size() < options.fewest) return std::nullopt;
  const stillpoint::Workspace::Scope scope(workspace_);
  stillpoint::Random random;
  stillpoint::shuffle(stillpoint::span(pairs), random);  // early rejection looks at the first of them
  stillpoint::RansacOptions ransac(std::sqrt(7.815));    // χ² of three degrees of freedom, 95 %
  ransac.max_trials = options.most_trials;
  const auto report = stillpoint::ransac(stillpoint::RigidEstimator(pairs, workspace_), ransac, workspace_);
  const auto fewest =
      std::max(static_cast<double>(options.fewest), options.fewest_share * static_cast<double>(pairs.size()));
  if (!report.success || static_cast<double>(report.inliers) < fewest) return std::nullopt;
  return stillpoint::orthonormalized(report.model * place_from_world);
}

}  // namespace examples::slam
