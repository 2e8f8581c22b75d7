// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which kept features move with the object that they lie on?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/movers/moving_features.hpp"
#include "stillpoint/movers/object_motion.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Gives what the objects know back to the verdicts. The filter asks of a feature whether it moves at all; where an
/// object's motion is too small there to be told from noise, the object itself says more: what lies on it and fits its
/// motion better than being static moves along. Where the two motions are far apart the filter has told them apart.
class ObjectHypothesis {
 public:
  /// Makes kept features dynamic that lie on an object that surely moves, and whose they are. A feature without a
  /// probability stays as it is.
  /// @param followed  the features with a step
  template <class Camera>
  static void run(const std::vector<TrackedObject>& objects, const MovingFeatures<Camera>& features,
                  const PixelGrid& followed, span<Label> labels, Workspace& workspace) {
    if (std::none_of(objects.begin(), objects.end(), surely_moves)) return;
    const Workspace::Scope scope(workspace);
    const Matches& matches = features.matches;
    const float reach_px = kReach_px * matches.pixel_scale;
    const Pose reference_from_current = inverted(features.current_from_reference);
    const PixelGrid members(matches.current.pixel, reach_px, workspace, [&](std::size_t i) {
      const std::int32_t object = features.object_of[i];
      return object != MovingFeatures<Camera>::kNone && features.is_dynamic(i) && matches.current.has_depth(i) &&
             surely_moves(objects[static_cast<std::size_t>(object)]);
    });
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (features.is_dynamic(i) || !(labels[i].probability > kLeast) || !matches.current.has_depth(i)) continue;
      const std::int32_t beside = object_beside(i, features, members, reach_px);
      if (beside == MovingFeatures<Camera>::kNone) continue;
      const std::size_t stepped = features.with_step(i, followed);
      if (stepped == PixelGrid::kNone) continue;
      const TrackedObject& object = objects[static_cast<std::size_t>(beside)];
      const double says =
          log_likelihood_ratio(features.pair(stepped), object.mover.current_from_reference * reference_from_current);
      const auto probability = static_cast<double>(labels[i].probability);
      const double log_odds = std::log(probability / (1.0 - probability)) + says;
      if (!(log_odds > kNeeded)) continue;
      labels[i].log_odds = static_cast<float>(log_odds);  // what the keep-floor sorts by
      labels[i].probability = static_cast<float>(1.0 / (1.0 + std::exp(-log_odds)));
      labels[i].verdict = Verdict::dynamic;
      labels[i].keep = false;
      labels[i].reason = Reason::object_motion;
      features.object_of[i] = beside;
    }
  }

 private:
  static constexpr float kReach_px = 8.0f;        // for a focal length of 525 px: half of a support corner's cell
  static constexpr double kSameSurface_m = 0.06;  // between neighbours on one surface
  static constexpr double kSurely_m_s = 0.2;      // slower ones' motion is within the noise of a static object
  static constexpr std::size_t kFewest = 20;      // features whose common motion is well known
  static constexpr double kApart_sq = 9.0;        // χ²: where the motions differ by more, the filter tells them apart
  static constexpr double kExplained_sq = 2.37;  // χ² of three degrees of freedom: half of the object's own fit as well
  static constexpr double kMostSaid = 1.386;     // ln 4: steps of neighbours share errors, and the filter used them
  static constexpr double kNeeded = 0.847;       // ln (0.7 / 0.3)
  static constexpr float kLeast = 0.36f;         // what is less probable stays below 0.7 whatever is said

  static bool surely_moves(const TrackedObject& object) {
    return object.is_confirmed && object.is_seen && object.members >= kFewest &&
           object.mover.state == MoverState::moving && object.linear.velocity().norm() > kSurely_m_s;
  }

  /// That it moves with the object, to that it stands; 0 where the object has no say.
  static double log_likelihood_ratio(const WhitenedPair& pair, const Pose& moved) {
    WhitenedPair carried = pair;
    carried.current = moved * pair.reference;
    const double moves_sq = squared_distance(pair, moved);
    if (!(moves_sq < kExplained_sq) || !(squared_distance(carried, Pose::Identity()) < kApart_sq)) return 0;
    return std::clamp(0.5 * (squared_distance(pair, Pose::Identity()) - moves_sq), -kMostSaid, kMostSaid);
  }

  /// The object of the nearest other member on its surface.
  template <class Camera>
  static std::int32_t object_beside(std::size_t i, const MovingFeatures<Camera>& features, const PixelGrid& members,
                                    float reach_px) {
    const FrameFeatures& current = features.matches.current;
    const std::size_t nearest = members.nearest(current.pixel[i], reach_px, [&](std::size_t j, float) {
      return j != i && std::abs(current.depth_m[j] - current.depth_m[i]) < kSameSurface_m;
    });
    return nearest == PixelGrid::kNone ? MovingFeatures<Camera>::kNone : features.object_of[nearest];
  }
};

}  // namespace stillpoint
