// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The motion of three matches, drawn by their weights.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/kabsch.hpp"
#include "stillpoint/motion/rigid/reprojection_residual.hpp"

namespace stillpoint {

/// Three metric matches, each accepted with the probability of its weight.
inline std::optional<Pose> motion_of_sample(const Matches& matches, span<const PointConstraint> points,
                                            span<const std::size_t> metric, Random& random) {
  constexpr int kAttempts = 100;
  std::array<Vector3d, 3> current, reference;
  std::array<std::size_t, 3> chosen{};
  std::size_t count = 0;
  for (int attempt = 0; attempt < kAttempts && count < 3; ++attempt) {
    const std::size_t k = metric[random.index(metric.size())];
    const bool again = std::find(chosen.begin(), chosen.begin() + count, k) != chosen.begin() + count;
    if (again || !(random.uniform() < points[k].weight)) continue;
    current[count] = matches.current.point[points[k].feature];
    reference[count] = matches.reference.point[points[k].feature];
    chosen[count++] = k;
  }
  if (count < 3) return std::nullopt;
  return kabsch(span<const Vector3d>(current.data(), 3), span<const Vector3d>(reference.data(), 3));
}

}  // namespace stillpoint
