// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Models of how wrong a depth is: the standard deviation along the optical axis, in metres, at a given depth.
//
// A model is anything with `double sigma(double depth_m) const`; a user's own functor is wrapped by `FunctorNoise`.

#include <utility>
#include <variant>

namespace stillpoint {

/// Kinect v1, axial noise at small tilt.
/// Source: Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking", 3DIMPVT
/// 2012, Eq. (3): σ(z) = 0.0012 + 0.0019 (z − 0.4)². Below 0.4 m (its near limit) the value at 0.4 m holds.
struct KinectNoise {
  double sigma(double depth_m) const noexcept {
    const double beyond = depth_m > 0.4 ? depth_m - 0.4 : 0.0;
    return 0.0012 + 0.0019 * beyond * beyond;
  }
};

/// Depth from disparity: z = f b / d, so that σ(z) = z² σ_d / (f b).
struct StereoNoise {
  double focal_px = 500.0;
  double baseline_m = 0.1;
  double disparity_sigma_px = 0.3;

  double sigma(double depth_m) const noexcept {
    return depth_m * depth_m * disparity_sigma_px / (focal_px * baseline_m);
  }
};

/// Time of flight: a constant and a part that grows with depth.
struct TimeOfFlightNoise {
  double constant_m = 0.005;
  double per_metre = 0.002;

  double sigma(double depth_m) const noexcept { return constant_m + per_metre * depth_m; }
};

/// A user's function as a noise model: `FunctorNoise noise{[](double z) { return 0.01 * z; }};`
template <class Function>
struct FunctorNoise {
  Function function;
  double sigma(double depth_m) const { return static_cast<double>(function(depth_m)); }
};
template <class Function>
FunctorNoise(Function) -> FunctorNoise<Function>;

/// One of the models above, chosen at run time.
struct AnyDepthNoise {
  std::variant<KinectNoise, StereoNoise, TimeOfFlightNoise> model;
  double scale = 1.0;  ///< times what the model says: a camera's own measure (docs/tuning.md)

  AnyDepthNoise() = default;
  AnyDepthNoise(const KinectNoise& noise) : model(noise) {}
  AnyDepthNoise(const StereoNoise& noise) : model(noise) {}
  AnyDepthNoise(const TimeOfFlightNoise& noise) : model(noise) {}

  double sigma(double depth_m) const {
    return scale * std::visit([depth_m](const auto& noise) { return noise.sigma(depth_m); }, model);
  }
};

}  // namespace stillpoint
