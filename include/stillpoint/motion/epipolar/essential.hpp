// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From the fundamental matrix to the camera's rotation and direction of motion: Eq. 3 of the paper.
// Source: Hartley and Zisserman, "Multiple View Geometry", 2nd ed., section 9.6.

#include <Eigen/SVD>

#include <array>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/motion/epipolar/triangulation.hpp"

namespace stillpoint {

/// The nearest matrix with singular values (1, 1, 0): an essential matrix of a translation of length 1.
inline Matrix3d nearest_essential(const Matrix3d& e) {
  const Eigen::JacobiSVD<Matrix3d> svd(e, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * Vector3d(1.0, 1.0, 0.0).asDiagonal() * svd.matrixV().transpose();
}

/// E = Kᵀ F K. The paper prints K F Kᵀ, which does not follow from p_currentᵀ F p_reference = 0.
/// @param camera_matrix K, of both images
inline Matrix3d essential_from_fundamental(const Matrix3d& fundamental, const Matrix3d& camera_matrix) {
  return nearest_essential(camera_matrix.transpose() * fundamental * camera_matrix);
}

/// Eq. 3 as it is printed, E = K F Kᵀ: wrong, kept to measure what it costs.
inline Matrix3d essential_as_printed(const Matrix3d& fundamental, const Matrix3d& camera_matrix) {
  return nearest_essential(camera_matrix * fundamental * camera_matrix.transpose());
}

/// The four motions current_from_reference with E ~ [t]× R and ‖t‖ = 1 (section 9.6.2): two rotations, two signs of t.
inline std::array<Pose, 4> decompose_essential(const Matrix3d& essential) {
  const Eigen::JacobiSVD<Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU(), v = svd.matrixV();
  if (u.determinant() < 0) u = -u;  // E's sign is free
  if (v.determinant() < 0) v = -v;
  Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  std::array<Pose, 4> poses;
  for (std::size_t k = 0; k < 4; ++k) {
    poses[k] = Pose::Identity();
    poses[k].linear() = u * (k < 2 ? w : Matrix3d(w.transpose())) * v.transpose();
    poses[k].translation() = k % 2 == 0 ? Vector3d(u.col(2)) : Vector3d(-u.col(2));
  }
  return poses;
}

/// The pose that sees the most points in front of both cameras, and how many these are.
struct CheiralPose {
  Pose current_from_reference = Pose::Identity();  ///< ‖t‖ = 1
  std::size_t in_front = 0;
};

/// Chooses among the four poses by triangulation; the first of equals. O(n).
/// @param reference_rays, current_rays  aligned, z = 1
inline CheiralPose choose_in_front(const std::array<Pose, 4>& poses, span<const Vector3d> reference_rays,
                                   span<const Vector3d> current_rays) {
  CheiralPose best;
  for (const Pose& pose : poses) {
    std::size_t in_front = 0;
    for (std::size_t i = 0; i < reference_rays.size(); ++i)
      in_front += triangulate(pose, reference_rays[i], current_rays[i]).in_front();
    if (in_front > best.in_front) best = {pose, in_front};
  }
  return best;
}

}  // namespace stillpoint
