// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/street.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "stillpoint/stereo/stereo_depth.hpp"
#include "stillpoint/synthetic/realistic_scenes.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/stereo.hpp"
#include "stillpoint/synthetic/truth.hpp"
#include "unit/error_of.hpp"

namespace stillpoint::synthetic::street_test {
namespace {

constexpr double kBend_m = 23.0;

SceneOptions seeded(std::uint64_t seed) {
  SceneOptions options = car_options();
  options.seed = seed;
  return options;
}

TEST(StreetFromCar, HasTheCameraOfTheDescription) {
  SceneOptions full;
  full.width = 1240;
  full.height = 376;
  EXPECT_DOUBLE_EQ(street_from_car(full).camera.fx(), 720.0);
  const Scene scene = street_from_car();
  EXPECT_DOUBLE_EQ(scene.camera.fx(), 360.0);
  EXPECT_EQ(scene.camera.width(), 620);
  EXPECT_EQ(scene.frame_rate_hz, 10.0);
  full.width = 8;
  EXPECT_EQ(error_of([&] { street_from_car(full); }), "scene: size is 8 x 376, expected at least 16 x 16 pixels");
}

// 5 frames at 0 Hz are a street without an end: no memory is enough for its houses.
TEST(StreetFromCar, FramesAndTheirRateAreChecked) {
  for (const double rate_hz : {0.0, -10.0, std::numeric_limits<double>::infinity()}) {
    SceneOptions options;
    options.frame_rate_hz = rate_hz;
    EXPECT_EQ(error_of([&] { street_from_car(options); }),
              "scene: frame_rate_hz is " + std::to_string(rate_hz) + ", expected a finite number above 0");
    EXPECT_EQ(error_of([&] { five_people(options); }),
              "scene: frame_rate_hz is " + std::to_string(rate_hz) + ", expected a finite number above 0");
  }
  SceneOptions none;
  none.frames = 0;
  EXPECT_EQ(error_of([&] { street_from_car(none); }), "scene: frames is 0, expected at least 1");
}

TEST(StreetFromCar, GoesOneMetrePerFrame) {
  SyntheticSequence sequence(street_from_car(seeded(2)));
  SyntheticFrame frame;
  Pose world_from_last = Pose::Identity();
  for (int i = 0; i < 4; ++i) {
    sequence.render(i, frame);
    EXPECT_NEAR(frame.timestamp_s, 1.0 + 0.1 * i, 1e-12);
    if (i > 0) {
      EXPECT_LT((frame.world_from_camera.translation() - world_from_last.translation() - Vector3d(0, 0, 1)).norm(),
                1e-9);
    }
    world_from_last = frame.world_from_camera;
  }
}

// In the bend the way of a metre is a chord of 2 · 23 sin(1 / 46) = 0.99992 m and turns by 1 / 23 rad = 2.5 degrees.
// The car nods by 1.5 mrad (root mean square of an axis), so that two frames differ by several of them.
TEST(StreetFromCar, TurnsInTheBend) {
  const Scene scene = street_from_car(seeded(1), kBend_m);
  for (int i = 0; i < 29; ++i) {
    const Pose last_from_now =
        scene.camera_path.world_from_camera(0.1 * i).inverse() * scene.camera_path.world_from_camera(0.1 * (i + 1));
    EXPECT_NEAR(last_from_now.translation().norm(), i < 10 ? 1.0 : 2 * kBend_m * std::sin(0.5 / kBend_m), 1e-6) << i;
    EXPECT_NEAR(rotation_angle(last_from_now.linear()), i < 10 ? 0.0 : 1 / kBend_m, 0.01) << i;
  }
  const Vector3d ahead = scene.camera_path.world_from_camera(3.0).linear().col(2);
  EXPECT_GT(ahead.x(), 0.7);  // to the right, by 20 / 23 rad
}

TEST(StreetFromCar, NothingMovesAndParkedCarsAreSeen) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const double bend_m : {0.0, kBend_m}) {
      const Scene scene = street_from_car(seeded(seed), bend_m);
      EXPECT_TRUE(scene.movers.empty());
      SyntheticSequence sequence(scene);
      SyntheticFrame frame;
      ImageBuffer cars;
      int parked = 0;
      for (const int i : {0, 14, 29}) {
        sequence.render(i, frame);
        labels_of(scene, kParkedCar, frame, cars);
        for (int v = 0; v < 188; ++v)
          for (int u = 0; u < 620; ++u) {
            ASSERT_EQ(frame.labels.row<std::uint8_t>(v)[u], kStatic);
            parked += cars.row<std::uint8_t>(v)[u] == kStatic;
          }
        std::vector<cv::KeyPoint> keypoints;
        cv::ORB::create(1000)->detect(as_mat(frame.gray.view()), keypoints);
        EXPECT_GT(keypoints.size(), 600u) << i;
      }
      EXPECT_GT(parked, 3 * 188 * 620 / 50);  // 2 %
    }
}

TEST(StreetFromCar, ParkedCarsHaveIdentifiersOfTheirOwnOnALongWayToo) {
  SceneOptions options = seeded(1);
  options.frames = 150;
  const std::vector<Solid> furniture = street_from_car(options).furniture;
  for (std::size_t k = 254; k < furniture.size(); ++k) EXPECT_EQ(furniture[k].name, "") << k;
}

TEST(StreetFromCar, CarsLaneIsFree) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const double bend_m : {0.0, kBend_m}) {
      const Scene scene = street_from_car(seeded(seed), bend_m);
      for (double t = 0; t < 3; t += 0.1) {
        const Vector3d eye = scene.camera_path.world_from_camera(t).translation();
        for (const Solid& solid : scene.furniture) {
          if (solid.shape == Shape::room) continue;
          const Vector3d p_solid = solid.object_from_solid.inverse() * (eye + Vector3d(0, 0.8, 0));
          EXPECT_GT((p_solid.cwiseAbs() - solid.half_extents).maxCoeff(), 0.7) << t;  // of the car's bonnet
        }
      }
    }
}

// Noise of the disparity has 0.3 px where the surface is away from edges; what only one of the two cameras sees has no
// depth.
TEST(StreetFromCar, DepthHasTheNoiseOfAStereoPair) {
  const Scene scene = street_from_car();
  SyntheticFrame frame;
  SyntheticSequence(scene).render(10, frame);
  const double focal_times_baseline = 360.0 * kCarBaseline_m;
  double squares = 0;
  int count = 0, lost = 0;
  for (int v = 2; v < 186; ++v)
    for (int u = 2; u < 618; ++u) {
      const double exact_m = static_cast<double>(frame.exact_depth.row<float>(v)[u]);
      const double measured_m = frame.depth.row<std::uint16_t>(v)[u] / frame.depth_factor;
      if (!(exact_m < 40.0)) continue;
      if (!(measured_m > 0)) {
        ++lost;
        continue;
      }
      const double error_px = focal_times_baseline / measured_m - focal_times_baseline / exact_m;
      if (std::abs(error_px) > 1.5) continue;  // flying pixels
      squares += error_px * error_px;
      ++count;
    }
  EXPECT_GT(count, 50000);
  EXPECT_NEAR(std::sqrt(squares / count), 0.3, 0.03);
  EXPECT_GT(lost, count / 200);
  EXPECT_LT(lost, count / 10);
}

TEST(StreetFromCar, BlockMatchingFindsTheExactDepth) {
  const Scene scene = street_from_car();
  SyntheticFrame left, right;
  SyntheticSequence(scene).render(10, left);
  SyntheticSequence(right_of(scene, kCarBaseline_m)).render(10, right);
  StereoDepth::Options options;
  options.nearest_m = 4.0;
  cv::Mat depth_m;
  StereoDepth(scene.camera, kCarBaseline_m, options)
      .compute(as_mat(left.gray.view()), as_mat(right.gray.view()), depth_m);
  std::vector<double> errors_px;
  int seen = 0;
  for (int v = 0; v < 188; ++v)
    for (int u = 0; u < 620; ++u) {
      const double exact_m = static_cast<double>(left.exact_depth.row<float>(v)[u]);
      const double found_m = static_cast<double>(depth_m.at<float>(v, u));
      if (!(exact_m > 4.0 && exact_m < 40.0)) continue;
      ++seen;
      if (found_m > 0) errors_px.push_back(std::abs(360.0 * kCarBaseline_m * (1 / found_m - 1 / exact_m)));
    }
  ASSERT_GT(static_cast<int>(errors_px.size()), seen / 2);
  std::sort(errors_px.begin(), errors_px.end());
  EXPECT_LT(errors_px[errors_px.size() / 2], 0.3);
  EXPECT_LT(errors_px[errors_px.size() * 9 / 10], 2.0);
}

}  // namespace
}  // namespace stillpoint::synthetic::street_test
