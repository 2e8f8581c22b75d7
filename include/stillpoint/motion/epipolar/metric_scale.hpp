// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How long is a translation of which only the direction is known?   Depth tells.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// What one point says of the scale, with its standard deviation, metres.
struct ScaleVote {
  double metres = 0.0;
  double sigma_m = 1.0;
};

struct MetricScale {
  double metres = 0.0;  ///< may be negative: then the translation points the other way
  double sigma_m = 0.0;
};

/// The s that minimises ‖R P + s t̂ − Q‖ of one point: s = t̂ᵀ (Q − R P). Its noise is that of both depths along their
/// rays, and of the pixels across them, projected on t̂.
/// @param turned  R P, metres, in the current camera's axes; current: Q. Both with z > 0 or at least z ≠ 0
/// @param direction t̂, length 1
/// @param reference_sigma_m, current_sigma_m  of the two depths
/// @param angle_sigma  of a pixel's position over the focal length, radians
inline ScaleVote scale_vote(const Vector3d& turned, double reference_depth_m, double reference_sigma_m,
                            const Vector3d& current, double current_sigma_m, const Vector3d& direction,
                            double angle_sigma) {
  const double along_reference = direction.dot(turned) / reference_depth_m * reference_sigma_m;
  const double along_current = direction.dot(current) / current.z() * current_sigma_m;
  const double across = angle_sigma * std::hypot(reference_depth_m, current.z());
  return {direction.dot(current - turned),
          std::sqrt(along_reference * along_reference + along_current * along_current + across * across)};
}

/// The weighted median of the votes, weights 1/σ: minimises Σ |s − s_i| / σ_i, and up to half of the weight may be
/// wrong. Its standard deviation is √(π/2) of the weighted mean's, where the votes are normal. Votes that are not
/// finite are passed over. Reorders the votes, O(n log n).
/// @return nothing when fewer than `least` votes are left
inline std::optional<MetricScale> metric_scale(span<ScaleVote> votes, std::size_t least) {
  constexpr double kMedianPenalty = 1.2533141373155001;  // √(π/2)
  const auto useful = [](const ScaleVote& vote) {
    return std::isfinite(vote.metres) && std::isfinite(vote.sigma_m) && vote.sigma_m > 0.0;
  };
  const auto count = static_cast<std::size_t>(std::partition(votes.begin(), votes.end(), useful) - votes.begin());
  if (count < std::max<std::size_t>(least, 1)) return std::nullopt;
  votes = votes.first(count);
  std::sort(votes.begin(), votes.end(), [](const ScaleVote& a, const ScaleVote& b) { return a.metres < b.metres; });
  double weight = 0.0, information = 0.0;
  for (const ScaleVote& vote : votes) {
    weight += 1.0 / vote.sigma_m;
    information += 1.0 / (vote.sigma_m * vote.sigma_m);
  }
  double below = 0.0;
  std::size_t middle = 0;
  for (; middle + 1 < count; ++middle) {
    below += 1.0 / votes[middle].sigma_m;
    if (below >= 0.5 * weight) break;
  }
  return MetricScale{votes[middle].metres, kMedianPenalty / std::sqrt(information)};
}

}  // namespace stillpoint
