// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/prior/image_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"

namespace stillpoint::image_motion_test {
namespace {

constexpr double kFocal_px = 500.0, kTurn_rad = 0.04, kInfinity = std::numeric_limits<double>::infinity();
constexpr float kRounding_px = 1e-3f;
const Camera kCamera(kFocal_px, kFocal_px, 320, 240, 640, 480);
const Vector2f kCentre(320, 240);

/// A camera that turns to the left by 0.04 rad, and goes to the left by 0.1 m.
ImageMotion turned(bool is_metric) {
  Motion motion;
  motion.metric = is_metric;
  motion.current_from_reference.linear() = rotation_from_vector(Vector3d(0, kTurn_rad, 0));
  motion.current_from_reference.translation().x() = 0.1;
  ImageMotion image;
  image.set_camera_motion(motion, kCamera);
  return image;
}

// What is far moves by f tan 0.04 = 20.01 px; at 2 m by f · 0.1 / (2 cos 0.04) = 25.02 px more.
TEST(ImageMotion, AStaticPointGoesWithTheTurnAndByItsDepthWithTheShift) {
  const float turn_px = static_cast<float>(kFocal_px * std::tan(kTurn_rad));
  const float shift_px = static_cast<float>(kFocal_px * 0.1 / (2.0 * std::cos(kTurn_rad)));
  const ImageMotion image = turned(true);
  ASSERT_TRUE(image.knows_camera());
  EXPECT_NEAR(image.static_step(kCentre, kInfinity).x(), turn_px, kRounding_px);
  EXPECT_NEAR(image.static_step(kCentre, 2.0).x(), turn_px + shift_px, kRounding_px);
  EXPECT_NEAR(image.static_step(kCentre, 2.0).y(), 0.0f, kRounding_px);
}

TEST(ImageMotion, AMotionWithoutScaleIsATurn) {
  const ImageMotion image = turned(false);
  EXPECT_NEAR(image.static_step(kCentre, 2.0).x(), static_cast<float>(kFocal_px * std::tan(kTurn_rad)), kRounding_px);
}

TEST(ImageMotion, WhatComesBehindTheCameraGoesNowhere) {
  Motion motion;
  motion.current_from_reference.translation().z() = -3.0;
  ImageMotion image;
  image.set_camera_motion(motion, kCamera);
  EXPECT_EQ(image.static_step(kCentre, 2.0), Vector2f(0, 0));
}

}  // namespace
}  // namespace stillpoint::image_motion_test
