// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "bundle_adjustment.hpp"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace examples::slam {

namespace {

constexpr double kNearest_m = 0.05;

/// How a point that is turned by the vector ω moves with ω, to first order from any ω: the left Jacobian of SO(3).
/// Source: Barfoot, "State Estimation for Robotics", 2017, Eq. 7.77.
stillpoint::Matrix3d left_jacobian(const Vector3d& omega) {
  const double angle = omega.norm();
  if (angle < 1e-6) return stillpoint::Matrix3d::Identity() + 0.5 * stillpoint::skew(omega);
  const Vector3d axis = omega / angle;
  const double sine = std::sin(angle) / angle;
  return sine * stillpoint::Matrix3d::Identity() + (1.0 - sine) * axis * axis.transpose() +
         (1.0 - std::cos(angle)) / angle * stillpoint::skew(axis);
}

/// Errors of u, v and depth in standard deviations. A pose is what moves the camera from where it began: rotation
/// vector and translation, small, so that no angle is ever near a half turn.
class MeasurementError : public ceres::SizedCostFunction<3, 6, 3> {
 public:
  MeasurementError(const BundleProblem::Measurement& measurement, const Pose& begin, const Camera& camera)
      : measurement_(measurement), begin_(begin), camera_(camera) {}

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Vector3d omega(parameters[0]), translation(parameters[0] + 3), p_world(parameters[1]);
    const stillpoint::Matrix3d turn = stillpoint::rotation_from_vector(omega);
    const Vector3d turned = turn * (begin_ * p_world), p = turned + translation;
    if (!(p.z() > kNearest_m)) return false;
    const double per_pixel = 1.0 / measurement_.pixel_sigma;
    const double per_metre = measurement_.depth_m > 0 ? 1.0 / measurement_.depth_sigma_m : 0.0;
    Eigen::Map<Vector3d> error(residuals);
    error.head<2>() = per_pixel * (camera_.project(p) - measurement_.pixel);
    error.z() = per_metre * (p.z() - measurement_.depth_m);
    if (jacobians == nullptr) return true;
    const double fx = camera_.fx() / p.z(), fy = camera_.fy() / p.z();
    stillpoint::Matrix3d by_point;
    by_point << per_pixel * fx, 0, -per_pixel * fx * p.x() / p.z(),  //
        0, per_pixel * fy, -per_pixel * fy * p.y() / p.z(),          //
        0, 0, per_metre;
    using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor> by_motion(jacobians[0], 3, 6);
      by_motion.leftCols<3>() = -by_point * stillpoint::skew(turned) * left_jacobian(omega);
      by_motion.rightCols<3>() = by_point;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<RowMajor> by_place(jacobians[1], 3, 3);
      by_place = by_point * turn * begin_.linear();
    }
    return true;
  }

 private:
  const BundleProblem::Measurement& measurement_;
  Pose begin_;
  const Camera& camera_;
};

Pose moved(const Pose& begin, const std::array<double, 6>& motion) {
  const Pose step = stillpoint::make_pose(stillpoint::rotation_from_vector({motion[0], motion[1], motion[2]}),
                                          {motion[3], motion[4], motion[5]});
  return stillpoint::orthonormalized(step * begin);
}

}  // namespace

double squared_error(const BundleProblem& problem, const BundleProblem::Measurement& measurement,
                     const Camera& camera) {
  const Vector3d p = problem.views[static_cast<std::size_t>(measurement.view)].camera_from_world *
                     problem.points[static_cast<std::size_t>(measurement.point)].p_world;
  if (!(p.z() > kNearest_m)) return std::numeric_limits<double>::infinity();
  const double of_pixel = (camera.project(p) - measurement.pixel).squaredNorm() / std::pow(measurement.pixel_sigma, 2);
  if (!(measurement.depth_m > 0)) return of_pixel;
  return of_pixel + std::pow((p.z() - measurement.depth_m) / measurement.depth_sigma_m, 2);
}

void adjust(BundleProblem& problem, const Camera& camera, const BundleOptions& options) {
  std::vector<std::array<double, 6>> motions(problem.views.size(), std::array<double, 6>{});
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(ownership);
  std::vector<std::unique_ptr<ceres::LossFunction>> losses;
  ceres::HuberLoss with_depth(std::sqrt(chi_squared_limit(true))), without_depth(std::sqrt(chi_squared_limit(false)));
  for (const BundleProblem::Measurement& measurement : problem.measurements) {
    if (!measurement.fits) continue;
    const BundleProblem::View& view = problem.views[static_cast<std::size_t>(measurement.view)];
    ceres::LossFunction* robust =
        options.is_robust ? (measurement.depth_m > 0 ? &with_depth : &without_depth) : nullptr;
    losses.push_back(std::make_unique<ceres::ScaledLoss>(robust, measurement.weight, ceres::DO_NOT_TAKE_OWNERSHIP));
    ceres_problem.AddResidualBlock(new MeasurementError(measurement, view.camera_from_world, camera),
                                   losses.back().get(), motions[static_cast<std::size_t>(measurement.view)].data(),
                                   problem.points[static_cast<std::size_t>(measurement.point)].p_world.data());
  }
  if (ceres_problem.NumResidualBlocks() == 0) return;
  int free_views = 0;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    if (!ceres_problem.HasParameterBlock(motions[i].data())) continue;
    if (problem.views[i].is_fixed)
      ceres_problem.SetParameterBlockConstant(motions[i].data());
    else
      ++free_views;
  }
  ceres::Solver::Options solver;
  constexpr int kViewsForDenseMatrix = 60;
  solver.linear_solver_type = free_views <= kViewsForDenseMatrix ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = 1e-4;  // of the cost: poses change by less than their noise
  solver.num_threads = 1;            // the same bytes each time
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres_problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  for (std::size_t i = 0; i < problem.views.size(); ++i)
    problem.views[i].camera_from_world = moved(problem.views[i].camera_from_world, motions[i]);
}

}  // namespace examples::slam
