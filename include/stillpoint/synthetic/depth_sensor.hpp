// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a Kinect makes of exact depth.
//
// Exact depth and angle of incidence → 16-bit depth with axial noise, disparity steps, ragged rims, shadows and holes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "stillpoint/core/depth_noise.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/noise.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// Kinect v1: a structured-light camera that measures disparity in steps of 1/8 px.
/// Source: Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data", Sensors 2012 (focal length 580 px,
/// base 75 mm); Nguyen et al., 3DIMPVT 2012, for the noise (see `KinectNoise`).
class DepthSensor {
 public:
  explicit DepthSensor(const Sensor& options) : options_(options) {}

  /// @param exact   depth32f, metres, 0 = none
  /// @param cosine  row-major, of the angle between ray and surface normal, in [0, 1]
  /// @param depth   gets the measured depth, depth16
  /// Equal seeds give equal bytes.
  void measure(const ImageView& exact, const float* cosine, const NormalTable& table, std::uint64_t seed,
               ImageBuffer& depth) const {
    depth.resize(exact.width, exact.height, PixelFormat::depth16);
    NormalStream normal(table, seed);
    Random random(seed ^ 0x5ad0u);
    for (int v = 0; v < exact.height; ++v) {
      const float* const row = exact.row<float>(v);
      const float* const cosine_row = cosine + static_cast<std::ptrdiff_t>(v) * exact.width;
      std::uint16_t* const out = depth.row<std::uint16_t>(v);
      int shadow_px = 0;
      float shadowed_m = 0.0f;
      for (int u = exact.width - 1; u >= 0; --u) {  // from the right: shadows fall to the left of nearer things
        float z = row[u];
        bool lost = !(z > 0.0f);
        if (options_.depth_holes) {
          if (u + 1 < exact.width && z - row[u + 1] > jump(z)) {
            shadow_px = 2 + static_cast<int>(random.index(3));
            shadowed_m = z;
          }
          lost = lost || (shadow_px > 0 && shadowed_m - z < jump(z)) || !(z >= options_.nearest_m) ||
                 grazes(cosine_row[u], random);
          if (shadow_px > 0) --shadow_px;
          z = ragged(exact, u, v, random);
          lost = lost || !(z > 0.0f);
        }
        if (options_.depth_noise) z = noisy(z, normal.next());
        out[u] = lost || !(z <= options_.farthest_m) ? std::uint16_t{0} : quantised(z);
      }
    }
  }

  /// Depth between two neighbouring disparities at a depth, metres.
  static double disparity_step(double depth_m) noexcept { return depth_m * depth_m / (8.0 * 580.0 * 0.075); }

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

  /// Gaussian noise and disparity steps which together have the standard deviation of the model: the steps alone have
  /// step / √12.
  static float noisy(float depth_m, float deviate) noexcept {
    if (!(depth_m > 0.0f)) return depth_m;
    const double sigma = KinectNoise{}.sigma(depth_m), step = disparity_step(depth_m);
    const double gaussian_sigma = std::sqrt(std::max(0.0, sigma * sigma - step * step / 12.0));
    const double measured = depth_m + gaussian_sigma * static_cast<double>(deviate);
    // Disparity in steps: n = 8 f b / z, so that one step of n is disparity_step(z).
    const double disparity = std::floor(8.0 * 580.0 * 0.075 / measured + 0.5);
    return static_cast<float>(8.0 * 580.0 * 0.075 / std::max(1.0, disparity));
  }

  std::uint16_t quantised(float depth_m) const noexcept {
    const double units = static_cast<double>(depth_m) * options_.depth_factor + 0.5;
    constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
    return units < kMost ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }

  Sensor options_;
};

}  // namespace stillpoint::synthetic
