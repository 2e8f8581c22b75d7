// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What there is: a room with furniture, things that move on paths, a camera, and how good its sensors are.
//
// The world: x right, y down, z ahead, metres; the floor is y = 0. Times are seconds since the first frame.

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/synthetic/path.hpp"
#include "stillpoint/synthetic/texture.hpp"

namespace stillpoint::synthetic {

enum class Shape {
  cuboid,
  ellipsoid,
  room,  ///< a cuboid seen from inside
};

/// A textured body. Face 2 a + s is the one at the negative (s = 0) or positive (s = 1) end of axis a.
struct Solid {
  Shape shape = Shape::cuboid;
  Vector3d half_extents = Vector3d::Constant(0.5);  ///< metres, half of the edges or the semi-axes
  Pose object_from_solid = Pose::Identity();        ///< centre and axes, in the mover's frame or (furniture) the world
  std::array<TexturePtr, 6> textures;               ///< of the faces, none of them null

  Solid() = default;
  Solid(Shape form, const Vector3d& half, const Vector3d& centre, const TexturePtr& texture, double yaw = 0.0)
      : shape(form), half_extents(half) {
    object_from_solid.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitY()).toRotationMatrix();
    object_from_solid.translation() = centre;
    textures.fill(texture);
  }
};

/// A hinge between a part and its mover.
struct Joint {
  Vector3d pivot = Vector3d::Zero();  ///< in the mover's frame
  Vector3d axis = Vector3d::UnitX();
  double stride_rad = 0.0;    ///< swing to either side while the mover walks
  double stride_phase = 0.0;  ///< radians
  double wave_rad = 0.0;      ///< swing to either side by the clock, between wave_start_s and wave_end_s
  double wave_hz = 1.0;
  double wave_start_s = 0.0;
  double wave_end_s = 0.0;

  static constexpr double kStrideLength = 1.4;  ///< metres of two steps

  double angle(double time_s, double distance_m) const {
    constexpr double kTurn = 6.283185307179586;
    double radians = stride_rad * std::sin(kTurn * distance_m / kStrideLength + stride_phase);
    if (time_s > wave_start_s && time_s < wave_end_s)
      radians += wave_rad * std::sin(kTurn * wave_hz * (time_s - wave_start_s));
    return radians;
  }
};

/// A body that belongs to a mover.
struct Part {
  Solid solid;
  Joint joint;
};

/// Class name of a mover that no detector knows.
inline constexpr char kUnknownClass[] = "unknown_thing";

/// Something that moves, or may.
struct Mover {
  std::string class_name = kUnknownClass;  ///< as a perfect detector would say; empty: never in the boxes
  Path path;
  std::vector<Part> parts;

  Pose world_from_object(double time_s) const { return path.world_from_object(time_s); }

  Pose world_from_part(const Part& part, double time_s) const {
    const double angle = part.joint.angle(time_s, path.distance_m(time_s));
    const Pose swung = Eigen::Translation3d(part.joint.pivot) * Eigen::AngleAxisd(angle, part.joint.axis.normalized()) *
                       Eigen::Translation3d(-part.joint.pivot) * part.solid.object_from_solid;
    return world_from_object(time_s) * swung;
  }
};

/// How good the camera is. Everything off: exact depth (rounded to the factor's steps) and a clean picture.
struct Sensor {
  double image_sigma = 2.0;       ///< gaussian noise, grey levels, the same on all three channels of a pixel
  double exposure_flicker = 0.0;  ///< largest change of brightness of a frame, as a share of 1
  bool depth_noise = true;        ///< axial noise of `KinectNoise`, of which disparity steps are a part
  bool depth_holes = true;        ///< ragged rims, shadows left of nearer things, nothing at grazing angles
  double depth_factor = 5000.0;   ///< units of the 16-bit depth per metre
  double nearest_m = 0.4;         ///< no depth below, unless `depth_holes` is off
  double farthest_m = 8.0;        ///< none beyond
};

/// When a mover's pixel counts as moving (label 255). The defaults are those of the recorded test sequences; speeds
/// below 6 cm/s (at 30 Hz) count as rest with them.
struct MotionRule {
  double last_frame_m = 0.003;  ///< its surface point moved more since the last frame,
  double window_m = 0.010;      ///< or its surface point or the mover's origin moved more
  int window_frames = 5;        ///< within so many frames; frames before the first stand for the first
};

/// All of a sequence but the pictures.
struct Scene {
  std::string name = "unnamed";
  Camera camera{525.0, 525.0, 319.5, 239.5, 640, 480};
  CameraPath camera_path;
  std::vector<Solid> furniture;  ///< in the world, the room included
  std::vector<Mover> movers;
  Sensor sensor;
  MotionRule motion_rule;
  int frame_count = 60;
  double frame_rate_hz = 30.0;
  double start_s = 1.0;  ///< timestamp of frame 0
  std::uint64_t seed = Random::kDefaultSeed;
};

}  // namespace stillpoint::synthetic
