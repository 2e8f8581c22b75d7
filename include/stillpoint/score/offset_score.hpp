// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How badly does a feature disagree with the camera's motion?   The paper's offset vector, Eq. 4 to 9.

#include <cmath>
#include <cstddef>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Th = 0.7 θ + 0.3 l (Eq. 9): angle and length of the offset between where a static point would be and where it is.
class OffsetScore {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::feature_matches, capability::metric_motion>;
  using Provides = Capabilities<>;

  struct Options {
    double angle_weight = 0.7;   ///< per radian (Eq. 9)
    double length_weight = 0.3;  ///< per metre (Eq. 9)
    bool printed_eq8 = false;    ///< the printed arctan(dot / cross), the complement of the angle
  };
  Options options;

  /// Scores the features with a 3D point in both frames; the others keep NaN.
  template <class Camera>
  void score(const Observations& observations, const Motion& motion, const Camera&, span<FeatureScore> scores) const {
    const Matches& matches = observations.matches;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.metric(i)) continue;
      const Vector3d transferred = motion.current_from_reference * matches.reference.point[i];  // Eq. 6
      scores[i].value = static_cast<float>(offset(transferred, matches.current.point[i]));
    }
  }

  /// Eq. 9 of two points in the current camera's frame, metres.
  double offset(const Vector3d& transferred, const Vector3d& observed) const {
    const double length = (transferred - observed).norm();  // Eq. 7
    return options.angle_weight * angle(transferred, observed) + options.length_weight * length;
  }

  /// Eq. 8 as it is meant, atan2(‖a × b‖, a · b): the angle between the two rays, radians in [0, π]. As printed it is
  /// the complement, π/2 for parallel rays.
  double angle(const Vector3d& a, const Vector3d& b) const {
    const double dot = a.dot(b), cross = a.cross(b).norm();
    if (options.printed_eq8) return std::abs(cross > 0 ? std::atan(dot / cross) : std::copysign(kHalfPi, dot));
    return std::atan2(cross, dot);
  }

 private:
  static constexpr double kHalfPi = 1.5707963267948966;
};

template <class Visit>
void each_option(OffsetScore& stage, Visit& visit) {
  visit("angle_weight", stage.options.angle_weight, OptionRange{0, 1000});
  visit("length_weight", stage.options.length_weight, OptionRange{0, 1000});
  visit("printed_eq8", stage.options.printed_eq8);
}

}  // namespace stillpoint
