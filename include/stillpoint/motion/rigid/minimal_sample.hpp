// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The motions of three matches each, drawn by their weights: which of them explains the points best?

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/kabsch.hpp"
#include "stillpoint/motion/rigid/reprojection_residual.hpp"
#include "stillpoint/motion/rigid/support_problem.hpp"

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

/// The best motion of so many samples, not refined; no support where none explains more points than `to_beat`.
template <class Camera>
MotionHypothesis best_sample(std::size_t trials, double to_beat, const Matches& matches,
                             const SupportProblem<Camera>& problem, Random& random, Workspace& workspace) {
  const Workspace::Scope scope(workspace);
  const span<const PointConstraint> points = problem.points();
  const span<std::size_t> metric = workspace.take<std::size_t>(points.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (matches.metric(points[k].feature)) metric[count++] = k;
  MotionHypothesis best;
  if (count < 3) return best;
  for (std::size_t left = trials; left > 0; --left) {
    const std::optional<Pose> pose = motion_of_sample(matches, points, metric.first(count), random);
    if (!pose) continue;
    const double found = problem.point_support(*pose, to_beat);
    if (!(found > to_beat)) continue;
    to_beat = found;
    best = {*pose, Matrix6d::Zero(), found};
  }
  return best;
}

}  // namespace stillpoint
