// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A camera that cannot say how large its image is.
// expected: stillpoint: Policies::Camera must offer Vector2d project(const Vector3d&) const, Vector3d back_project(const Vector2d&, double) const, Vector2d distort(const Vector2d&) const, Vector2d undistort(const Vector2d&) const, int width() const and int height() const; see core/camera.hpp

#include "sound_policies.hpp"

struct SizelessCamera {
  stillpoint::Vector2d project(const stillpoint::Vector3d& point) const { return point.head<2>(); }
  stillpoint::Vector3d back_project(const stillpoint::Vector2d& pixel, double depth_m) const {
    return {pixel.x(), pixel.y(), depth_m};
  }
  stillpoint::Vector2d distort(const stillpoint::Vector2d& pixel) const { return pixel; }
  stillpoint::Vector2d undistort(const stillpoint::Vector2d& pixel) const { return pixel; }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Camera = SizelessCamera;
#endif
};

template void use<Policies>(const Policies::Camera&);
