// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which object is a group of features of?   One that it touches and moves with, a lost one that is seen again, or a new
// one; and which objects are one?

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/movers/appearance.hpp"
#include "stillpoint/movers/motion_groups.hpp"
#include "stillpoint/movers/object_identity.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// A group of features that no known object has claimed.
struct LooseGroup {
  span<const std::uint32_t> members;  ///< indices into the loose points
  Vector3d centroid = Vector3d::Zero();
  Vector3d velocity = Vector3d::Zero();  ///< relative to the world, m/s
  Appearance appearance;

  LooseGroup(const DynamicPoints& points, span<const std::uint32_t> of_group, double elapsed_s, Workspace& workspace)
      : members(of_group) {
    const Workspace::Scope scope(workspace);
    const span<double> values = workspace.take<double>(members.size());
    for (const std::uint32_t k : members) centroid += points.point(k) / static_cast<double>(members.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::size_t steps = 0;
      for (const std::uint32_t k : members)
        if (points.has_step[k] != 0) values[steps++] = points.step(k)(axis);
      if (steps > 0) velocity(axis) = median_in_place(values.first(steps)) / elapsed_s;
    }
  }
};

/// Finds the objects of groups. Distances in metres, speeds in m/s.
class ObjectAssociation {
 public:
  static constexpr std::int32_t kNone = -1;
  static constexpr double kSlow_m_s = 0.15;  // below it nobody can tell by motion what belongs together

  /// The object whose points are near most of the group, or near some of it where both move much alike.
  /// @param is_seen  of each object, in this frame
  static std::int32_t touched(const LooseGroup& group, const DynamicPoints& points,
                              const std::vector<TrackedObject>& objects, span<const std::uint8_t> is_seen) {
    constexpr double kLimbs_m_s = 0.6, kMuchAlike_m_s = 0.25, kReach_m = MotionGroups::kReach_m;
    std::int32_t best = kNone;
    std::size_t most = 0;
    for (std::size_t o = 0; o < is_seen.size(); ++o) {
      const TrackedObject& object = objects[o];
      // As it goes on average, about which limbs swing, or as it goes now: it may have started or stopped.
      const Vector3d now = object.velocity_at(group.centroid), turn = now - object.linear.velocity();
      const double apart_m_s =
          std::min((object.mean_velocity + turn - group.velocity).norm(), (now - group.velocity).norm());
      if (is_seen[o] == 0 || !(apart_m_s < kLimbs_m_s)) continue;
      std::size_t near = 0;
      for (const std::uint32_t k : group.members)
        near += std::any_of(object.points.begin(), object.points.end(), [&](const Vector3d& point) {
          return (point - points.point(k)).squaredNorm() <= kReach_m * kReach_m;
        });
      const std::size_t least = apart_m_s < kMuchAlike_m_s ? group.members.size() / 10 + 2 : group.members.size() / 2;
      if (near < least || near <= most) continue;
      most = near;
      best = static_cast<std::int32_t>(o);
    }
    return best;
  }

  /// The object that is not seen and is nearest in place, motion and appearance.
  static std::int32_t seen_again(const LooseGroup& group, double timestamp_s, const std::vector<TrackedObject>& objects,
                                 span<const std::uint8_t> is_seen) {
    std::int32_t best = kNone;
    double least = ObjectIdentity::kMostMisfit;
    for (std::size_t o = 0; o < is_seen.size(); ++o) {
      if (is_seen[o] != 0) continue;
      const double unseen_s = timestamp_s - objects[o].mover.last_seen_s;
      const double cost =
          ObjectIdentity::misfit_of_lost(group.centroid, group.velocity, group.appearance, objects[o], unseen_s);
      if (!(cost < least)) continue;
      least = cost;
      best = static_cast<std::int32_t>(o);
    }
    return best;
  }

  /// What hangs together and moves alike is one object, the one with more features. Two that were reported must have
  /// moved alike for longer.
  static void merge(std::vector<TrackedObject>& objects, span<std::int32_t> object_of) {
    for (std::size_t b = objects.size(); b-- > 1;) {
      for (std::size_t a = 0; a < b; ++a) {
        TrackedObject &one = objects[a], &other = objects[b];
        if (!are_one(one, other)) continue;
        const bool keeps_other = other.is_confirmed && (!one.is_confirmed || other.members > one.members);
        if (keeps_other) std::swap(one, other);
        ObjectIdentity::absorb(objects, a, b, object_of);
        break;
      }
    }
  }

 private:
  static bool are_one(const TrackedObject& one, const TrackedObject& other) {
    constexpr double kAlike_m_s = 0.6, kKnownAlike_m_s = 0.3, kLimb_m = 0.3;
    if (!one.is_seen || !other.is_seen || one.points.empty() || other.points.empty()) return false;
    const bool are_known = one.is_confirmed && other.is_confirmed;
    Vector3d u = are_known ? one.long_velocity : one.mean_velocity;
    const Vector3d& v = are_known ? other.long_velocity : other.mean_velocity;
    u += one.velocity_at(other.mover.centroid) - one.linear.velocity();  // if it turns
    const double slowest = are_known ? 2 * kSlow_m_s : kSlow_m_s, alike = are_known ? kKnownAlike_m_s : kAlike_m_s;
    if (!(std::min(u.norm(), v.norm()) > slowest) || !((u - v).norm() < alike)) return false;
    if (are_known && ObjectIdentity::are_limb_and_body(one, other)) return true;
    return TrackedObject::touch(one, other, are_known ? MotionGroups::kReach_m : kLimb_m);
  }
};

}  // namespace stillpoint
