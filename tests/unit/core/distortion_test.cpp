// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/distortion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

// TUM RGB-D, freiburg1 and freiburg2, and EuRoC's left camera: strong but real lenses.
constexpr BrownConrady kFreiburg1{0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
constexpr BrownConrady kFreiburg2{0.2312, -0.7849, -0.0033, -0.0001, 0.9172};
constexpr BrownConrady kEuroc{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0};
constexpr EquidistantFisheye kFisheye{-0.013293, 0.040302, -0.036427, 0.012307};

Camera freiburg1() { return {517.3, 516.5, 318.6, 255.3, 640, 480, {kFreiburg1}}; }
Camera freiburg2() { return {520.9, 521.0, 325.1, 249.7, 640, 480, {kFreiburg2}}; }
Camera euroc() { return {458.654, 457.296, 367.215, 248.375, 752, 480, {kEuroc}}; }
Camera fisheye() { return {300.0, 298.0, 371.2, 243.6, 752, 480, {kFisheye}}; }  // 85 degrees in the corners

TEST(BrownConrady, DistortsByHand) {
  // (0.5, 0.2): r² = 0.29, radial = 1 + 0.1 · 0.29 + 0.01 · 0.29² + 0.001 · 0.29³ = 1.029865389
  // x = 0.5149326945 + 2 · 0.02 · 0.1 + 0.03 · (0.29 + 0.5) = 0.5426326945
  // y = 0.2059730778 + 0.02 · (0.29 + 0.08) + 2 · 0.03 · 0.1 = 0.2193730778
  const BrownConrady lens{0.1, 0.01, 0.02, 0.03, 0.001};
  EXPECT_LE((lens.distort({0.5, 0.2}) - Vector2d(0.5426326945, 0.2193730778)).norm(), 1e-15);
}

TEST(BrownConrady, JacobianEqualsFiniteDifferences) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const BrownConrady lens{random.uniform(-0.4, 0.4), random.uniform(-0.9, 0.9), random.uniform(-0.01, 0.01),
                            random.uniform(-0.01, 0.01), random.uniform(-1.0, 1.0)};
    const Vector2d at(random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6));
    constexpr double h = 1e-6;
    Eigen::Matrix2d numeric;
    numeric.col(0) = (lens.distort(at + Vector2d(h, 0)) - lens.distort(at - Vector2d(h, 0))) / (2 * h);
    numeric.col(1) = (lens.distort(at + Vector2d(0, h)) - lens.distort(at - Vector2d(0, h))) / (2 * h);
    EXPECT_LE((lens.jacobian(at) - numeric).norm(), 1e-8);  // h² times the third derivative, rounding / h
  }
}

TEST(Fisheye, DistortsByHand) {
  // The ray (1, 0, 1) has θ = π/4; without coefficients θ_d = θ, with k1 = 0.1 it is θ (1 + 0.1 θ²).
  const double theta = std::atan(1.0);
  EXPECT_LE((EquidistantFisheye{}.distort({1, 0}) - Vector2d(theta, 0)).norm(), 1e-15);
  EXPECT_LE(
      (EquidistantFisheye{0.1, 0, 0, 0}.distort({0, -1}) - Vector2d(0, -theta * (1 + 0.1 * theta * theta))).norm(),
      1e-15);
  EXPECT_EQ(EquidistantFisheye{}.distort({0, 0}), Vector2d(0, 0));
  EXPECT_EQ(EquidistantFisheye{}.undistort({0, 0}), Vector2d(0, 0));
}

std::vector<cv::Point3d> points_before(const Camera& camera, double margin_px) {
  Random random(7);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = camera.back_project({random.uniform(-margin_px, camera.width() + margin_px),
                                            random.uniform(-margin_px, camera.height() + margin_px)},
                                           random.uniform(0.3, 10.0));
    points.emplace_back(p.x(), p.y(), p.z());
  }
  return points;
}

constexpr double kSamePixel = 1e-8;  // both sides compute in double; the same formula up to the order of operations

TEST(BrownConrady, AgreesWithOpenCVsProjection) {
  for (const Camera& camera : {freiburg1(), freiburg2(), euroc()}) {
    const auto& lens = std::get<BrownConrady>(camera.distortion().model);
    const std::vector<double> coefficients = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
    const cv::Matx33d k(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
    const std::vector<cv::Point3d> points = points_before(camera, 0.0);
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), k, coefficients, expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2d pixel = camera.distort(camera.project({points[i].x, points[i].y, points[i].z}));
      ASSERT_LE(std::hypot(pixel.x() - expected[i].x, pixel.y() - expected[i].y), kSamePixel);
    }
  }
}

TEST(Fisheye, AgreesWithOpenCVsProjection) {
  const Camera camera = fisheye();
  const cv::Matx33d k(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
  const cv::Vec4d coefficients(kFisheye.k1, kFisheye.k2, kFisheye.k3, kFisheye.k4);
  const std::vector<cv::Point3d> points = points_before(camera, 2000.0);
  std::vector<cv::Point2d> expected;
  cv::fisheye::projectPoints(points, expected, cv::Vec3d(), cv::Vec3d(), k, coefficients);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d pixel = camera.distort(camera.project({points[i].x, points[i].y, points[i].z}));
    ASSERT_LE(std::hypot(pixel.x() - expected[i].x, pixel.y() - expected[i].y), kSamePixel);
  }
}

TEST(Distortion, UndistortInvertsDistortOverTheWholeImage) {
  for (const Camera& camera : {freiburg1(), freiburg2(), euroc(), fisheye()}) {
    for (int v = 0; v < camera.height(); v += 5) {
      for (int u = 0; u < camera.width(); u += 5) {
        const Vector2d image(u, v), ideal = camera.undistort(image);
        // What a keypoint needs: the pixel that the lens makes of the ideal one is the pixel that was seen.
        ASSERT_LE((camera.distort(ideal) - image).norm(), 1e-7) << "fx " << camera.fx() << " at " << u << ", " << v;
        ASSERT_LE((camera.undistort(camera.distort(ideal)) - ideal).norm(), 1e-6) << u << ", " << v;
      }
    }
  }
}

TEST(Distortion, ALensIsTheLastArgumentOfACamera) {
  const BrownConrady lens{-0.3, 0.1, 0.001, -0.001};
  const Camera camera(500, 500, 320, 240, 640, 480, lens);
  EXPECT_EQ(camera.distortion().distort({0.3, 0.2}), lens.distort({0.3, 0.2}));
  const Camera fisheye(500, 500, 320, 240, 640, 480, EquidistantFisheye{0.1, 0, 0, 0});
  EXPECT_FALSE(has_no_lens(fisheye.distortion()));
  EXPECT_TRUE(has_no_lens(Camera(500, 500, 320, 240, 640, 480).distortion()));
}

/// As of KITTI's raw images and of a RealSense that ROS calibrated: both hold over the image, and fold back beyond it.
Camera folding(double k1, double k2, double k3) {
  return Camera(525, 525, 319.5, 239.5, 640, 480, BrownConrady{k1, k2, 0.0005, -0.0003, k3});
}

TEST(Distortion, WhatIsFartherAsideIsFartherOutAlsoWhereTheModelFoldsBack) {
  for (const Camera& camera : {folding(-0.37, 0.2, -0.07), folding(0.1, -0.25, 0.0), folding(-0.3, 0.0, 0.0),
                               freiburg1(), euroc(), fisheye()}) {
    for (const double side : {0.0, 0.8, 2.5, 4.2}) {  // direction of the ray in the image, radians
      double before_px = -1;
      for (double aside = 0.0; aside < 1.55; aside += 0.002) {
        const Vector3d ray(std::cos(side) * std::sin(aside), std::sin(side) * std::sin(aside), std::cos(aside));
        const Vector2d pixel = camera.distort(camera.project(ray));
        const double radius_px = (pixel - Vector2d(camera.cx(), camera.cy())).norm();
        ASSERT_GE(radius_px, before_px - 0.02) << "fx " << camera.fx() << ", " << aside;  // the tangential part tilts
        before_px = radius_px;
      }
    }
  }
}

// k1 = -0.3: r (1 - 0.3 r²) grows until r² = 1 / 0.9, where it is 2 / 3 r. 60 degrees aside, r is 1.7321: 1.6432 times
// that radius, and so 1.6432 * 525 * 2 / 3 * 1.0541 = 606.2 px out. The polynomial had 90.9 px, within the image.
TEST(Distortion, BeyondTheFoldARayKeepsItsShare) {
  const Camera camera(525, 525, 319.5, 239.5, 640, 480, BrownConrady{-0.3, 0, 0, 0, 0});
  const Vector2d pixel = camera.distort(camera.project({std::sqrt(3.0), 0.0, 1.0}));
  EXPECT_NEAR(pixel.x(), 319.5 + 606.2, 0.5);  // the fold is found within 2 mrad
  EXPECT_EQ(pixel.y(), 239.5);
  EXPECT_NEAR(fold_radius(BrownConrady{-0.3, 0, 0, 0, 0}), std::sqrt(1 / 0.9), 0.005);
  EXPECT_FALSE(std::isfinite(fold_radius(BrownConrady{0.1, 0, 0, 0, 0})));
  EXPECT_FALSE(std::isfinite(fold_radius(EquidistantFisheye{})));
}

// An equidistant fisheye shows θ: 1 rad of it is 1 / cos² θ on the plane, 4 times as much 60 degrees aside.
TEST(Distortion, StretchIsThatOfThePlaneTowardsTheBorder) {
  const Camera camera(300, 300, 320, 240, 640, 480, EquidistantFisheye{});
  EXPECT_NEAR(lens_stretch(camera, {320, 240}), 1.0, 1e-5);
  EXPECT_NEAR(lens_stretch(camera, {320 + 300 * std::sqrt(3.0), 240}), 4.0, 0.02);
  EXPECT_NEAR(lens_stretch(camera, {320, 240 - 300 * std::sqrt(3.0)}), 4.0, 0.02);
  EXPECT_EQ(lens_stretch(Camera(525, 525, 320, 240, 640, 480), {17.3, 11.9}), 1.0);
  EXPECT_LE(lens_stretch(camera, {1e9, 0}), 1000.0);
}

TEST(Distortion, UndistortIsFiniteWhereThereIsNoInverse) {
  // k1 < 0 alone folds back where 1 + 3 k1 r² = 0: nothing is distorted to a radius beyond 2 r / 3.
  const BrownConrady folding{-0.5, 0, 0, 0, 0};
  for (const double x : {0.5, 0.6, 1.0, 3.0, 1e3, 1e6, 1e30}) {
    EXPECT_TRUE(folding.undistort({x, 0.1}).allFinite()) << x;
    EXPECT_TRUE(kFisheye.undistort({x, 0.1}).allFinite()) << x;
  }
  const AnyDistortion none{};
  EXPECT_EQ(none.undistort({3, 4}), Vector2d(3, 4));
}

}  // namespace
}  // namespace stillpoint
