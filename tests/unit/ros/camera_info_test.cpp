// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// K and the lens models, and the lenses that are refused.

#include "stillpoint_ros/camera_info.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "unit/error_of.hpp"

namespace stillpoint_ros::camera_info_test {

using stillpoint::error_of;

CameraInfo info(const std::string& model = "", std::vector<double> d = {}) {
  return {1.0, 640, 480, {525, 0, 320, 0, 526, 241, 0, 0, 1}, model, std::move(d)};
}

void expect_intrinsics(const stillpoint::Camera& camera, double fx, double fy, double cx, double cy) {
  EXPECT_EQ(camera.fx(), fx);
  EXPECT_EQ(camera.fy(), fy);
  EXPECT_EQ(camera.cx(), cx);
  EXPECT_EQ(camera.cy(), cy);
  EXPECT_EQ(camera.width(), 640);
  EXPECT_EQ(camera.height(), 480);
}

TEST(CameraInfo, HasTheIntrinsicsRowByRow) { expect_intrinsics(camera_of(info()), 525, 526, 320, 241); }

TEST(CameraInfo, CoefficientsOfZeroAreNoLens) {
  for (const char* model : {"plumb_bob", "rational_polynomial", "equidistant", "whatever"})
    EXPECT_TRUE(std::holds_alternative<stillpoint::NoDistortion>(distortion_of(info(model, {0, 0, 0, 0, 0})).model));
}

TEST(CameraInfo, LensesHaveTheirCoefficientsInRosOrder) {
  for (const auto& [model, d] : {std::pair<const char*, std::vector<double>>{"plumb_bob", {.1, .2, .3, .4, .5}},
                                 {"rational_polynomial", {.1, .2, .3, .4, .5, 0, 0, 0}}}) {
    const auto lens = std::get<stillpoint::BrownConrady>(distortion_of(info(model, d)).model);
    EXPECT_EQ(lens.k1, .1);
    EXPECT_EQ(lens.k2, .2);
    EXPECT_EQ(lens.p1, .3);
    EXPECT_EQ(lens.p2, .4);
    EXPECT_EQ(lens.k3, .5);
  }
  EXPECT_EQ(std::get<stillpoint::BrownConrady>(distortion_of(info("plumb_bob", {.1, .2, .3, .4})).model).k3, 0);
  const auto fisheye = std::get<stillpoint::EquidistantFisheye>(distortion_of(info("equidistant", {1, 2, 3, 4})).model);
  EXPECT_EQ(fisheye.k1, 1);
  EXPECT_EQ(fisheye.k4, 4);
}

TEST(CameraInfo, OfARectifiedImageItIsPWithoutALens) {
  CameraInfo both = info("rational_polynomial", {.1, 0, 0, 0, 0, .2, 0, 0});
  both.p = {501, 0, 311, -40, 0, 502, 231, 0, 0, 0, 1, 0};  // with Tx, as of a right camera
  const stillpoint::Camera camera = camera_of(both, true);
  expect_intrinsics(camera, 501, 502, 311, 231);
  EXPECT_TRUE(std::holds_alternative<stillpoint::NoDistortion>(camera.distortion().model));
  for (const double fx : {0.0, -1.0}) {
    both.p[0] = fx;
    EXPECT_EQ(error_of([&] { camera_of(both, true); }),
              "camera_info: fx of P is " + std::string(fx == 0 ? "0" : "-1") +
                  ", expected the projection matrix P of a calibrated camera, which the parameter rectified uses");
  }
  both.p[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { camera_of(both, true); }), "no error");
  both.p = {501, 0, 311, 0, 0, 0, 231, 0, 0, 0, 1, 0};
  EXPECT_NE(error_of([&] { camera_of(both, true); }), "no error") << "fy is 0";
}

TEST(CameraInfo, WhatHasNoModelIsRefused) {
  EXPECT_EQ(
      error_of([] {
        camera_of(info("rational_polynomial", {.1, 0, 0, 0, 0, .2, 0, 0}));
      }),
      "camera_info: distortion_model is rational_polynomial with coefficient 5 not 0, expected at most five; "
      "rectify images of another lens with image_proc and set the parameter rectified (stillpoint_run: --rectified)");
  EXPECT_EQ(
      error_of([] { camera_of(info("double_sphere", {.1})); }),
      "camera_info: distortion_model is 'double_sphere', expected plumb_bob or equidistant; "
      "rectify images of another lens with image_proc and set the parameter rectified (stillpoint_run: --rectified)");
  CameraInfo uncalibrated = info();
  uncalibrated.k = {};
  EXPECT_EQ(error_of([&] { camera_of(uncalibrated); }),
            "camera_info: fx is 0, expected the camera matrix K of a calibrated camera");
  CameraInfo broken = info();
  broken.k[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { camera_of(broken); }), "no error");
}

// Half-way to the border of 640 x 480, 160 px from the middle: fx of 525 and 526 are 160 / 525 = 0.305 px apart there,
// 525 and 525.8 are 0.244 px.
TEST(CameraInfo, CamerasShowAlikeWithinTheNoiseOfACorner) {
  const auto camera = [](double fx, double cx, stillpoint::AnyDistortion lens = {stillpoint::NoDistortion{}}) {
    return stillpoint::Camera(fx, 525, cx, 240, 640, 480, std::move(lens));
  };
  EXPECT_TRUE(show_alike(camera(525, 320), camera(525.8, 320)));
  EXPECT_FALSE(show_alike(camera(525, 320), camera(526, 320)));
  EXPECT_TRUE(show_alike(camera(525, 320), camera(525, 320.2)));
  EXPECT_FALSE(show_alike(camera(525, 320), camera(525, 320.3)));
  EXPECT_FALSE(show_alike(camera(525, 320), camera(525, 320, {stillpoint::BrownConrady{0.1, 0, 0, 0, 0}})));
  EXPECT_FALSE(show_alike(camera(525, 320), stillpoint::Camera(525, 525, 320, 240, 640, 360)));
  // 120 px above the middle: fy of 525 and 527 are 0.46 px apart there.
  EXPECT_FALSE(show_alike(camera(525, 320), stillpoint::Camera(525, 527, 320, 240, 640, 480)));
  EXPECT_FALSE(show_alike(camera(525, 320), stillpoint::Camera(525, 525, 320, 240.3, 640, 480)));
}

TEST(CameraInfo, IsTheSameCameraWhateverTheTime) {
  CameraInfo later = info();
  later.stamp_s = 2;
  EXPECT_TRUE(is_same_camera(info(), later));
  for (const auto change :
       {+[](CameraInfo& i) { i.k[4] = 1; }, +[](CameraInfo& i) { i.width = 1; }, +[](CameraInfo& i) { i.d = {1}; },
        +[](CameraInfo& i) { i.p[5] = 1; }, +[](CameraInfo& i) { i.distortion_model = "x"; }}) {
    CameraInfo other = info();
    change(other);
    EXPECT_FALSE(is_same_camera(info(), other));
  }
}

}  // namespace stillpoint_ros::camera_info_test
