// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Lens distortion on the normalised image plane (z = 1): what the lens does to a ray, and its inverse.

#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// An ideal pinhole.
struct NoDistortion {
  Vector2d distort(const Vector2d& ideal) const noexcept { return ideal; }
  Vector2d undistort(const Vector2d& distorted) const noexcept { return distorted; }
};

/// Radial and tangential distortion. Source: Brown, "Close-Range Camera Calibration", 1971; coefficients in OpenCV's
/// order k1 k2 p1 p2 k3.
struct BrownConrady {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  Vector2d distort(const Vector2d& ideal) const noexcept {
    const double x = ideal.x(), y = ideal.y(), r2 = ideal.squaredNorm();
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  /// Newton's method from the distorted point. Beyond the radius where the model folds back there is no inverse: the
  /// last iterate is returned, finite for finite input.
  Vector2d undistort(const Vector2d& distorted) const noexcept {
    Vector2d ideal = distorted;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Vector2d error = distort(ideal) - distorted;
      if (error.squaredNorm() < 1e-24) break;
      const Vector2d step = solved(jacobian(ideal), error);
      if (!is_finite(step) || step.norm() > 1.0) break;
      ideal -= step;
    }
    return ideal;
  }

  /// The x for which j x = b, by Cramer's rule.
  static Vector2d solved(const Eigen::Matrix2d& j, const Vector2d& b) noexcept {
    const double determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    return {(j(1, 1) * b.x() - j(0, 1) * b.y()) / determinant, (j(0, 0) * b.y() - j(1, 0) * b.x()) / determinant};
  }

  /// ∂distort/∂ideal.
  Eigen::Matrix2d jacobian(const Vector2d& ideal) const noexcept {
    const double x = ideal.x(), y = ideal.y(), r2 = ideal.squaredNorm();
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // d radial / d r² times 2
    const double mixed = x * y * slope + 2 * p1 * x + 2 * p2 * y;
    Eigen::Matrix2d j;
    j << radial + x * x * slope + 2 * p1 * y + 6 * p2 * x, mixed,  //
        mixed, radial + y * y * slope + 6 * p1 * y + 2 * p2 * x;
    return j;
  }
};

/// Equidistant fisheye. Source: Kannala and Brandt, "A Generic Camera Model and Calibration Method", PAMI 2006, Eq. (6)
/// in OpenCV's form: θ_d = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸).
struct EquidistantFisheye {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;

  Vector2d distort(const Vector2d& ideal) const noexcept {
    const double radius = ideal.norm();
    if (radius < 1e-9) return ideal;
    return ideal * (distorted_angle(std::atan(radius)) / radius);
  }

  /// Newton's method on the angle. Rays at 90 degrees or more have no place on the plane z = 1: they are clamped just
  /// below.
  Vector2d undistort(const Vector2d& distorted) const noexcept {
    constexpr double kSteepest = 1.5533;  // 89 degrees
    const double theta_d = distorted.norm();
    if (theta_d < 1e-9) return distorted;
    double theta = theta_d < kSteepest ? theta_d : kSteepest;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const double t2 = theta * theta;
      const double slope = 1 + t2 * (3 * k1 + t2 * (5 * k2 + t2 * (7 * k3 + t2 * 9 * k4)));
      const double step = (distorted_angle(theta) - theta_d) / slope;
      if (!std::isfinite(step) || std::abs(step) < 1e-13) break;
      theta -= step;
      if (theta < 0) theta = 0;
      if (theta > kSteepest) theta = kSteepest;
    }
    return distorted * (std::tan(theta) / theta_d);
  }

 private:
  double distorted_angle(double theta) const noexcept {
    const double t2 = theta * theta;
    return theta * (1 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))));
  }
};

/// One of the models above, chosen at run time.
struct AnyDistortion {
  std::variant<NoDistortion, BrownConrady, EquidistantFisheye> model;

  AnyDistortion() = default;
  AnyDistortion(const NoDistortion&) {}
  AnyDistortion(const BrownConrady& lens) : model(lens) {}
  AnyDistortion(const EquidistantFisheye& lens) : model(lens) {}

  Vector2d distort(const Vector2d& ideal) const {
    return std::visit([&ideal](const auto& lens) { return lens.distort(ideal); }, model);
  }
  Vector2d undistort(const Vector2d& distorted) const {
    return std::visit([&distorted](const auto& lens) { return lens.undistort(distorted); }, model);
  }
};

/// How far out on the plane z = 1 a lens shows wider rays ever farther out; infinity where it does so up to 89 degrees.
/// Beyond it a polynomial that was fitted to what the camera sees folds back: to one with k1 = −0.37 and k2 = 0.2, what
/// is 60 degrees aside would be in the middle of the image.
template <class Distortion>
double fold_radius(const Distortion& lens) {
  constexpr double kStep = 2e-3, kWidest = 1.5533;  // radians
  double growing = 0, farthest = 0;
  for (double angle = kStep; angle < kWidest; angle += kStep) {
    const double radius = std::tan(angle), shown = lens.distort(Vector2d(radius, 0.0)).norm();
    if (!(shown > farthest)) return growing;
    growing = radius;
    farthest = shown;
  }
  return std::numeric_limits<double>::infinity();
}

/// Whether a lens leaves every pixel where it is, as in images that come rectified; most depth images do.
template <class Distortion>
bool has_no_lens(const Distortion&) noexcept {
  return std::is_same_v<Distortion, NoDistortion>;
}
inline bool has_no_lens(const AnyDistortion& lens) noexcept { return std::holds_alternative<NoDistortion>(lens.model); }

}  // namespace stillpoint
