// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A street of house fronts and parked cars, seen by the stereo camera of a car that drives along it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/synthetic/path.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scene.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::synthetic {

/// From the left camera of the car to the right one, metres: as on KITTI's car.
inline constexpr double kCarBaseline_m = 0.54;
/// Name of the parked cars, for `labels_of`.
inline constexpr char kParkedCar[] = "parked car";

/// Half of the size of KITTI's images, at 10 Hz: focal length 360 px, three seconds.
inline SceneOptions car_options() {
  SceneOptions options;
  options.width = 620;
  options.height = 188;
  options.frames = 30;
  options.frame_rate_hz = 10.0;
  return options;
}

namespace detail {

/// The middle of a street: straight on, or through a right angle to the right and on.
struct Centreline {
  double straight_m = 10.0;  ///< before the bend
  double radius_m = 0.0;     ///< of the bend; 0: there is none

  /// @param way_m  along the middle   @param side_m  to the right of it   Axes: x right, y down, z along the street.
  Pose world_from_street(double way_m, double side_m = 0.0) const {
    constexpr double kRightAngle = 1.5707963267948966;
    const double turn = radius_m > 0 ? std::clamp((way_m - straight_m) / radius_m, 0.0, kRightAngle) : 0.0;
    const double beyond_m = turn > 0 ? way_m - straight_m - radius_m * turn : way_m - straight_m;
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(turn, Vector3d::UnitY()).toRotationMatrix();
    pose.translation() = Vector3d(radius_m * (1 - std::cos(turn)), 0, straight_m + radius_m * std::sin(turn)) +
                         pose.linear() * Vector3d(side_m, 0, beyond_m);
    return pose;
  }
};

inline TextureStyle street_style(Ground ground, std::vector<Bgr> colours, double cell_m, double largest_mark_m,
                                 double smallest_mark_m, double coverage) {
  return {ground, std::move(colours), cell_m, largest_mark_m, smallest_mark_m, coverage};
}

/// What houses, cars and road are painted with.
struct StreetPaint {
  TexturePtr sky, asphalt, paving, marking, tyres;
  std::vector<TexturePtr> fronts, cars;
};

inline StreetPaint street_paint(Random& random) {
  const auto surface = [&random](int size_px, double texels_per_metre, const TextureStyle& style) {
    return paint(size_px, texels_per_metre, style, random.bits());
  };
  StreetPaint result;
  result.sky = surface(64, 1, street_style(Ground::plain, {{235, 225, 215}}, 10, 10, 10, 0));
  result.asphalt = surface(
      1024, 48, street_style(Ground::plain, {{104, 104, 106}, {84, 84, 86}, {126, 126, 126}}, 2, 0.8, 0.05, 0.08));
  result.paving = surface(
      512, 64, street_style(Ground::tiles, {{150, 152, 156}, {120, 122, 126}, {176, 178, 180}}, 0.5, 0.4, 0.06, 0.1));
  result.marking = surface(64, 32, street_style(Ground::plain, {{225, 225, 225}, {200, 200, 200}}, 1, 0.3, 0.1, 0.1));
  result.tyres = surface(64, 64, street_style(Ground::plain, {{40, 40, 40}, {60, 60, 60}}, 1, 0.2, 0.1, 0.1));
  for (const Bgr& wall : {Bgr{150, 180, 205}, {190, 195, 200}, {120, 140, 190}, {160, 190, 180}})
    result.fronts.push_back(surface(  // repeats every 4 m, as windows do
        256, 64,
        street_style(Ground::blocks, {wall, {70, 60, 50}, {235, 235, 235}, {90, 100, 140}, {50, 50, 60}}, 1.5, 1.6,
                     0.08, 0.16)));
  for (const Bgr& colour : {Bgr{60, 50, 160}, {190, 190, 190}, {140, 90, 50}})
    result.cars.push_back(surface(
        256, 64,
        street_style(Ground::blocks, {colour, {40, 40, 40}, {230, 230, 230}, {90, 90, 100}}, 0.7, 0.6, 0.05, 0.14)));
  return result;
}

/// Houses and parked cars on both sides; the road between x = -3 and 3 m is free.
inline std::vector<Solid> street(const Centreline& middle, double length_m, std::uint64_t seed) {
  constexpr double kBehind_m = 20.0, kAhead_m = 100.0, kSky_m = 600.0;
  Random random(seed);
  const StreetPaint paint = street_paint(random);
  std::vector<Solid> solids;
  Solid sky_and_road(Shape::room, {kSky_m, 0.5 * kSky_m, kSky_m}, {0, -0.5 * kSky_m, 0}, paint.sky);
  sky_and_road.textures[3] = paint.asphalt;  // the face at the positive end of y: below
  solids.push_back(sky_and_road);
  const auto add = [&](const Vector3d& half_extents, double side_m, double way_m, double middle_height_m,
                       const TexturePtr& texture, const char* name = "") {
    Solid solid(Shape::cuboid, half_extents, Vector3d::Zero(), texture);
    solid.object_from_solid = middle.world_from_street(way_m, side_m) * Eigen::Translation3d(0, -middle_height_m, 0);
    solid.name = name;
    solids.push_back(solid);
  };
  for (double way_m = -kBehind_m; way_m < length_m + kAhead_m; way_m += 4.0) {
    add({0.06, 0.004, 0.75}, 1.8, way_m, 0.004, paint.marking);
    for (const double side : {-1.0, 1.0}) add({2.5, 0.06, 2.2}, side * 7.5, way_m, 0.06, paint.paving);
  }
  for (const double side : {-1.0, 1.0}) {
    for (double way_m = -kBehind_m; way_m < length_m + kAhead_m;) {
      const double half_width_m = random.uniform(4.0, 7.0), half_height_m = random.uniform(3.0, 6.0);
      const double half_depth_m = 4.0, front_m = random.uniform(8.0, 9.0);
      add({half_depth_m, half_height_m, half_width_m}, side * (front_m + half_depth_m), way_m + half_width_m,
          half_height_m, paint.fronts[random.index(paint.fronts.size())]);
      way_m += 2 * half_width_m + (random.uniform() < 0.3 ? random.uniform(1.0, 4.0) : 0.0);
    }
    for (double way_m = -kBehind_m; way_m < length_m + kAhead_m; way_m += random.uniform(5.5, 12.0)) {
      const double side_m = side * random.uniform(3.9, 4.1);
      const TexturePtr& colour = paint.cars[random.index(paint.cars.size())];
      add({0.85, 0.30, 2.10}, side_m, way_m, 0.60, colour, kParkedCar);
      add({0.75, 0.28, 1.10}, side_m, way_m - 0.2, 1.18, colour, kParkedCar);
      add({0.78, 0.15, 1.60}, side_m, way_m, 0.15, paint.tyres, kParkedCar);
    }
  }
  // Named objects first: identifiers of their own (`SyntheticFrame::furniture_ids`) are few.
  std::stable_partition(solids.begin(), solids.end(), [](const Solid& solid) { return !solid.name.empty(); });
  return solids;
}

/// One way point for each metre.
inline Path drive(const Centreline& middle, double length_m, double metres_per_s, double eye_m) {
  std::vector<Waypoint> waypoints;
  for (int i = 0; i <= static_cast<int>(std::ceil(length_m)); ++i) {
    const Pose pose = middle.world_from_street(i);
    const Vector3d ahead = pose.linear().col(2);
    waypoints.push_back(
        {i / metres_per_s, pose.translation() - Vector3d(0, eye_m, 0), std::atan2(ahead.x(), ahead.z()), 0.0, 0.0});
  }
  return Path(waypoints, Blend::linear);
}

}  // namespace detail

/// A car drives along a street at 10 m/s; nothing else moves. The camera is the left one of a stereo pair, 1.65 m above
/// the road, with the angle of view of KITTI's (f 720 px at a width of 1240 px). `depth` is what a stereo pair would
/// measure: noise of `StereoNoise`, none where the right camera does not see the surface. For depth by block matching
/// render `right_of(scene, kCarBaseline_m)`, too, and hand both images to `StereoDepth` (nearest_m 4).
/// @param bend_radius_m  after 10 m the street goes through a right angle with this radius; 0: straight on
/// @throws Error unless the size is at least 16 pixels a side, and frames and their rate are at least one and more than
/// 0.
inline Scene street_from_car(const SceneOptions& options = car_options(), double bend_radius_m = 0.0) {
  constexpr double kSpeed_m_per_s = 10.0, kEye_m = 1.65, kLeastDisparity_px = 2.0;
  detail::require(options);
  const double focal_px = 720.0 * options.width / 1240.0, seconds = options.frames / options.frame_rate_hz;
  const double length_m = kSpeed_m_per_s * seconds;
  Scene scene;
  scene.name = "street_from_car";
  detail::Centreline middle;
  middle.radius_m = bend_radius_m;
  scene.camera =
      Camera(focal_px, focal_px, 0.5 * (options.width - 1), 0.5 * (options.height - 1), options.width, options.height);
  // The car nods and sways, but its place is exact.
  scene.camera_path = {detail::drive(middle, length_m, kSpeed_m_per_s, kEye_m), {0.0, 0.0015, options.seed + 2}};
  scene.furniture = detail::street(middle, length_m, options.seed + 1);
  scene.sensor.stereo_noise = StereoNoise{focal_px, kCarBaseline_m, 0.3};
  scene.sensor.projector_baseline_m = kCarBaseline_m;
  scene.sensor.flying_pixel_share = 0.5;
  scene.sensor.depth_factor = 500.0;  // 16 bit up to 131 m
  scene.sensor.farthest_m = std::min(130.0, focal_px * kCarBaseline_m / kLeastDisparity_px);
  scene.frame_count = options.frames;
  scene.frame_rate_hz = options.frame_rate_hz;
  scene.seed = options.seed;
  return scene;
}

}  // namespace stillpoint::synthetic
