// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Models of how wrong a depth is: the standard deviation along the optical axis, in metres, at a given depth.
//
// A model is anything with `double sigma(double depth_m) const`; a user's own functor is wrapped by `FunctorNoise`.

#include <cstddef>
#include <utility>
#include <variant>

#include "stillpoint/core/options.hpp"

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

template <class Visit>
void each_option(StereoNoise& noise, Visit& visit) {
  visit("focal_px", noise.focal_px, OptionRange{1, 1e5});
  visit("baseline_m", noise.baseline_m, OptionRange{1e-3, 100});
  visit("disparity_sigma_px", noise.disparity_sigma_px, OptionRange{1e-3, 100});
}

template <class Visit>
void each_option(TimeOfFlightNoise& noise, Visit& visit) {
  visit("constant_m", noise.constant_m, OptionRange{1e-6, 10});
  visit("per_metre", noise.per_metre, OptionRange{0, 10});
}

/// The model's own parameters stand beside its name.
template <class Visit>
void each_option(AnyDepthNoise& noise, Visit& visit) {
  std::size_t model = noise.model.index();
  visit.choice("model", model, "kinect", "stereo", "tof");
  if (model != noise.model.index()) {
    if (model == 0) noise.model = KinectNoise{};
    if (model == 1) noise.model = StereoNoise{};
    if (model == 2) noise.model = TimeOfFlightNoise{};
  }
  if (auto* const stereo = std::get_if<StereoNoise>(&noise.model)) each_option(*stereo, visit);
  if (auto* const time_of_flight = std::get_if<TimeOfFlightNoise>(&noise.model)) each_option(*time_of_flight, visit);
  visit("scale", noise.scale, OptionRange{1e-3, 1e3});
}

}  // namespace stillpoint
