// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where does a past frame show a point that stands still, and which depth is measured there?

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/match/surface_search.hpp"

namespace stillpoint {

/// The place of a static point in a past frame.
struct StaticPlace {
  Vector3d point = Vector3d::Zero();  ///< in the past camera, metres
  Vector2f pixel = Vector2f::Zero();  ///< in the image as it is
  double nearer_than_m = 0;           ///< what is nearer hides the point
  bool in_view = false;               ///< in front of the camera and inside the image
  Observation observation;            ///< state and depth; nothing is found yet
};

/// Looks at static places.
struct PlaceTest {
  double occlusion_sigmas = 4.0;  ///< of both depths, by which what hides the point is nearer, besides 15 cm
  GuardedDepth guard;             ///< which depth of a past frame belongs to a pixel?

  /// By how much a surface that hides the point must be nearer.
  /// @param sigma_m  of the difference of both depths
  double margin_m(double sigma_m) const noexcept { return kOcclusion_m + occlusion_sigmas * sigma_m; }

  /// @param point          in the current camera, metres
  /// @param depth_sigma_m  of that point's depth
  template <class Camera, class Noise>
  StaticPlace reproject(const FrameView& past, const Pose& past_from_current, const Vector3d& point,
                        double depth_sigma_m, const Camera& camera, const Noise& noise) const {
    StaticPlace place;
    place.point = past_from_current * point;
    if (!(place.point.z() > SurfaceSearch::kNearest_m)) return place;
    place.pixel = image_pixel(camera, place.point);
    if (!(past.gray.border_distance_px(place.pixel.x(), place.pixel.y()) >= 1.0f)) return place;
    place.in_view = true;
    const double sigma_m = noise.sigma(place.point.z());
    place.nearer_than_m = place.point.z() - margin_m(std::sqrt(sigma_m * sigma_m + depth_sigma_m * depth_sigma_m));
    const double measured_m = guard.at(past, place.pixel, noise);
    if (!(measured_m > 0)) return place;
    place.observation.depth_m = static_cast<float>(measured_m);
    place.observation.depth_sigma_m = static_cast<float>(noise.sigma(measured_m));
    place.observation.state = measured_m < place.nearer_than_m ? ObservationState::occluded : ObservationState::seen;
    return place;
  }

 private:
  static constexpr double kOcclusion_m = 0.15;
};

namespace detail {

/// Is a pixel of a 3 × 3 grid with such a spacing nearer? Depths are in the units of the image; what would lie outside
/// is taken at the border. All nine are read before the first decides, so that none waits for another.
template <class Depth>
bool any_nearer(const ImageView& depth, int u, int v, int across, int down, Depth nearer_than) noexcept {
  const auto inside = [](int at, int size) { return std::min(std::max(at, 0), size - 1); };
  const int left = inside(u - across, depth.width), middle = inside(u, depth.width),
            right = inside(u + across, depth.width);
  const auto is_nearer = [nearer_than](Depth there) { return (there > 0) & (there < nearer_than); };
  const Depth* const above = depth.row<Depth>(inside(v - down, depth.height));
  const Depth* const here = depth.row<Depth>(inside(v, depth.height));
  const Depth* const below = depth.row<Depth>(inside(v + down, depth.height));
  return is_nearer(above[left]) | is_nearer(above[middle]) | is_nearer(above[right]) | is_nearer(here[left]) |
         is_nearer(here[middle]) | is_nearer(here[right]) | is_nearer(below[left]) | is_nearer(below[middle]) |
         is_nearer(below[right]);
}

/// `beside_occluder` in a depth image of one type.
template <class Depth>
bool beside_nearer(const ImageView& depth, const DepthScale& to_depth, const Vector2f& pixel, Depth nearer_than,
                   int reach_px) noexcept {
  const Vector2f at = to_depth(pixel);
  const int u = rounded(at.x()), v = rounded(at.y());
  const auto in_ring = [&](int ring_px) {
    const int across = std::max(1, rounded(to_depth.x * static_cast<float>(ring_px)));
    const int down = std::max(1, rounded(to_depth.y * static_cast<float>(ring_px)));
    return any_nearer(depth, u, v, across, down, nearer_than);
  };
  return in_ring((reach_px + 1) / 2) || in_ring(reach_px);
}

}  // namespace detail

/// Does something nearer lie within reach of a pixel? What a mover has just uncovered looks changed and stood still.
inline bool beside_occluder(const FrameView& frame, const Vector2f& pixel, double nearer_than_m,
                            int reach_px) noexcept {
  if (frame.depth.empty() || reach_px <= 0) return false;
  const ImageView& depth = frame.depth.image;
  const DepthScale to_depth(frame.gray, depth);
  if (depth.format != PixelFormat::depth16)
    return detail::beside_nearer(depth, to_depth, pixel, static_cast<float>(nearer_than_m), reach_px);
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  const auto nearer_than =
      static_cast<std::uint16_t>(std::clamp(std::ceil(nearer_than_m * frame.depth.factor), 0.0, kMost));
  return detail::beside_nearer(depth, to_depth, pixel, nearer_than, reach_px);
}

template <class Visit>
void each_option(PlaceTest& test, Visit& visit) {
  visit("occlusion_sigmas", test.occlusion_sigmas, OptionRange{0, 100});
  if constexpr (sees_code_only<Visit>::value) visit("guard", test.guard);
}

}  // namespace stillpoint
