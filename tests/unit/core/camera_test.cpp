// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::camera_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// fx ≠ fy and cx ≠ cy, so that no exchange of axes goes unseen.
const Camera kCamera(500.0, 400.0, 320.0, 230.0, 640, 480);

TEST(PinholeCamera, ProjectsByHand) {
  // u = 500 · 0.4 / 2 + 320 = 420, v = 400 · (−0.3) / 2 + 230 = 170
  EXPECT_EQ(kCamera.project({0.4, -0.3, 2.0}), Vector2d(420, 170));
  Matrix3d k;
  k << 500, 0, 320, 0, 400, 230, 0, 0, 1;
  EXPECT_EQ(kCamera.matrix(), k);
}

// Eq. 4 and 5: P = π⁻¹(p, d). x = (420 − 320) / 500 · 2 = 0.4, y = (170 − 230) / 400 · 2 = −0.3.
TEST(PinholeCamera, BackProjectsByHand) {
  EXPECT_LE((kCamera.back_project({420, 170}, 2.0) - Vector3d(0.4, -0.3, 2.0)).norm(), 1e-15);
}

// To the plane z = 1 and back it would be rounded.
TEST(PinholeCamera, WithoutALensAPixelIsUndistortedToTheBit) {
  const Camera camera(525.3, 524.7, 319.5, 239.1, 640, 480);
  const PinholeCamera<NoDistortion> ideal(525.3, 524.7, 319.5, 239.1, 640, 480);
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d pixel(random.uniform(0, 640), random.uniform(0, 480));
    ASSERT_EQ(camera.undistort(pixel), pixel);
    ASSERT_EQ(camera.distort(pixel), pixel);
    ASSERT_EQ(ideal.undistort(pixel), pixel);
    ASSERT_EQ(ideal.distort(pixel), pixel);
  }
}

TEST(PinholeCamera, ProjectUndoesBackProject) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d pixel(random.uniform(-100, 740), random.uniform(-100, 580));
    const double depth_m = random.uniform(0.05, 50.0);
    const Vector3d point = kCamera.back_project(pixel, depth_m);
    EXPECT_EQ(point.z(), depth_m);
    EXPECT_LE((kCamera.project(point) - pixel).norm(), 1e-10);  // rounding of numbers of some hundred
  }
}

TEST(PinholeCamera, LensWorksOnPixels) {
  // One radial coefficient: the plane point (0.5, 0) has r² = 0.25, so that x_d = 0.5 · (1 − 0.2 · 0.25) = 0.475;
  // in pixels 320 + 500 · 0.5 = 570 becomes 320 + 500 · 0.475 = 557.5.
  BrownConrady lens;
  lens.k1 = -0.2;
  const Camera camera(500, 400, 320, 230, 640, 480, {lens});
  EXPECT_LE((camera.distort({570, 230}) - Vector2d(557.5, 230)).norm(), 1e-12);
  EXPECT_LE((camera.undistort({557.5, 230}) - Vector2d(570, 230)).norm(), 1e-9);
  EXPECT_EQ(kCamera.distort({570, 230}), Vector2d(570, 230));
}

TEST(PinholeCamera, RefusesWhatIsNoCameraAndSaysWhy) {
  const auto camera = [](double fx, double fy, double cx, double cy, int width, int height) {
    return error_of([=] { Camera(fx, fy, cx, cy, width, height); });
  };
  EXPECT_EQ(camera(500, 400, 320, 230, 640, 480), "no error");
  EXPECT_EQ(camera(0, 400, 320, 230, 640, 480), "camera: fx is 0, expected a positive focal length in pixels");
  EXPECT_EQ(camera(500, -1, 320, 230, 640, 480), "camera: fy is -1, expected a positive focal length in pixels");
  EXPECT_EQ(camera(kNaN, 400, 320, 230, 640, 480), "camera: fx is nan, expected a positive focal length in pixels");
  EXPECT_EQ(camera(500, kInfinity, 320, 230, 640, 480),
            "camera: fy is inf, expected a positive focal length in pixels");
  EXPECT_EQ(camera(500, 400, kNaN, 230, 640, 480), "camera: cx is nan, expected a finite principal point in pixels");
  EXPECT_EQ(camera(500, 400, 320, -kInfinity, 640, 480),
            "camera: cy is -inf, expected a finite principal point in pixels");
  EXPECT_EQ(camera(500, 400, 320, 230, 0, 480), "camera: width is 0, expected a positive number of pixels");
  EXPECT_EQ(camera(500, 400, 320, 230, 640, -480), "camera: height is -480, expected a positive number of pixels");
}

TEST(PinholeCamera, RefusesALensThatIsNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    for (int c = 0; c < 5; ++c) {
      double k[5] = {-0.3, 0.1, 0.001, 0.001, 0.0};
      k[c] = bad;
      const BrownConrady lens{k[0], k[1], k[2], k[3], k[4]};
      EXPECT_NE(error_of([&] { Camera(500, 400, 320, 230, 640, 480, {lens}); }).find("distortion"), std::string::npos)
          << "coefficient " << c << " is " << bad;
    }
    for (int c = 0; c < 4; ++c) {
      double k[4] = {};
      k[c] = bad;
      const EquidistantFisheye lens{k[0], k[1], k[2], k[3]};
      EXPECT_NE(error_of([&] { Camera(500, 400, 320, 230, 640, 480, {lens}); }).find("distortion"), std::string::npos)
          << "coefficient " << c << " is " << bad;
    }
  }
}

TEST(PinholeCamera, AnImagesPixelAndThePointThatItShowsAreInverses) {
  const Camera fisheye(200, 210, 319, 241, 640, 480, EquidistantFisheye{0.01, -0.002, 0.001, 0.0});
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3d point(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(1.0, 3.0));
    const Vector2f pixel = image_pixel(fisheye, point);
    EXPECT_LT((point_at_depth(fisheye, pixel, point.z()) - point).norm(), 1e-5) << "the pixel is a float";
  }
  // 400 · 0.5 / 2 + 320 for the pinhole; the fisheye sees atan 0.25 = 0.245 rad.
  const Camera equidistant(400, 400, 320, 240, 640, 480, EquidistantFisheye{});
  EXPECT_NEAR(image_pixel(equidistant, {0.5, 0, 2}).x(), 320 + 400 * std::atan(0.25), 1e-4);
}

}  // namespace
}  // namespace stillpoint::camera_test
