// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What there is: a room with furniture, objects that move on paths, a camera, and how good its sensors are.
//
// The world: x right, y down, z ahead, metres; the floor is y = 0. Times are seconds since the first frame.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
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
  std::string name;                                 ///< of furniture that a test asks for (`labels_of`), else empty
  double infrared_albedo = 0.5;  ///< share of the infrared light that a face returns, in [0, 1]; not what colour it has
  bool specular = false;         ///< a mirror: no infrared light comes back to where it came from

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
  double stride_rad = 0.0;  ///< swing to either side while the mover walks
  double wave_rad = 0.0;    ///< swing to either side by the clock, between wave_start_s and wave_end_s
  double wave_hz = 1.0;
  double wave_start_s = 0.0;
  double wave_end_s = 0.0;

  static constexpr double kStrideLength = 1.4;  ///< metres of two steps

  double angle(double time_s, double distance_m) const {
    constexpr double kTurn = 6.283185307179586;
    double radians = stride_rad * std::sin(kTurn * distance_m / kStrideLength);
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

/// How good the camera is. Everything off: exact depth (rounded to the factor's steps) and a clean image.
/// `realistic_kinect()` has everything on.
struct Sensor {
  double image_sigma = 2.0;       ///< gaussian noise, grey levels, the same on all three channels of a pixel
  double exposure_flicker = 0.0;  ///< largest change of brightness of a frame, as a share of 1
  bool depth_noise = true;        ///< axial noise of `KinectNoise`, of which disparity steps are a part
  bool depth_holes = true;        ///< ragged rims, shadows left of nearer objects, nothing at grazing angles
  double depth_factor = 5000.0;   ///< units of the 16-bit depth per metre
  double nearest_m = 0.4;         ///< no depth below, unless `depth_holes` is off
  double farthest_m = 8.0;        ///< none beyond

  /// Step of the disparity for the Kinect's own focal length and base, px. Part of `depth_noise`, 0: no steps.
  double disparity_step_px = 0.125;
  /// Depth of a stereo pair: gaussian noise of the disparity in place of `KinectNoise` and steps, with `depth_noise`.
  std::optional<StereoNoise> stereo_noise;

  // Part of `depth_holes`, each in place of a simpler rule. Off by default.

  /// Distance of the projector (or a second camera) to the right of the camera, metres: there is no depth where it does
  /// not see the surface. The shadow of an edge at depth z1 before z2 is f b (1/z1 - 1/z2) px wide. 0: 2 to 4 px.
  double projector_baseline_m = 0.0;
  /// No depth where infrared albedo times cosine of the angle of incidence is not above this, in [0, 1], nor on
  /// specular surfaces. 0: none beyond 78 to 84 degrees, of any surface.
  double least_return = 0.0;
  /// Share of the depths within 2 px of an edge of more than 10 sigma that are a mix of both sides by a random weight,
  /// in [0, 1]. 0: depths at an edge are swapped with a neighbour's.
  double flying_pixel_share = 0.0;

  /// The depth is taken so many seconds after the image (negative: before it).
  double depth_delay_s = 0.0;
};

/// A Kinect v1 as it is, with colour and depth that are not taken at the same instant.
inline Sensor realistic_kinect() {
  Sensor sensor;
  sensor.projector_baseline_m = 0.075;  // Khoshelham and Elberink, Sensors 2012
  sensor.least_return = 0.08;           // of a surface of albedo 0.5 up to 81 degrees
  sensor.flying_pixel_share = 0.5;
  sensor.depth_delay_s = 0.010;  // its two cameras run freely at 30 Hz: at most 0.017
  return sensor;
}

/// When a mover's pixel counts as moving (label 255). The defaults are those of the recorded test sequences; speeds
/// below 6 cm/s (at 30 Hz) count as rest with them.
struct MotionRule {
  double last_frame_m = 0.003;  ///< its surface point moved more since the last frame,
  double window_m = 0.010;      ///< or its surface point or the mover's origin moved more
  int window_frames = 5;        ///< within so many frames; frames before the first stand for the first
};

/// All of a sequence but the images.
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
