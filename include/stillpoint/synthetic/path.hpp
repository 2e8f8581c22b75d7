// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where an object is at a time: way points with times, and how to get from one to the next. Used for movers and
// cameras.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::synthetic {

/// A place to be at a time. Rotation: R = R_y(yaw) R_x(pitch) R_z(roll), radians; with y down, a growing yaw turns to
/// the right and a growing pitch looks up.
struct Waypoint {
  double time_s = 0.0;
  Vector3d position = Vector3d::Zero();  ///< metres, in the world
  double yaw = 0.0;
  double pitch = 0.0;
  double roll = 0.0;
};

/// How a leg from one way point to the next is gone.
enum class Blend {
  linear,  ///< constant speed: for exact speeds
  eased,   ///< starts and ends at rest (smooth step): parked, moving, parked
  spline,  ///< through all way points without a jump in speed (Catmull-Rom), at rest at both ends: for cameras
};

/// A path through way points. Before the first and after the last it stands still.
class Path {
 public:
  /// Stands at the world's origin.
  Path() : Path({Waypoint{}}) {}

  /// @throws Error unless there is a way point, all numbers are finite and the times grow.
  explicit Path(std::vector<Waypoint> waypoints, Blend blend = Blend::eased)
      : waypoints_(std::move(waypoints)), blend_(blend) {
    if (waypoints_.empty()) throw Error("path: no way point, expected at least one");
    for (std::size_t i = 0; i < waypoints_.size(); ++i) {
      const Waypoint& waypoint = waypoints_[i];
      if (!std::isfinite(waypoint.time_s) || !values(waypoint).allFinite())
        throw Error("path: way point " + std::to_string(i) + " is not finite, expected finite numbers");
      if (i > 0 && !(waypoint.time_s > waypoints_[i - 1].time_s))
        throw Error("path: way point " + std::to_string(i) + " has time " + std::to_string(waypoint.time_s) +
                    " s, expected more than " + std::to_string(waypoints_[i - 1].time_s) + " s");
      const double leg_m = i == 0 ? 0.0 : (waypoint.position - waypoints_[i - 1].position).norm();
      distances_m_.push_back(i == 0 ? 0.0 : distances_m_.back() + leg_m);
    }
  }

  /// Pose of the object at a time, seconds since the sequence began.
  Pose world_from_object(double time_s) const {
    const Vector6d value = at(locate(time_s));
    Pose pose = Pose::Identity();
    pose.linear() = (Eigen::AngleAxisd(value[3], Vector3d::UnitY()) * Eigen::AngleAxisd(value[4], Vector3d::UnitX()) *
                     Eigen::AngleAxisd(value[5], Vector3d::UnitZ()))
                        .toRotationMatrix();
    pose.translation() = value.head<3>();
    return pose;
  }

  /// Metres gone along the straight lines between way points: drives the gait of a walker.
  double distance_m(double time_s) const {
    const Leg leg = locate(time_s);
    if (leg.next == leg.previous) return distances_m_[leg.previous];
    const double share = blend_ == Blend::linear ? leg.share : smooth_step(leg.share);
    return distances_m_[leg.previous] + share * (distances_m_[leg.next] - distances_m_[leg.previous]);
  }

  const std::vector<Waypoint>& waypoints() const noexcept { return waypoints_; }

 private:
  struct Leg {
    std::size_t previous, next;
    double share;  ///< of its time, in [0, 1]
  };

  static double smooth_step(double share) noexcept { return share * share * (3.0 - 2.0 * share); }

  static Vector6d values(const Waypoint& waypoint) {
    Vector6d value;
    value << waypoint.position, waypoint.yaw, waypoint.pitch, waypoint.roll;
    return value;
  }

  Leg locate(double time_s) const {
    std::size_t next = 0;
    while (next < waypoints_.size() && waypoints_[next].time_s <= time_s) ++next;
    if (next == 0) return {0, 0, 0.0};
    if (next == waypoints_.size()) return {next - 1, next - 1, 0.0};
    const double start_s = waypoints_[next - 1].time_s;
    return {next - 1, next, (time_s - start_s) / (waypoints_[next].time_s - start_s)};
  }

  /// Change per second at a way point, for the spline.
  Vector6d tangent(std::size_t i) const {
    if (i == 0 || i + 1 == waypoints_.size()) return Vector6d::Zero();
    return (values(waypoints_[i + 1]) - values(waypoints_[i - 1])) /
           (waypoints_[i + 1].time_s - waypoints_[i - 1].time_s);
  }

  Vector6d at(const Leg& leg) const {
    const Vector6d from = values(waypoints_[leg.previous]);
    if (leg.next == leg.previous) return from;
    const Vector6d to = values(waypoints_[leg.next]);
    const double s = leg.share;
    if (blend_ == Blend::linear) return from + s * (to - from);
    const Vector6d eased = from + smooth_step(s) * (to - from);
    if (blend_ == Blend::eased) return eased;
    const double seconds = waypoints_[leg.next].time_s - waypoints_[leg.previous].time_s;
    return eased + seconds * s * (1 - s) * ((1 - s) * tangent(leg.previous) - s * tangent(leg.next));
  }

  std::vector<Waypoint> waypoints_;
  std::vector<double> distances_m_;
  Blend blend_;
};

/// The tremble of a hand: for each of six axes a sum of slow sinusoids, equal for equal seeds. Amplitudes are about the
/// root mean square of each axis.
class HandShake {
 public:
  HandShake() : HandShake(0.0, 0.0, 0) {}

  HandShake(double translation_m, double rotation_rad, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = 0; i < waves_.size(); ++i) {
      const bool moves = i < 3 * kWavesPerAxis;
      const double amplitude = (moves ? translation_m : rotation_rad) * std::sqrt(2.0 / kWavesPerAxis);
      waves_[i] = {amplitude, 6.283185307179586 * random.uniform(0.3, 2.0), random.uniform(0.0, 6.283185307179586)};
    }
  }

  /// What the trembling camera does beside its path, to be multiplied on the right of its pose.
  Pose steady_from_shaken(double time_s) const {
    Vector6d value = Vector6d::Zero();
    for (std::size_t i = 0; i < waves_.size(); ++i)
      value[static_cast<Eigen::Index>(i / kWavesPerAxis)] +=
          waves_[i].amplitude * std::sin(waves_[i].radians_per_s * time_s + waves_[i].phase);
    Pose pose = Pose::Identity();
    pose.linear() = rotation_from_vector(value.tail<3>());
    pose.translation() = value.head<3>();
    return pose;
  }

 private:
  struct Wave {
    double amplitude, radians_per_s, phase;
  };
  static constexpr std::size_t kWavesPerAxis = 3;
  std::array<Wave, 6 * kWavesPerAxis> waves_{};
};

/// The camera's path with the hand that holds it.
struct CameraPath {
  Path path;
  HandShake shake;
  Pose hand_from_camera = Pose::Identity();  ///< of several cameras in one hand: where this one sits

  Pose world_from_camera(double time_s) const {
    return path.world_from_object(time_s) * shake.steady_from_shaken(time_s) * hand_from_camera;
  }
};

/// Writes a path like stage directions: `PathBuilder({x, y, z}).stand(1).walk_to({…}, 0.7).stand(1).path()`.
class PathBuilder {
 public:
  explicit PathBuilder(const Vector3d& start, double yaw = 0.0) { waypoints_.push_back({0.0, start, yaw, 0.0, 0.0}); }

  PathBuilder& stand(double seconds) { return move(waypoints_.back().position, waypoints_.back().yaw, seconds); }

  /// Turns on the spot, radians to the right.
  PathBuilder& turn(double radians, double seconds) {
    return move(waypoints_.back().position, waypoints_.back().yaw + radians, seconds);
  }

  /// Goes straight there at a mean speed, looking as before.
  PathBuilder& slide_to(const Vector3d& position, double metres_per_s, double turn_radians = 0.0) {
    const double metres = (position - waypoints_.back().position).norm();
    return move(position, waypoints_.back().yaw + turn_radians, metres / metres_per_s);
  }

  /// Turns to where it goes (the object's z axis points ahead) within 0.4 s, then goes there.
  PathBuilder& walk_to(const Vector3d& position, double metres_per_s) {
    const Vector3d way = position - waypoints_.back().position;
    const double turn_radians = std::remainder(std::atan2(way.x(), way.z()) - waypoints_.back().yaw, 2 * kPi);
    if (std::abs(turn_radians) > 1e-6) turn(turn_radians, 0.4);
    return slide_to(position, metres_per_s);
  }

  Path path(Blend blend = Blend::eased) const { return Path(waypoints_, blend); }

 private:
  static constexpr double kPi = 3.141592653589793;

  PathBuilder& move(const Vector3d& position, double yaw, double seconds) {
    waypoints_.push_back({waypoints_.back().time_s + seconds, position, yaw, 0.0, 0.0});
    return *this;
  }

  std::vector<Waypoint> waypoints_;
};

}  // namespace stillpoint::synthetic
