// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "pose_graph.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace examples::slam {

namespace {

/// Translation and rotation by which an edge is off. A pose is camera_from_world as rotation vector and translation,
/// after the pose where the search began: small, so that no angle is near a half turn.
class EdgeError {
 public:
  EdgeError(const PoseGraph::Edge& edge, const Pose& a_from_world, const Pose& b_from_world)
      : b_from_a_(edge.a_from_b.inverse()),
        begin_a_(a_from_world),
        begin_b_(b_from_world),
        root_weight_(std::sqrt(edge.weight)) {}

  /// Of b seen from a by the edge against b as it stands: b_from_a · (step_a · a) = step_b · b.
  template <class T>
  bool operator()(const T* const step_a, const T* const step_b, T* error) const {
    constexpr double kMetresPerRadian = 2.0;
    T by_edge[9], by_pose[9], origin_by_edge[3], origin_by_pose[3];
    place(step_a, begin_a_, &b_from_a_, by_edge, origin_by_edge);
    place(step_b, begin_b_, nullptr, by_pose, origin_by_pose);
    for (int i = 0; i < 3; ++i) error[i] = root_weight_ * (origin_by_edge[i] - origin_by_pose[i]);
    // Rotation vector of by_edge · by_poseᵀ, to first order: half of what is not symmetric.
    T difference[9];
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        difference[3 * row + column] = T(0.0);
        for (int k = 0; k < 3; ++k) difference[3 * row + column] += by_edge[3 * row + k] * by_pose[3 * column + k];
      }
    const double factor = 0.5 * kMetresPerRadian * root_weight_;
    error[3] = factor * (difference[7] - difference[5]);
    error[4] = factor * (difference[2] - difference[6]);
    error[5] = factor * (difference[3] - difference[1]);
    return true;
  }

 private:
  /// Rotation (rows) and translation of `after` · step · begin.
  template <class T>
  static void place(const T* step, const Pose& begin, const Pose* after, T* rotation, T* translation) {
    for (int column = 0; column < 4; ++column) {
      T p[3] = {T(begin(0, column)), T(begin(1, column)), T(begin(2, column))};
      T turned[3];
      ceres::AngleAxisRotatePoint(step, p, turned);
      if (column == 3)
        for (int i = 0; i < 3; ++i) turned[i] += step[3 + i];
      T result[3] = {turned[0], turned[1], turned[2]};
      if (after != nullptr)
        for (int i = 0; i < 3; ++i) {
          result[i] = (*after)(i, 0) * turned[0] + (*after)(i, 1) * turned[1] + (*after)(i, 2) * turned[2];
          if (column == 3) result[i] += (*after)(i, 3);
        }
      for (int i = 0; i < 3; ++i) {
        if (column == 3)
          translation[i] = result[i];
        else
          rotation[3 * i + column] = result[i];
      }
    }
  }

  Pose b_from_a_, begin_a_, begin_b_;
  double root_weight_;
};

}  // namespace

void relax(PoseGraph& graph, int iterations) {
  std::vector<std::array<double, 6>> steps(graph.nodes.size(), std::array<double, 6>{});
  ceres::Problem problem;
  for (const PoseGraph::Edge& edge : graph.edges) {
    const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeError, 6, 6, 6>(new EdgeError(
                                 edge, graph.nodes[a].camera_from_world, graph.nodes[b].camera_from_world)),
                             nullptr, steps[a].data(), steps[b].data());
  }
  if (problem.NumResidualBlocks() == 0) return;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (graph.nodes[i].is_fixed && problem.HasParameterBlock(steps[i].data()))
      problem.SetParameterBlockConstant(steps[i].data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = iterations;
  solver.num_threads = 1;  // the same bytes each time
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const Pose step = stillpoint::make_pose(stillpoint::rotation_from_vector({steps[i][0], steps[i][1], steps[i][2]}),
                                            {steps[i][3], steps[i][4], steps[i][5]});
    graph.nodes[i].camera_from_world = stillpoint::orthonormalized(step * graph.nodes[i].camera_from_world);
  }
}

}  // namespace examples::slam
