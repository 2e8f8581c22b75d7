// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The motion that best explains where points and surfaces were seen in one or more older frames: iteratively reweighted
// Gauss-Newton on whitened residuals.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/lanes.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/rigid/motion_equations.hpp"
#include "stillpoint/motion/rigid/reprojection_residual.hpp"

namespace stillpoint {

namespace detail {

inline constexpr double kNegligibleStep = 1e-4;  // squared, in standard deviations of the motion

/// Tukey's biweight of a squared residual (Beaton and Tukey, 1974); 0 at the cutoff and beyond.
class Tukey {
 public:
  explicit Tukey(double cutoff) noexcept : inverse_limit_(1.0 / (cutoff * cutoff)) {}

  template <class Real>
  Real operator()(const Real& squared) const {
    const Real rest = 1.0 - squared * inverse_limit_;
    return where<Real>(rest > 0.0, rest * rest, lanes_of<Real>(0.0));
  }

 private:
  double inverse_limit_;
};

/// Those of one older frame, among constraints in the order of their frames.
template <class Constraint>
span<const Constraint> in_frame(span<const Constraint> constraints, std::size_t frame) {
  const auto begin = std::partition_point(constraints.begin(), constraints.end(),
                                          [frame](const Constraint& constraint) { return constraint.frame < frame; });
  const auto end = std::partition_point(begin, constraints.end(),
                                        [frame](const Constraint& constraint) { return constraint.frame == frame; });
  return constraints.subspan(static_cast<std::size_t>(begin - constraints.begin()),
                             static_cast<std::size_t>(end - begin));
}

/// What one older frame says, weighted by Tukey: two constraints at a time, those left over and those that no lane
/// should meet, behind the camera or not finite, one by one.
template <class Camera>
class FrameEquations {
 public:
  FrameEquations(const Pose& reference_from_current, const Tukey& tukey, const Camera& camera)
      : reference_from_current_(reference_from_current), tukey_(tukey), camera_(camera) {}

  template <class Constraint>
  void add(span<const Constraint> constraints) {
    std::size_t k = 0;
    for (; k + 1 < constraints.size(); k += 2) {
      if (add_if_finite(both_, constraints[k], constraints[k + 1])) continue;
      add_if_finite(single_, constraints[k]);
      add_if_finite(single_, constraints[k + 1]);
    }
    if (k < constraints.size()) add_if_finite(single_, constraints[k]);
  }

  Matrix6d matrix() const { return both_.matrix() + single_.matrix(); }
  Vector6d gradient() const { return both_.gradient() + single_.gradient(); }

 private:
  static bool finite(double squared) noexcept { return squared < std::numeric_limits<double>::infinity(); }
  static bool finite(const Lanes& squared) { return finite(squared[0]) && finite(squared[1]); }

  template <class Real, class... Points,
            std::enable_if_t<(std::is_same<Points, PointConstraint>::value && ...), int> = 0>
  bool add_if_finite(MotionEquations<Real>& equations, const Points&... points) {
    const PointResidual<Real> residual(reference_from_current_, camera_, points...);
    if (!finite(residual.squared)) return false;
    const Real weight = lanes(points.weight...) * tukey_(residual.squared);
    equations.add(residual.there, residual.equations(weight, camera_));
    return true;
  }

  template <class Real, class... Planes,
            std::enable_if_t<(std::is_same<Planes, PlaneConstraint>::value && ...), int> = 0>
  bool add_if_finite(MotionEquations<Real>& equations, const Planes&... planes) {
    const PlaneResidual<Real> residual(reference_from_current_, planes...);
    const Real squared = residual.error * residual.error;
    if (!finite(squared)) return false;
    const Real weight = lanes(planes.weight...) * tukey_(squared);
    equations.add(residual.there, residual.equations(weight));
    return true;
  }

  const Pose& reference_from_current_;
  const Tukey& tukey_;
  const Camera& camera_;
  MotionEquations<Lanes> both_;
  MotionEquations<double> single_;
};

}  // namespace detail

/// Looks for the small motion x = (ω, v) of the current camera that all older frames share, p' = Exp(ω) p + v, and
/// moves every `reference_from_current` by its inverse.
/// @param points, planes  what was seen, in the order of `frame`, which indexes `poses`
/// @param poses    one reference_from_current for each older frame, updated
/// @param cutoffs  one iteration each, sigmas; falling values anneal
/// @return         the information matrix of x, in the coordinates of `Motion::covariance`; zero when there was no
///                 step, and the poses are as they were. O(constraints) per iteration.
template <class Camera>
Matrix6d refine_reprojection(span<const PointConstraint> points, span<const PlaneConstraint> planes, span<Pose> poses,
                             span<const double> cutoffs, const Camera& camera) {
  Matrix6d information = Matrix6d::Zero();
  double settled_at = 0;
  for (const double cutoff : cutoffs) {
    if (!(cutoff < settled_at || settled_at <= 0)) continue;  // once more would change nothing
    const detail::Tukey tukey(cutoff);
    Matrix6d normal = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
      detail::FrameEquations<Camera> equations(poses[frame], tukey, camera);
      equations.add(detail::in_frame(points, frame));
      equations.add(detail::in_frame(planes, frame));
      const Matrix6d adjoint = motion_of_older_points(poses[frame]);
      const Matrix6d adjoint_transposed = transposed(adjoint);
      normal += adjoint_transposed * equations.matrix() * adjoint;
      gradient += adjoint_transposed * equations.gradient();
    }
    // What nothing is known of stays: a thousandth of a constraint holds it.
    constexpr double kHold = 1e-6;
    const Vector6d x = -Cholesky<6>(damped(normal, kHold)).solve(gradient);
    constexpr double kLongestStep = 0.5;  // radians, metres; more is no refinement
    const Vector3d turn = rotation_part(x), shift = translation_part(x);
    if (!(turn.norm() < kLongestStep) || !(shift.norm() < kLongestStep)) return information;
    const Pose back = inverted(make_pose(rotation_from_vector(turn), shift));
    for (Pose& pose : poses) pose = orthonormalized(composed(pose, back));
    information = normal;
    settled_at = quadratic_form(normal, x) < detail::kNegligibleStep ? cutoff : 0;
  }
  return information;
}

}  // namespace stillpoint
