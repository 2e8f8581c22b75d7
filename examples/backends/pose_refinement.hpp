// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pose of a camera from points whose place in the world is known: Levenberg-Marquardt on pixels and depths.

#include <Eigen/Cholesky>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace examples {

using stillpoint::Camera;
using stillpoint::Pose;
using stillpoint::span;
using stillpoint::Vector2d;
using stillpoint::Vector3d;

/// A point of the world and where the camera sees it.
struct PointObservation {
  Vector3d p_world;          ///< metres
  Vector2d pixel;            ///< undistorted
  double pixel_sigma = 1.0;  ///< standard deviation of `pixel`, each axis
  double depth_m = 0.0;      ///< along the optical axis, 0 where there is none
  double depth_sigma_m = 0.0;
  Vector3d p_sigma_m = Vector3d::Zero();  ///< one standard deviation of `p_world` along the ray it was measured on
  double weight = 1.0;                    ///< what it may say: times its squared error
  std::size_t feature = 0;                ///< of the frame: several points may have been found by one
};

/// Finds the pose that explains the observations best: least squares of pixel and depth errors, whitened by the
/// covariance of both the observation and its point, with the weights of Student's t distribution (Kerl, Sturm,
/// Cremers, "Robust Odometry Estimation for RGB-D Cameras", ICRA 2013); observations that fit badly are left out and
/// may come back, round after round.
class PoseRefinement {
 public:
  struct Options {
    int rounds = 4;
    int iterations = 8;             ///< at most, in each round
    double converged = 1e-5;        ///< metres and radians: a shorter step ends a round; 0.005 px at 500 px
    double chi_squared = 7.815;     ///< 95 % of a right observation's errors are below this (three degrees of freedom)
    double degrees_of_freedom = 5;  ///< of Student's distribution, as in the paper
  };
  Options options;

  /// @param camera_from_world start of the search, and the result
  /// @param inlier one flag per observation: whether it fits the result
  /// @return how many do
  std::size_t operator()(span<const PointObservation> observations, const Camera& camera, Pose& camera_from_world,
                         std::vector<std::uint8_t>& inlier) {
    inlier.assign(observations.size(), 1);
    std::size_t inliers = observations.size();
    for (int round = 0; round < options.rounds && inliers >= 3; ++round) {
      whiten(observations, camera, camera_from_world);
      minimize(observations, camera, inlier, camera_from_world);
      inliers = 0;
      for (std::size_t i = 0; i < observations.size(); ++i) {
        const Vector3d p = camera_from_world * observations[i].p_world;
        inlier[i] = error(observations, i, camera, p).squaredNorm() < options.chi_squared ? 1 : 0;
        inliers += inlier[i];
      }
    }
    return inliers;
  }

  /// How badly all observations fit a pose, the outliers too: minus the logarithm of their likelihood but for a
  /// constant, by which poses can be compared.
  double misfit(span<const PointObservation> observations, const Camera& camera, const Pose& camera_from_world) {
    whiten(observations, camera, camera_from_world);
    return evaluate(observations, camera, std::vector<std::uint8_t>(observations.size(), 1), camera_from_world).cost;
  }

 private:
  using Matrix3d = stillpoint::Matrix3d;
  using Matrix6d = stillpoint::Matrix6d;
  using Vector6d = stillpoint::Vector6d;
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  static constexpr double kNearest_m = 0.05;

  /// Error of u, v and depth in standard deviations, of a point in the camera's frame. Behind the camera it is beyond
  /// every limit.
  Vector3d error(span<const PointObservation> observations, std::size_t i, const Camera& camera,
                 const Vector3d& p) const {
    const PointObservation& observation = observations[i];
    if (!(p.z() > kNearest_m)) return Vector3d::Constant(1e6);
    const Vector2d pixel_error = camera.project(p) - observation.pixel;
    const double depth_error = observation.depth_m > 0 ? p.z() - observation.depth_m : 0.0;
    return whitening_[i] * Vector3d(pixel_error.x(), pixel_error.y(), depth_error);
  }

  /// Of u, v and depth by the point in the camera's frame, in pixels and metres.
  static Matrix3d image_by_point(const PointObservation& observation, const Camera& camera, const Vector3d& p) {
    Matrix3d result;
    result << camera.fx() / p.z(), 0, -camera.fx() * p.x() / (p.z() * p.z()),  //
        0, camera.fy() / p.z(), -camera.fy() * p.y() / (p.z() * p.z()),        //
        0, 0, observation.depth_m > 0 ? 1 : 0;
    return result;
  }

  /// Of the error by the motion (translation, rotation vector) of the point in the camera's frame.
  Jacobian jacobian(span<const PointObservation> observations, std::size_t i, const Camera& camera,
                    const Vector3d& p) const {
    Jacobian point_by_motion;
    point_by_motion << Matrix3d::Identity(), -stillpoint::skew(p);
    return whitening_[i] * image_by_point(observations[i], camera, p) * point_by_motion;
  }

  /// The inverse root of each error's covariance: what the pixel and the depth are wrong by, and the point, whose own
  /// depth shows in the image the more, the farther the camera has gone aside.
  void whiten(span<const PointObservation> observations, const Camera& camera, const Pose& camera_from_world) {
    whitening_.clear();
    for (const PointObservation& observation : observations) {
      const double depth_sigma = observation.depth_m > 0 ? observation.depth_sigma_m : 1.0;  // any: the error is 0
      Matrix3d covariance =
          Vector3d(observation.pixel_sigma, observation.pixel_sigma, depth_sigma).cwiseAbs2().asDiagonal();
      const Vector3d p = camera_from_world * observation.p_world;
      if (p.z() > kNearest_m) {
        const Vector3d of_point =
            image_by_point(observation, camera, p) * (camera_from_world.linear() * observation.p_sigma_m);
        covariance += of_point * of_point.transpose();
      }
      whitening_.push_back(covariance.llt().matrixL().solve(Matrix3d::Identity()));
    }
  }

  /// Minus the logarithm of Student's density of all flagged errors, but for a constant; its gradient by the motion,
  /// and its Hessian as iteratively reweighted least squares have it.
  struct Evaluation {
    double cost = 0.0;
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
  };

  Evaluation evaluate(span<const PointObservation> observations, const Camera& camera,
                      const std::vector<std::uint8_t>& inlier, const Pose& camera_from_world) const {
    const double freedom = options.degrees_of_freedom;
    Evaluation result;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (inlier[i] == 0) continue;
      const Vector3d p = camera_from_world * observations[i].p_world;
      const Vector3d e = error(observations, i, camera, p);
      const double squared = e.squaredNorm();
      result.cost += observations[i].weight * 0.5 * (freedom + 3) * std::log1p(squared / freedom);
      if (!(p.z() > kNearest_m)) continue;
      const Jacobian j = jacobian(observations, i, camera, p);
      const double weight = observations[i].weight * (freedom + 3) / (freedom + squared);
      result.hessian += weight * j.transpose() * j;
      result.gradient += weight * j.transpose() * e;
    }
    return result;
  }

  void minimize(span<const PointObservation> observations, const Camera& camera,
                const std::vector<std::uint8_t>& inlier, Pose& camera_from_world) const {
    double damping = 1e-4;
    Evaluation current = evaluate(observations, camera, inlier, camera_from_world);
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
      Matrix6d damped = current.hessian;
      damped.diagonal() *= 1.0 + damping;
      const Vector6d step = -damped.ldlt().solve(current.gradient);
      if (!step.allFinite()) return;
      const Pose candidate = moved(camera_from_world, step);
      const Evaluation next = evaluate(observations, camera, inlier, candidate);
      if (next.cost < current.cost) {
        camera_from_world = candidate;
        current = next;
        damping *= 0.1;
      } else {
        damping *= 10.0;
      }
      if (step.norm() < options.converged) return;
    }
  }

  static Pose moved(const Pose& camera_from_world, const Vector6d& step) {
    const Pose motion = stillpoint::make_pose(stillpoint::rotation_from_vector(step.tail<3>()), step.head<3>());
    return stillpoint::orthonormalized(motion * camera_from_world);
  }

  std::vector<Matrix3d> whitening_;  ///< one per observation
};

}  // namespace examples
