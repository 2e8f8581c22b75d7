// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Where the next frame is expected, and what of the map a lens lets in.

#include "slam/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "made_map.hpp"
#include "slam/point_search.hpp"

namespace slam_test {
namespace {

/// A map of 60 points, of which the camera at 0 was the last that was followed.
class TrackingTest : public testing::Test {
 protected:
  TrackingTest() { follow(0.0); }

  void follow(double x_m) { tracking_.go_on_from(made_frame(points_, camera_at(x_m)), map_, 0); }

  double expected_x_m() const { return -tracking_.expected_camera_from_world(map_).translation().x(); }

  const std::vector<Vector3d> points_ = made_points(60);
  slam::Map map_ = made_map(points_, 2);
  slam::Tracking tracking_{camera()};
};

TEST_F(TrackingTest, FoundAnewItHasNoVelocity) {
  slam::Frame frame = made_frame(points_, camera_at(0.4));
  ASSERT_TRUE(tracking_.locate_by(0, camera_at(0.4), frame, map_, slam::MeasurementNoise{}));
  tracking_.go_on_from(frame, map_, slam::kNone);
  slam::Frame next = made_frame({}, camera_at(0));
  tracking_.locate(next, map_, slam::MeasurementNoise{});  // of which nothing is told
  EXPECT_NEAR(expected_x_m(), 0.4, 1e-3) << "0.4 m were no step";
}

TEST_F(TrackingTest, WhatIsToldHoldsForTheComingFrame) {
  tracking_.expect_motion(camera_at(0.1));
  follow(0.0);  // a first keyframe is looked for nowhere
  slam::Frame next = made_frame({}, camera_at(0));
  tracking_.locate(next, map_, slam::MeasurementNoise{});
  EXPECT_NEAR(expected_x_m(), 0.0, 1e-12);
}

/// A point 2 m ahead of a camera at the origin, that was first seen from there.
slam::Projection projected(const stillpoint::Camera& camera, const Vector2d& undistorted) {
  slam::MapPoint point;
  point.p_world = camera.back_project(undistorted, 2.0);
  point.normal = -point.p_world.normalized();
  point.scale_distance_m = point.p_world.norm();
  return slam::project(point, camera, Pose::Identity(), 0.5);
}

// Pixels of a lens are not those of the plane on which points lie: a fisheye of 300 px shows the plane's column 2000.
TEST(Project, AllThatTheLensShowsIsInTheImage) {
  const stillpoint::Camera fisheye(300, 300, 319.5, 239.5, 640, 480, stillpoint::EquidistantFisheye{});
  for (double v = 10; v < 480; v += 20)
    for (double u = 10; u < 640; u += 20) {
      const Vector2d undistorted = fisheye.undistort({u, v});
      const slam::Projection seen = projected(fisheye, undistorted);
      EXPECT_TRUE(seen.is_visible) << u << ' ' << v;
      EXPECT_LT((seen.pixel - undistorted).norm(), 1e-6);
    }
}

// x' = x (1 + k1 r²): the plane's column 5 is at x = -0.786, r² = 0.618, in the image at 319.5 - 400 · 0.932 = -53.
TEST(Project, WhatTheLensPushesOutIsNot) {
  const stillpoint::Camera pincushion(400, 400, 319.5, 239.5, 640, 480, stillpoint::BrownConrady{0.3});
  EXPECT_FALSE(projected(pincushion, {5, 239.5}).is_visible);
  EXPECT_TRUE(projected(pincushion, {100, 239.5}).is_visible);
}

TEST(MeasurementNoise, GrowsWithTheOctaveAndAsTheLensStretches) {
  slam::Frame frame = made_frame(made_points(2), camera_at(0));
  frame.features.keypoints[1].octave = 2;
  const slam::MeasurementNoise noise;
  EXPECT_NEAR(noise.pixel(frame, 0), 0.5, 1e-12);
  EXPECT_NEAR(noise.pixel(frame, 1), 0.5 * 1.44, 1e-12);
  frame.lens_stretch = {3.0, 2.0};
  EXPECT_NEAR(noise.pixel(frame, 1), 0.5 * 1.44 * 2.0, 1e-12);
  EXPECT_NEAR(noise.pixel_to_point(frame, 0, 3), 1.5 * std::sqrt(4.0 / 3.0), 1e-12);
}

}  // namespace
}  // namespace slam_test
