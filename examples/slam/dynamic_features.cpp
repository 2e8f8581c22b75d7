// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "dynamic_features.hpp"

#include <algorithm>
#include <cmath>

namespace examples::slam {

namespace {

/// Squared error of a feature in standard deviations, by where its point should be.
/// @param p, p_sigma_m  in the frame's camera: the point, and one standard deviation along a ray
/// @param sigma_m       in any direction
double squared_deviation(const Vector3d& p, const Vector3d& p_sigma_m, double sigma_m, const Frame& frame, int feature,
                         const Camera& camera, const MeasurementNoise& noise) {
  const auto i = static_cast<std::size_t>(feature);
  const double across_m = std::hypot(p_sigma_m.head<2>().norm(), sigma_m);
  const double pixel_sigma = std::hypot(noise.pixel(frame, feature), camera.fx() * across_m / p.z());
  const double of_pixel = (camera.project(p) - frame.pixel[i]).squaredNorm() / (pixel_sigma * pixel_sigma);
  if (!(frame.depth_m[i] > 0)) return of_pixel;
  const double depth_sigma_m = std::hypot(noise.depth_m(frame.depth_m[i]), p_sigma_m.z(), sigma_m);
  return of_pixel + std::pow((p.z() - frame.depth_m[i]) / depth_sigma_m, 2);
}

constexpr double kChiSquared = 11.34;  // 99 % of right ones are below, three degrees of freedom

}  // namespace

bool deviates(const MapPoint& point, const Frame& frame, int feature, const Camera& camera,
              const MeasurementNoise& noise) {
  const Vector3d p = frame.camera_from_world * point.p_world;
  if (!(p.z() > 0)) return false;
  const Vector3d sigma_m = frame.camera_from_world.linear() * point.sigma_m();
  return squared_deviation(p, sigma_m, 0.0, frame, feature, camera, noise) > kChiSquared;
}

bool has_moved(const MapPoint& point, const Map& map, const Frame& frame, int feature, const Camera& camera,
               const MeasurementNoise& noise, double pose_sigma_m) {
  if (!map.has(point.first.keyframe)) return false;
  const Keyframe& first = map.keyframe(point.first.keyframe);
  const Pose camera_from_first = frame.camera_from_world * first.camera_from_world.inverse();
  const Vector3d p = camera_from_first * point.first.p_camera;
  if (!(p.z() > 0)) return false;
  const double first_pixel_m = noise.pixel_sigma * point.first.p_camera.z() / camera.fx();
  return squared_deviation(p, camera_from_first.linear() * point.first.ray_sigma_m,
                           std::hypot(pose_sigma_m, first_pixel_m), frame, feature, camera, noise) > kChiSquared;
}

std::vector<std::uint8_t> DynamicFeatures::operator()(const Frame& frame, const Map& map, span<const PointId> local,
                                                      const MeasurementNoise& noise) const {
  enum : std::uint8_t { kNoVote, kStatic, kDynamic };
  std::vector<PointId> established;
  for (const PointId id : local)
    if (map.has_point(id) && map.point(id).observations.size() >= options.fewest_observations)
      established.push_back(id);
  std::vector<PointMatch> matches;
  options.search(map, established, camera_, frame.camera_from_world, frame, matches);
  std::vector<std::uint8_t> vote(frame.size(), kNoVote);
  for (const PointMatch& match : matches) {
    const MapPoint& point = map.point(match.point);
    const bool is_dynamic = deviates(point, frame, match.feature, camera_, noise) ||
                            has_moved(point, map, frame, match.feature, camera_, noise, options.pose_sigma_m);
    vote[static_cast<std::size_t>(match.feature)] = is_dynamic ? kDynamic : kStatic;
  }

  // A single match may be wrong; several on one surface hardly are.
  std::vector<std::uint8_t> result(frame.size(), 0);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (vote[i] != kDynamic) continue;
    std::size_t votes = 0, dynamic = 0;
    frame.grid.near(frame.pixel[i], options.neighbour_px, [&](int feature) {
      const auto k = static_cast<std::size_t>(feature);
      const bool is_near = (frame.pixel[k] - frame.pixel[i]).norm() < options.neighbour_px;
      const bool is_same_surface =
          !(frame.depth_m[i] > 0 && frame.depth_m[k] > 0) ||
          std::abs(frame.depth_m[k] - frame.depth_m[i]) < options.neighbour_depth * frame.depth_m[i];
      if (vote[k] == kNoVote || !is_near || !is_same_surface) return;
      ++votes;
      dynamic += vote[k] == kDynamic;
    });
    result[i] = dynamic >= options.fewest_votes &&
                static_cast<double>(dynamic) >= options.majority * static_cast<double>(votes);
  }
  return result;
}

}  // namespace examples::slam
