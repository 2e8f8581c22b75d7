// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Two calibrated cameras side by side → images as of two equal pinholes whose rows are aligned.
//
// Source: Hartley and Zisserman, "Multiple View Geometry", 2nd edition, 11.12; the two rotations are those of
// cv::stereoRectify (Bouguet), which share the turn between the cameras.

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/stereo/image_pair.hpp"

namespace stillpoint {

/// Rectifies pairs of images. Copies share the maps; const calls are thread-safe.
class StereoRectification {
 public:
  /// Rectified images show only what both lenses saw: no black rims, at which corners would be found.
  /// @param right_from_left  the right camera stands to the right of the left one.
  /// @throws Error unless both cameras have the same size and lenses without or with radial and tangential distortion,
  ///         and the right one is to the right.
  StereoRectification(const Camera& left, const Camera& right, const Pose& right_from_left)
      : StereoRectification(left, right, solve(left, right, right_from_left)) {}

  /// Of the rectified left image: no distortion.
  const Camera& camera() const { return camera_; }
  double baseline_m() const { return baseline_m_; }
  /// A turn: the cameras' centres stay where they are.
  const Pose& rectified_from_left() const { return rectified_from_left_; }

  /// @param left, right  images of the cameras' size, of any type
  /// @throws Error if one is of another size.
  void rectify(const cv::Mat& left, const cv::Mat& right, cv::Mat& rectified_left, cv::Mat& rectified_right) const {
    detail::require_pair(left, right, "the cameras' " + size_of(camera_), [&](const cv::Mat& image) {
      return image.cols == camera_.width() && image.rows == camera_.height();
    });
    cv::remap(left, rectified_left, left_map_[0], left_map_[1], cv::INTER_LINEAR);
    cv::remap(right, rectified_right, right_map_[0], right_map_[1], cv::INTER_LINEAR);
  }

 private:
  struct Solution {
    cv::Matx33d left_rotation, right_rotation;      ///< rectified from as it is
    cv::Matx34d left_projection, right_projection;  ///< the right one's last column has -f b
  };

  StereoRectification(const Camera& left, const Camera& right, const Solution& solution)
      : camera_(solution.left_projection(0, 0), solution.left_projection(1, 1), solution.left_projection(0, 2),
                solution.left_projection(1, 2), left.width(), left.height()),
        baseline_m_(-solution.right_projection(0, 3) / solution.right_projection(0, 0)) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        rectified_from_left_.linear()(row, column) = solution.left_rotation(row, column);
    make_maps(left, solution.left_rotation, solution.left_projection, left_map_);
    make_maps(right, solution.right_rotation, solution.right_projection, right_map_);
  }

  static Solution solve(const Camera& left, const Camera& right, const Pose& right_from_left) {
    if (left.width() != right.width() || left.height() != right.height())
      throw Error("stereo: found cameras of " + size_of(left) + " and " + size_of(right) +
                  " pixels, expected equal sizes");
    if (!right_from_left.matrix().allFinite())
      throw Error("stereo: found a pose between the cameras that is not finite, expected a rotation and a translation");
    // In the left camera's axes: where the right one stands.
    const Vector3d p_left = right_from_left.inverse().translation();
    if (!(p_left.x() > 0 && p_left.x() > std::abs(p_left.y()) && p_left.x() > std::abs(p_left.z())))
      throw Error("stereo: found the right camera at x " + std::to_string(p_left.x()) + ", y " +
                  std::to_string(p_left.y()) + ", z " + std::to_string(p_left.z()) +
                  " m of the left one, expected it to the right: x positive and the largest");
    constexpr double kCropped = 0.0;  // nothing is shown that a camera did not see
    Solution solution;
    cv::Matx33d rotation;
    cv::Vec3d translation;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) rotation(row, column) = right_from_left.linear()(row, column);
      translation[row] = right_from_left.translation()[row];
    }
    cv::stereoRectify(matrix(left), coefficients(left), matrix(right), coefficients(right),
                      cv::Size(left.width(), left.height()), rotation, translation, solution.left_rotation,
                      solution.right_rotation, solution.left_projection, solution.right_projection, cv::noArray(),
                      cv::CALIB_ZERO_DISPARITY, kCropped);
    return solution;
  }

  static cv::Matx33d matrix(const Camera& camera) {
    return {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
  }

  static cv::Vec<double, 5> coefficients(const Camera& camera) {
    const auto& model = camera.distortion().model;
    if (std::holds_alternative<NoDistortion>(model)) return {0, 0, 0, 0, 0};
    if (const auto* lens = std::get_if<BrownConrady>(&model)) return {lens->k1, lens->k2, lens->p1, lens->p2, lens->k3};
    throw Error("stereo: found an equidistant lens, expected radial and tangential distortion or none");
  }

  static void make_maps(const Camera& camera, const cv::Matx33d& rotation, const cv::Matx34d& projection,
                        cv::Mat (&maps)[2]) {
    cv::initUndistortRectifyMap(matrix(camera), coefficients(camera), rotation, projection,
                                cv::Size(camera.width(), camera.height()), CV_16SC2, maps[0], maps[1]);
  }

  static std::string size_of(const Camera& camera) {
    return std::to_string(camera.width()) + " x " + std::to_string(camera.height());
  }

  Camera camera_;
  double baseline_m_;
  Pose rectified_from_left_ = Pose::Identity();
  cv::Mat left_map_[2], right_map_[2];
};

}  // namespace stillpoint
