// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is what is seen here an object that is known already?   By place, motion and appearance.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/movers/appearance.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Compares parts with objects. Distances in metres, speeds in m/s.
class ObjectIdentity {
 public:
  static constexpr std::int32_t kNone = -1;
  static constexpr double kMostMisfit = 1.6;

  /// How badly a part fits a lost object: squared, in units of what is allowed; infinite where the place is wrong. The
  /// object is where constant velocity has carried it, less and less certainly. What comes out beside whatever hid it
  /// is a strip: it must lie in the object's extent, its own centroid says nothing.
  /// @param unseen_s  for how long the object is not seen
  static double misfit_of_lost(const Vector3d& centroid, const Vector3d& velocity, const Appearance& appearance,
                               const TrackedObject& object, double unseen_s) {
    constexpr double kNear_m = 0.25, kNearPerSecond = 0.6, kAlike = 0.7;
    const double near_m = kNear_m + kNearPerSecond * unseen_s;
    const Vector3d apart = (centroid - object.mover.centroid).cwiseAbs() - 0.5 * object.size_m;
    const double place = apart.cwiseMax(0.0).norm() / near_m;
    if (!(place < 1.0)) return std::numeric_limits<double>::infinity();
    const double sigma_m_s = std::sqrt(object.linear.covariance().trace() / 3.0);  // grows while nothing is measured
    const double motion =
        (velocity - object.linear.velocity()).norm() / (limb_speed_m_s(fastest_m_s(object)) + sigma_m_s);
    const double look = static_cast<double>(appearance.distance(object.appearance)) / kAlike;
    return place * place + motion * motion + look * look;
  }

  /// Which reported object is an object that is about to be reported? A lost one that it fits, or one that it hangs on
  /// and is a limb of; `kNone`: it is new.
  static std::int32_t known(const std::vector<TrackedObject>& objects, std::size_t candidate, double timestamp_s) {
    const TrackedObject& part = objects[candidate];
    std::int32_t best = kNone;
    double least = kMostMisfit;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const TrackedObject& object = objects[o];
      if (o == candidate || !object.is_confirmed) continue;
      const double unseen_s = timestamp_s - object.mover.last_seen_s;
      const double misfit =
          object.is_seen ? misfit_of_limb(part, object)
                         : misfit_of_lost(part.mover.centroid, part.mean_velocity, part.appearance, object, unseen_s);
      if (!(misfit < least)) continue;
      least = misfit;
      best = static_cast<std::int32_t>(o);
    }
    return best;
  }

  /// May it be a limb that swings faster than the body it hangs on? Nobody knows until it has been seen for a while. A
  /// foot may be all that is seen of a leg, farther from the body, and comes out before the body that has just passed
  /// behind something. What no limb of that body does is another object.
  static bool may_be_limb(const std::vector<TrackedObject>& objects, std::size_t candidate, double timestamp_s) {
    constexpr double kStride_s = 0.5, kMoves_m_s = 0.1, kFoot_m = 1.0;
    const TrackedObject& part = objects[candidate];
    if (timestamp_s - part.mover.first_seen_s > kStride_s) return false;
    return std::any_of(objects.begin(), objects.end(), [&](const TrackedObject& object) {
      const bool is_about = timestamp_s - object.mover.last_seen_s <= kStride_s;
      if (&object == &part || !object.is_confirmed || !is_about || !(object.mean_speed() > kMoves_m_s) ||
          !is_small(part, object))
        return false;
      return gap_m(part, object) < kFoot_m && swing(part, object) < 1.0;
    });
  }

  /// Which object that is seen is the body of a lost one, which hung on it and swung as a limb does? It needs no
  /// identity any more: it would take what comes out from behind something for its own, where that is the body's. Where
  /// it is lost, who passes before it is near, too: only what touches is a limb.
  static std::int32_t body_of_lost(const std::vector<TrackedObject>& objects, std::size_t lost) {
    if (objects[lost].is_seen) return kNone;
    const auto body = std::find_if(objects.begin(), objects.end(), [&](const TrackedObject& object) {
      return object.is_confirmed && object.is_seen && object.members > objects[lost].members &&
             are_limb_and_body(objects[lost], object, kTouch_m) && swing(objects[lost], object) < 1.0;
    });
    return body == objects.end() ? kNone : static_cast<std::int32_t>(body - objects.begin());
  }

  /// By size and place, is the one a limb of the other? What joins them need not have features, but a limb is smaller
  /// than its body: a person of whom little is seen is as large as remembered. Both are known already: of a body that
  /// is seen, a limb has less than half of the features, too.
  static bool are_limb_and_body(const TrackedObject& one, const TrackedObject& other, double reach_m = kLimb_m) {
    const TrackedObject &limb = one.members < other.members ? one : other, &body = &limb == &one ? other : one;
    const bool is_part = !body.is_seen || has_few(limb, body);
    return is_part && is_short(limb, body) && gap_m(limb, body) < reach_m;
  }

  /// Two objects are one, under the identity of `known`; where it is lost or has fewer features, `part` says where it
  /// is and how it moves.
  static void unite(std::vector<TrackedObject>& objects, std::size_t known, std::size_t part,
                    span<std::int32_t> object_of) {
    TrackedObject &kept = objects[known], &other = objects[part];
    if (!kept.is_seen || other.members > kept.members) {
      std::swap(kept, other);
      take_identity(other, kept);
    }
    absorb(objects, known, part, object_of);
  }

  /// Gives the features of `part` to `kept`, and its points unless they are only predicted, and removes `part`.
  static void absorb(std::vector<TrackedObject>& objects, std::size_t kept, std::size_t part,
                     span<std::int32_t> object_of) {
    const TrackedObject& other = objects[part];
    if (other.is_seen)
      for (const Vector3d& point : other.points) objects[kept].points.add(point);
    for (std::int32_t& of : object_of) {
      if (of == static_cast<std::int32_t>(part)) of = static_cast<std::int32_t>(kept);
      if (of > static_cast<std::int32_t>(part)) --of;
    }
    objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(part));
  }

 private:
  static constexpr double kLimb_m = 0.5;   // from a body to what is seen of its limbs
  static constexpr double kTouch_m = 0.1;  // the same for a limb that is not seen any more

  static double fastest_m_s(const TrackedObject& object) {
    return std::max(object.mean_speed(), object.linear.velocity().norm());
  }

  /// Against the body: legs stand, and swing at twice its speed.
  static double limb_speed_m_s(double body_speed_m_s) { return 0.3 + 0.8 * body_speed_m_s; }

  /// How fast a part moves against a body, in units of what limbs do: they stand, or swing at up to two and a half
  /// times the speed of the body, and its way.
  static double swing(const TrackedObject& limb, const TrackedObject& body) {
    const double speed = body.mean_speed(), forward_m_s = 0.3 + 1.5 * speed, other_m_s = limb_speed_m_s(speed);
    const Vector3d apart = limb.mean_velocity - body.mean_velocity;
    const double along = speed > 0 ? apart.dot(body.mean_velocity) / speed : 0.0;
    const double across = std::sqrt(std::max(0.0, apart.squaredNorm() - along * along));
    return std::hypot(along / (along > 0 ? forward_m_s : other_m_s), across / other_m_s);
  }

  /// How far the boxes around two objects, as large as they are remembered, are from each other.
  static double gap_m(const TrackedObject& a, const TrackedObject& b) {
    const Vector3d apart = (a.mover.centroid - b.mover.centroid).cwiseAbs() - 0.5 * (a.size_m + b.size_m);
    return apart.cwiseMax(0.0).norm();
  }

  /// The same for what may be a part of an object that is seen: what is beside it must move with it, as limbs do.
  static double misfit_of_limb(const TrackedObject& part, const TrackedObject& object) {
    constexpr double kReach_m = 0.3;
    const TrackedObject& larger = object.members >= part.members ? object : part;
    const double motion = swing(&larger == &object ? part : object, larger);
    const double reach_m = is_small(part, object) ? kLimb_m : kReach_m;
    if (!(motion < 1.0) || !(gap_m(part, object) < reach_m)) return std::numeric_limits<double>::infinity();
    return motion * motion;
  }

  /// A limb has less than half of its body's features, or of its length: a foot may have as many as a shirt, and a body
  /// that has gone behind something had few at the end.
  static bool is_small(const TrackedObject& part, const TrackedObject& object) {
    return (object.is_seen && has_few(part, object)) || is_short(part, object);
  }

  static bool has_few(const TrackedObject& part, const TrackedObject& object) {
    return 2 * part.members < object.members;
  }

  static bool is_short(const TrackedObject& part, const TrackedObject& object) {
    return 2 * part.size_m.norm() < object.size_m.norm();
  }

  static void take_identity(const TrackedObject& known, TrackedObject& object) {
    object.mover.id = known.mover.id;
    object.mover.first_seen_s = known.mover.first_seen_s;
    object.mover.class_index = known.mover.class_index;
    object.mover.confidence = known.mover.confidence;
    object.is_confirmed = known.is_confirmed;
    Appearance appearance = known.appearance;
    appearance.blend(object.appearance, 0.5f);
    object.appearance = appearance;
  }
};

}  // namespace stillpoint
