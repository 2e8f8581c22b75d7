// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a depth sensor makes of exact depth.
//
// Exact depth and light on the surface → 16-bit depth with axial noise, disparity steps, mixed or ragged rims, shadows
// and holes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "stillpoint/core/image.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/synthetic/noise.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// How each pixel's surface is lit, row-major.
struct SurfaceLight {
  SurfaceLight(const float* cosine_of_incidence) : cosine(cosine_of_incidence) {}

  const float* cosine;                ///< of the angle between ray and surface normal, in [0, 1]
  const float* returned = nullptr;    ///< infrared albedo times cosine, 0 on specular surfaces; for `least_return`
  const std::uint8_t* lit = nullptr;  ///< 0 where the projector does not see the surface; for `projector_baseline_m`
};

/// Kinect v1: a structured-light camera that measures disparity in steps of 1/8 px; or a stereo pair.
/// Source: Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data", Sensors 2012 (focal length 580 px,
/// base 75 mm); Nguyen et al., 3DIMPVT 2012, for the noise (see `KinectNoise`).
class DepthSensor {
 public:
  explicit DepthSensor(const Sensor& options) : options_(options) {}

  /// @param exact   depth32f, metres, 0 = none
  /// @param light   of the surface at each pixel; rules whose image is missing fall back to the simpler ones
  /// @param depth   gets the measured depth, depth16
  /// Equal seeds give equal bytes.
  void measure(const ImageView& exact, const SurfaceLight& light, const NormalTable& table, std::uint64_t seed,
               ImageBuffer& depth) const {
    depth.resize(exact.width, exact.height, PixelFormat::depth16);
    NormalStream normal(table, seed);
    Random random(seed ^ 0x5ad0u);
    const bool knows_shadows = options_.projector_baseline_m > 0 && light.lit != nullptr;
    const bool knows_return = options_.least_return > 0 && light.returned != nullptr;
    for (int v = 0; v < exact.height; ++v) {
      const float* const row = exact.row<float>(v);
      const std::ptrdiff_t row_begin = static_cast<std::ptrdiff_t>(v) * exact.width;
      std::uint16_t* const out = depth.row<std::uint16_t>(v);
      int shadow_px = 0;
      float shadowed_m = 0.0f;
      for (int u = exact.width - 1; u >= 0; --u) {  // from the right: shadows fall to the left of nearer objects
        const std::ptrdiff_t at = row_begin + u;
        float z = row[u];
        bool lost = !(z > 0.0f);
        if (options_.depth_holes) {
          if (knows_shadows) {
            lost = lost || light.lit[at] == 0;
          } else if (u + 1 < exact.width && z - row[u + 1] > jump(z)) {
            shadow_px = 2 + static_cast<int>(random.index(3));
            shadowed_m = z;
          }
          lost = lost || (shadow_px > 0 && shadowed_m - z < jump(z)) || !(static_cast<double>(z) >= options_.nearest_m);
          if (shadow_px > 0) --shadow_px;
          if (knows_return)
            lost = lost || !(static_cast<double>(light.returned[at]) > options_.least_return);
          else if (!options_.stereo_noise)
            lost = lost || grazes(light.cosine[at], random);
          z = options_.flying_pixel_share > 0 ? mixed(exact, u, v, random) : ragged(exact, u, v, random);
          lost = lost || !(z > 0.0f);
        }
        if (options_.depth_noise) z = noisy(z, normal.next());
        out[u] = lost || !(static_cast<double>(z) <= options_.farthest_m) ? std::uint16_t{0} : quantised(z);
      }
    }
  }

 private:
  /// What counts as an edge between two surfaces, metres.
  static float jump(float depth_m) noexcept { return 0.06f + 0.02f * depth_m; }

  /// Nothing comes back beyond 84 degrees, all below 78, in between by chance.
  static bool grazes(float cosine, Random& random) noexcept {
    constexpr float kNone = 0.105f, kAll = 0.208f;
    if (cosine >= kAll) return false;
    return !(cosine > kNone) || random.uniform() > static_cast<double>((cosine - kNone) / (kAll - kNone));
  }

  /// At an edge: the depth of a pixel nearby, so that rims are ragged by about a pixel.
  static float ragged(const ImageView& exact, int u, int v, Random& random) noexcept {
    const float z = exact.row<float>(v)[u];
    if (u < 2 || v < 2 || u + 2 >= exact.width || v + 2 >= exact.height) return z;
    const float* const row = exact.row<float>(v);
    const float limit = jump(z);
    const auto differs = [z, limit](float other) { return !(std::abs(other - z) <= limit); };
    if (!differs(row[u - 1]) && !differs(row[u + 1]) && !differs(exact.row<float>(v - 1)[u]) &&
        !differs(exact.row<float>(v + 1)[u]))
      return z;
    const int du = static_cast<int>(random.index(3)) - 1, dv = static_cast<int>(random.index(3)) - 1;
    return exact.row<float>(v + dv)[u + du];
  }

  /// Near an edge: by chance a mix of both sides.
  float mixed(const ImageView& exact, int u, int v, Random& random) const {
    const float z = exact.row<float>(v)[u], other = beyond_edge(exact, u, v);
    if (!(other > 0.0f) || !(random.uniform() < options_.flying_pixel_share)) return z;
    return z + static_cast<float>(random.uniform()) * (other - z);
  }

  /// Depth on the other side of the nearest edge within 2 px along the row or the column, 0 where there is none. An
  /// edge lies between neighbours that differ by more than 10 sigma of the farther one.
  float beyond_edge(const ImageView& exact, int u, int v) const {
    constexpr int kReach_px = 2;
    constexpr double kEdge_sigma = 10.0;
    constexpr int kWays[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int step = 1; step <= kReach_px; ++step)
      for (const auto& [du, dv] : kWays) {
        const int x = u + step * du, y = v + step * dv;
        if (x < 0 || y < 0 || x >= exact.width || y >= exact.height) continue;
        const float here = exact.row<float>(y - dv)[x - du], there = exact.row<float>(y)[x];
        const double limit_m = kEdge_sigma * sigma(static_cast<double>(std::max(here, there)));
        if (there > 0.0f && static_cast<double>(std::abs(there - here)) > limit_m) return there;
      }
    return 0.0f;
  }

  double sigma(double depth_m) const noexcept {
    return options_.stereo_noise ? options_.stereo_noise->sigma(depth_m) : KinectNoise{}.sigma(depth_m);
  }

  float noisy(float depth_m, float deviate) const noexcept {
    if (!(depth_m > 0.0f)) return depth_m;
    const auto z = static_cast<double>(depth_m), n = static_cast<double>(deviate);
    return options_.stereo_noise ? noisy_stereo(z, n) : noisy_kinect(z, n);
  }

  float noisy_stereo(double depth_m, double deviate) const noexcept {
    const StereoNoise& pair = *options_.stereo_noise;
    const double focal_times_baseline = pair.focal_px * pair.baseline_m;
    const double disparity_px = focal_times_baseline / depth_m + pair.disparity_sigma_px * deviate;
    return disparity_px > 0 ? static_cast<float>(focal_times_baseline / disparity_px) : 0.0f;
  }

  /// Gaussian noise and disparity steps which together have the standard deviation of the model: the steps alone have
  /// step / √12.
  float noisy_kinect(double depth_m, double deviate) const noexcept {
    const bool has_steps = options_.disparity_step_px > 0;
    const double units = has_steps ? 1.0 / options_.disparity_step_px * 580.0 * 0.075 : 0.0;  // disparity at 1 m
    const double sigma = KinectNoise{}.sigma(depth_m), step = has_steps ? depth_m * depth_m / units : 0.0;
    const double gaussian_sigma = std::sqrt(std::max(0.0, sigma * sigma - step * step / 12.0));
    const double measured = depth_m + gaussian_sigma * deviate;
    if (!has_steps) return static_cast<float>(measured);
    // Disparity in steps: n = units / z, so that one step of n changes z by z² / units.
    const double disparity = std::floor(units / measured + 0.5);
    return static_cast<float>(units / std::max(1.0, disparity));
  }

  std::uint16_t quantised(float depth_m) const noexcept {
    const double units = static_cast<double>(depth_m) * options_.depth_factor + 0.5;
    constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
    return units < kMost ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }

  Sensor options_;
};

}  // namespace stillpoint::synthetic
