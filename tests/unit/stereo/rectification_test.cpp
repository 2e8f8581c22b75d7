// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/stereo/rectification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::rectification_test {
namespace {

constexpr int kWidth = 320, kHeight = 240;

Camera pinhole() { return Camera(260, 260, 159.5, 119.5, kWidth, kHeight); }

Pose beside(double x_m) { return Pose(Eigen::Translation3d(-x_m, 0, 0)); }

/// Two unlike cameras with lenses, turned and not quite on one line.
struct Rig {
  Camera left{260, 258, 162, 117, kWidth, kHeight, {BrownConrady{-0.28, 0.07, 0.0002, 0.00002, 0.0}}};
  Camera right{264, 262, 156, 121, kWidth, kHeight, {BrownConrady{-0.25, 0.06, -0.0003, 0.0004, 0.01}}};
  Pose right_from_left = Pose::Identity();

  Rig() {
    right_from_left.linear() = rotation_from_vector({0.02, -0.03, 0.015});
    right_from_left.translation() = Vector3d(-0.11, 0.004, 0.006);
  }
};

/// Images whose values are their own coordinates: what a map fetches says where it fetches it.
struct Ramps {
  cv::Mat u, v;

  Ramps() : u(kHeight, kWidth, CV_32FC1), v(kHeight, kWidth, CV_32FC1) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        u.at<float>(y, x) = static_cast<float>(x);
        v.at<float>(y, x) = static_cast<float>(y);
      }
  }
};

/// Value between pixels.
double sample(const cv::Mat& image, const Vector2d& at) {
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  const double a = at.x() - u, b = at.y() - v;
  const auto pixel = [&image](int y, int x) { return static_cast<double>(image.at<float>(y, x)); };
  return (1 - b) * ((1 - a) * pixel(v, u) + a * pixel(v, u + 1)) +
         b * ((1 - a) * pixel(v + 1, u) + a * pixel(v + 1, u + 1));
}

TEST(StereoRectification, AlignedPinholesStayAsTheyAre) {
  const StereoRectification rectification(pinhole(), pinhole(), beside(0.12));
  EXPECT_NEAR(rectification.baseline_m(), 0.12, 1e-9);
  EXPECT_TRUE(rectification.rectified_from_left().isApprox(Pose::Identity(), 1e-9));
  EXPECT_NEAR(rectification.camera().fx(), 260, 1e-6);
  EXPECT_NEAR(rectification.camera().fy(), 260, 1e-6);
  // OpenCV centres what both see: the principal point may move, the same in both images.
  EXPECT_NEAR(rectification.camera().cx(), 159.5, 1.0);
  EXPECT_NEAR(rectification.camera().cy(), 119.5, 1.0);
}

TEST(StereoRectification, BaselineIsTheDistanceOfTheCameras) {
  const Rig rig;
  const StereoRectification rectification(rig.left, rig.right, rig.right_from_left);
  EXPECT_NEAR(rectification.baseline_m(), rig.right_from_left.translation().norm(), 1e-9);
  // The rectified x axis points at the right camera.
  const Vector3d p_rectified = rectification.rectified_from_left() * rig.right_from_left.inverse().translation();
  EXPECT_TRUE(p_rectified.isApprox(Vector3d(rectification.baseline_m(), 0, 0), 1e-9)) << p_rectified.transpose();
}

// A point seen by both cameras, projected by our own model of lens and pinhole: the rectified images must show it in
// one row, f b / z pixels apart. OpenCV's maps have steps of 1/32 px, and between pixels of a map it is interpolated.
TEST(StereoRectification, PointsLieInOneRowAtTheirDisparity) {
  constexpr double kMapStep_px = 1.0 / 32, kInterpolation_px = 0.02;
  const Rig rig;
  const StereoRectification rectification(rig.left, rig.right, rig.right_from_left);
  const Ramps ramps;
  cv::Mat left_u, left_v, right_u, right_v;
  rectification.rectify(ramps.u, ramps.u, left_u, right_u);
  rectification.rectify(ramps.v, ramps.v, left_v, right_v);
  Random random(5);
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p_left(random.uniform(-2, 2), random.uniform(-1.5, 1.5), random.uniform(1, 5));
    const Vector3d p_rectified = rectification.rectified_from_left() * p_left;
    const Vector2d left = rectification.camera().project(p_rectified);
    const Vector2d right =
        left - Vector2d(rectification.camera().fx() * rectification.baseline_m() / p_rectified.z(), 0);
    if (!(right.x() > 1 && left.x() < kWidth - 2 && left.y() > 1 && left.y() < kHeight - 2)) continue;
    ++count;
    const Vector2d in_left = rig.left.distort(rig.left.project(p_left));
    const Vector2d in_right = rig.right.distort(rig.right.project(rig.right_from_left * p_left));
    EXPECT_NEAR(sample(left_u, left), in_left.x(), kMapStep_px + kInterpolation_px);
    EXPECT_NEAR(sample(left_v, left), in_left.y(), kMapStep_px + kInterpolation_px);
    EXPECT_NEAR(sample(right_u, right), in_right.x(), kMapStep_px + kInterpolation_px);
    EXPECT_NEAR(sample(right_v, right), in_right.y(), kMapStep_px + kInterpolation_px);
  }
  EXPECT_GT(count, 300);
}

TEST(StereoRectification, ShowsNoBlackRims) {
  const Rig rig;
  const cv::Mat white(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  cv::Mat left, right;
  StereoRectification(rig.left, rig.right, rig.right_from_left).rectify(white, white, left, right);
  EXPECT_EQ(cv::countNonZero(left < 255), 0);
  EXPECT_EQ(cv::countNonZero(right < 255), 0);
}

TEST(StereoRectification, ImagesOfAnotherSizeAreNamed) {
  const StereoRectification rectification(pinhole(), pinhole(), beside(0.1));
  const cv::Mat whole(kHeight, kWidth, CV_8UC1, cv::Scalar(255)), half(kHeight / 2, kWidth / 2, CV_8UC1);
  cv::Mat left, right;
  EXPECT_EQ(error_of([&] { rectification.rectify(half, whole, left, right); }),
            "stereo: found a left image of 160 x 120 pixels and 1 channel(s), expected the cameras' 320 x 240");
  EXPECT_EQ(error_of([&] { rectification.rectify(whole, half, left, right); }),
            "stereo: found a right image of 160 x 120 pixels and 1 channel(s), expected the cameras' 320 x 240");
}

TEST(StereoRectification, PairsThatAreNoneAreNamed) {
  const auto message = [](const Camera& left, const Camera& right, const Pose& right_from_left) {
    return error_of([&] { StereoRectification(left, right, right_from_left); });
  };
  EXPECT_EQ(message(pinhole(), Camera(260, 260, 159, 119, kWidth, 200), beside(0.1)),
            "stereo: found cameras of 320 x 240 and 320 x 200 pixels, expected equal sizes");
  const Camera fisheye(260, 260, 159, 119, kWidth, kHeight, {EquidistantFisheye{}});
  EXPECT_EQ(message(pinhole(), fisheye, beside(0.1)),
            "stereo: found an equidistant lens, expected radial and tangential distortion or none");
  const auto starts = [](const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; };
  const std::string to_the_left = message(pinhole(), pinhole(), beside(-0.1));
  EXPECT_TRUE(starts(to_the_left, "stereo: found the right camera at x -0.100000, y ")) << to_the_left;
  EXPECT_NE(to_the_left.find(" m of the left one, expected it to the right: x positive and the largest"),
            std::string::npos);
  const std::string below = message(pinhole(), pinhole(), Pose(Eigen::Translation3d(-0.1, -0.2, 0)));
  EXPECT_TRUE(starts(below, "stereo: found the right camera at x 0.100000, y 0.200000, z ")) << below;
  EXPECT_EQ(message(pinhole(), pinhole(), beside(std::numeric_limits<double>::quiet_NaN())),
            "stereo: found a pose between the cameras that is not finite, expected a rotation and a translation");
}

}  // namespace
}  // namespace stillpoint::rectification_test
