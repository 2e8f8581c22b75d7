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
struct PointSighting {
  Vector3d p_world;          ///< metres
  Vector2d pixel;            ///< undistorted
  double pixel_sigma = 1.0;  ///< standard deviation of `pixel`, each axis
  double depth_m = 0.0;      ///< along the optical axis, 0 where there is none
  double depth_sigma_m = 0.0;
};

/// Finds the pose that explains the sightings best: least squares of pixel and depth errors over their standard
/// deviations, with Huber's weight; sightings that fit badly are left out and may come back, round after round.
class PoseRefinement {
 public:
  struct Options {
    int rounds = 4;
    int iterations = 8;          ///< at most, in each round
    double chi_squared = 7.815;  ///< 95 % of a right sighting's errors are below this (three degrees of freedom)
    double huber = 2.0;          ///< errors beyond this many standard deviations count linearly
  };
  Options options;

  /// @param camera_from_world start of the search, and the result
  /// @param inlier one flag a sighting: whether it fits the result
  /// @return how many do
  std::size_t operator()(span<const PointSighting> sightings, const Camera& camera, Pose& camera_from_world,
                         std::vector<std::uint8_t>& inlier) const {
    inlier.assign(sightings.size(), 1);
    std::size_t inliers = sightings.size();
    for (int round = 0; round < options.rounds && inliers >= 3; ++round) {
      minimize(sightings, camera, inlier, camera_from_world);
      inliers = 0;
      for (std::size_t i = 0; i < sightings.size(); ++i) {
        inlier[i] = error(sightings[i], camera, camera_from_world).squaredNorm() < options.chi_squared ? 1 : 0;
        inliers += inlier[i];
      }
    }
    return inliers;
  }

 private:
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  using Matrix6d = stillpoint::Matrix6d;
  using Vector6d = stillpoint::Vector6d;

  /// Error of u, v and depth in standard deviations. Behind the camera it is beyond every limit.
  static Vector3d error(const PointSighting& sighting, const Camera& camera, const Pose& camera_from_world) {
    constexpr double kNearest_m = 0.05;
    const Vector3d p = camera_from_world * sighting.p_world;
    if (!(p.z() > kNearest_m)) return Vector3d::Constant(1e6);
    const Vector2d pixel_error = (camera.project(p) - sighting.pixel) / sighting.pixel_sigma;
    const double depth_error = sighting.depth_m > 0 ? (p.z() - sighting.depth_m) / sighting.depth_sigma_m : 0.0;
    return {pixel_error.x(), pixel_error.y(), depth_error};
  }

  /// By the motion (translation, rotation vector) of the point in the camera's frame.
  static Jacobian jacobian(const PointSighting& sighting, const Camera& camera, const Vector3d& p) {
    Eigen::Matrix<double, 3, 6> point_by_motion;
    point_by_motion << stillpoint::Matrix3d::Identity(), -stillpoint::skew(p);
    stillpoint::Matrix3d error_by_point;
    error_by_point << camera.fx() / p.z(), 0, -camera.fx() * p.x() / (p.z() * p.z()),  //
        0, camera.fy() / p.z(), -camera.fy() * p.y() / (p.z() * p.z()),                //
        0, 0, 1;
    error_by_point.topRows<2>() /= sighting.pixel_sigma;
    error_by_point.row(2) *= sighting.depth_m > 0 ? 1.0 / sighting.depth_sigma_m : 0.0;
    return error_by_point * point_by_motion;
  }

  /// Huber's cost: quadratic near zero, linear far away.
  double cost(span<const PointSighting> sightings, const Camera& camera, const std::vector<std::uint8_t>& inlier,
              const Pose& camera_from_world) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (inlier[i] == 0) continue;
      const double size = error(sightings[i], camera, camera_from_world).norm();
      sum += size < options.huber ? 0.5 * size * size : options.huber * (size - 0.5 * options.huber);
    }
    return sum;
  }

  void minimize(span<const PointSighting> sightings, const Camera& camera, const std::vector<std::uint8_t>& inlier,
                Pose& camera_from_world) const {
    double damping = 1e-4;
    double current_cost = cost(sightings, camera, inlier, camera_from_world);
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
      Matrix6d hessian = Matrix6d::Zero();
      Vector6d gradient = Vector6d::Zero();
      for (std::size_t i = 0; i < sightings.size(); ++i) {
        if (inlier[i] == 0) continue;
        const Vector3d e = error(sightings[i], camera, camera_from_world);
        const Jacobian j = jacobian(sightings[i], camera, camera_from_world * sightings[i].p_world);
        const double weight = e.norm() > options.huber ? options.huber / e.norm() : 1.0;
        hessian += weight * j.transpose() * j;
        gradient += weight * j.transpose() * e;
      }
      hessian.diagonal() *= 1.0 + damping;
      const Vector6d step = -hessian.ldlt().solve(gradient);
      if (!step.allFinite()) return;
      const Pose candidate = moved(camera_from_world, step);
      const double candidate_cost = cost(sightings, camera, inlier, candidate);
      if (candidate_cost < current_cost) {
        camera_from_world = candidate;
        current_cost = candidate_cost;
        damping *= 0.1;
        if (step.norm() < 1e-7) return;
      } else {
        damping *= 10.0;
      }
    }
  }

  static Pose moved(const Pose& camera_from_world, const Vector6d& step) {
    Pose motion = Pose::Identity();
    motion.linear() = stillpoint::rotation_from_vector(step.tail<3>());
    motion.translation() = step.head<3>();
    return stillpoint::orthonormalized(motion * camera_from_world);
  }
};

}  // namespace examples
