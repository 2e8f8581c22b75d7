// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Does a camera move that seems to stand?

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/rigid/support_problem.hpp"

namespace stillpoint {

/// Is what is at rest better explained by a motion too small to see in any corner by itself?
/// @param resting        matches with the last frame that moved by less than their noise
/// @param inlier_sigmas  beyond them a match supports no hypothesis
/// @param least, most    of the noise that is measured
template <class Camera>
bool has_slow_motion(span<PointConstraint> resting, const Camera& camera, double inlier_sigmas,
                     const SupportNoise& least, const SupportNoise& most, Workspace& workspace) {
  constexpr double kGain = 60.0;  // squared sigmas by which the motion must beat the identity
  constexpr double kCutoff = 4.0;
  Pose poses[2] = {Pose::Identity(), Pose::Identity()};
  SupportProblem<Camera> problem(resting, {}, {poses, 1}, {poses + 1, 1}, camera, inlier_sigmas);
  problem.calibrate(Pose::Identity(), least, most, workspace);
  const MotionHypothesis moved = problem.refined(Pose::Identity(), {&kCutoff, 1});
  return !(problem.squared_residuals_of(moved.support - problem.support(Pose::Identity())) < kGain);
}

}  // namespace stillpoint
