// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What moves, where, and how?   Dynamic features → objects with an identity, a motion and a velocity.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/movers/membership.hpp"
#include "stillpoint/movers/motion_groups.hpp"
#include "stillpoint/movers/object_motion.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Follows objects. A dynamic feature belongs to the object beside whose predicted points it lies; what is left over is
/// grouped by motion, and a group is a part of an object it touches, an object that was lost, or a new one. A new object
/// is reported once it has gone farther than noise would.
class MoverTracking {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::matches, capability::metric_motion>;

  struct Options {
    std::size_t fewest_features = 8;  ///< of an object that is seen; the filter's own corners count
    double least_path_m = 0.03;       ///< a new object is reported when it has gone so far …
    double least_path_sigmas = 6.0;   ///< … and so many standard deviations of that
    double remembered_s = 2.0;        ///< an object that is not seen for longer is forgotten
    double pixel_sigma = 0.5;         ///< of a match, pixels
  };
  Options options;

  template <class Camera>
  void track(const FrameView& frame, const Observations& observations, const Motion& motion, const Camera& camera,
             span<const Label> labels, Movers& result, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const Matches& matches = observations.matches;
    const double elapsed_s = matches.elapsed_s;
    objects_.reserve(kMostObjects);
    if (!(elapsed_s > 0)) return;
    predict(motion.current_from_reference, elapsed_s);

    DynamicPoints members(matches.size(), workspace), loose(matches.size(), workspace);
    const span<std::int32_t> object_of = workspace.take<std::int32_t>(matches.size(), kNone);
    assign(matches, labels, motion.current_from_reference, camera, members, loose, object_of, workspace);
    const MotionGroups groups(loose, elapsed_s, workspace);
    place_groups(groups, loose, elapsed_s, frame, object_of, matches, workspace);
    merge(object_of);
    for (std::size_t o = 0; o < objects_.size(); ++o)
      update(o, object_of, labels, matches, motion.current_from_reference, camera, frame, elapsed_s, workspace);
    forget(object_of, frame.timestamp_s);
    report(matches, observations.regions, object_of, result);
  }

  void reset() noexcept { objects_.clear(); }

 private:
  static constexpr std::size_t kMostObjects = 32;
  static constexpr std::int32_t kNone = -1;
  static constexpr double kAcceleration_m_s2 = 4.0, kAngular_rad_s2 = 4.0;
  static constexpr float kBeside_px = 24.0f;      // a cell of support corners, for a focal length of 525 px
  static constexpr double kSlow_m_s = 0.15;       // below it, what does not look dynamic may belong to an object as well
  static constexpr double kAlike_m_s = 0.6;       // parts of one object differ less in their mean velocity
  static constexpr double kLimb_m = 0.3;          // of one object that is new, parts may be so far from each other
  static constexpr double kMean_s = 0.3;          // over which velocities are averaged for that
  static constexpr double kLong_s = 0.6;          // the same for objects that are known to be two
  static constexpr double kFade_s = 1.0;          // in which the velocity of what is not seen fades
  static constexpr double kStands_m_s = 0.06;     // slower is standing, …
  static constexpr double kParkedAfter_s = 0.25;  // … after so long
  static constexpr double kTentative_s = 0.2;     // an object that was never reported is forgotten after so long
  static constexpr double kCorrelation = 4.0;     // neighbouring points share errors: covariances are too small by this
  static constexpr double kRigid = 0.75;          // mean share of points in one rigid motion from which on it is one

  void predict(const Pose& current_from_reference, double elapsed_s) {
    const Matrix3d& turn = current_from_reference.linear();
    for (TrackedObject& object : objects_) {
      object.linear.predict(turn, elapsed_s, kAcceleration_m_s2);
      object.angular.predict(turn, elapsed_s, kAngular_rad_s2);
      object.mover.centroid = current_from_reference * object.mover.centroid;
      object.mean_velocity = turn * object.mean_velocity;
      object.mean_turn = turn * object.mean_turn;
      object.long_velocity = turn * object.long_velocity;
      object.path = turn * object.path;
      object.path_covariance = turn * object.path_covariance * turn.transpose();
      for (Vector3d& point : object.points) point = current_from_reference * point;
      const Pose step = predicted_step(object, elapsed_s);
      for (Vector3d& point : object.points) point = step * point;
      object.mover.centroid = step * object.mover.centroid;
      object.mover.current_from_reference = step * current_from_reference;
    }
  }

  /// Of the object in the world, in the current camera's axes.
  static Pose predicted_step(const TrackedObject& object, double elapsed_s) {
    Pose step = Pose::Identity();
    if (object.turns) step.linear() = rotation_from_vector(elapsed_s * object.angular.velocity());
    const Vector3d& centroid = object.mover.centroid;
    step.translation() = centroid + elapsed_s * object.linear.velocity() - step.linear() * centroid;
    return step;
  }

  /// The feature as a pair: where it would be if it stood still, and where it is.
  template <class Camera>
  bool pair_of(const Matches& matches, std::size_t i, const Pose& current_from_reference, const Camera& camera,
               WhitenedPair& pair) const {
    if (!matches.metric(i)) {
      pair.current = matches.current.point[i];
      return false;
    }
    pair = WhitenedPair(current_from_reference * matches.reference.point[i], matches.reference.depth_sigma_m[i],
                        matches.current.point[i], matches.current.depth_sigma_m[i], options.pixel_sigma, camera);
    return true;
  }

  /// The nearest feature on the same surface that was found in the reference frame; their number where there is none.
  static std::size_t followed_beside(std::size_t i, const Matches& matches, const PixelGrid& followed) {
    constexpr double kSameSurface_m = 0.05;
    std::size_t nearest = matches.size();
    float least = std::numeric_limits<float>::infinity();
    followed.within(matches.current.pixel[i], kBeside_px * matches.pixel_scale, [&](std::size_t j, float squared) {
      if (!(squared < least) || !(std::abs(matches.current.depth_m[j] - matches.current.depth_m[i]) < kSameSurface_m))
        return;
      least = squared;
      nearest = j;
    });
    return nearest;
  }

  template <class Camera>
  void assign(const Matches& matches, span<const Label> labels, const Pose& current_from_reference,
              const Camera& camera, DynamicPoints&, DynamicPoints& loose, span<std::int32_t> object_of,
              Workspace& workspace) {
    const PredictedPoints predicted(objects_, camera, matches.pixel_scale, workspace);
    const PixelGrid followed(matches.current.pixel, kBeside_px * matches.pixel_scale, workspace,
                             [&](std::size_t i) { return !objects_.empty() && matches.metric(i); });
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.current.has_depth(i)) continue;
      const bool is_dynamic = labels[i].verdict == Verdict::dynamic;
      if (!is_dynamic && objects_.empty()) continue;
      WhitenedPair pair;
      const bool has_step = pair_of(matches, i, current_from_reference, camera, pair);
      const std::size_t beside = has_step ? i : followed_beside(i, matches, followed);
      PredictedPoints::Velocity velocity;
      if (beside < matches.size()) {
        velocity.is_known = true;
        const Vector3d before = current_from_reference * matches.reference.point[beside];
        velocity.value = (matches.current.point[beside] - before) / matches.elapsed_s;
        velocity.depth_sigma_m_s =
            std::hypot(matches.current.depth_sigma_m[beside], matches.reference.depth_sigma_m[beside]) /
            matches.elapsed_s;
      }
      const std::int32_t object = predicted.object_at(matches.current.pixel[i], matches.current.point[i],
                                                      matches.current.depth_sigma_m[i], velocity, objects_);
      if (object != kNone) {
        const TrackedObject& known = objects_[static_cast<std::size_t>(object)];
        if (is_dynamic || known.mean_speed() < kSlow_m_s) object_of[i] = object;
      } else if (is_dynamic) {
        loose.feature[loose.size] = static_cast<std::uint32_t>(i);
        loose.has_step[loose.size] = has_step;
        loose.pair[loose.size++] = pair;
      }
    }
  }

  /// What a group is: a part of an object that it touches, a lost object that is seen again, or a new one.
  void place_groups(const MotionGroups& groups, const DynamicPoints& loose, double elapsed_s, const FrameView& frame,
                    span<std::int32_t> object_of, const Matches& matches, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const span<std::uint32_t> members = workspace.take<std::uint32_t>(loose.size);
    const span<double> values = workspace.take<double>(loose.size);
    const std::size_t known = objects_.size();
    const span<std::size_t> seen = workspace.take<std::size_t>(kMostObjects);
    for (const std::int32_t object : object_of)
      if (object != kNone) ++seen[static_cast<std::size_t>(object)];
    for (std::size_t g = 0; g < groups.count; ++g) {
      std::size_t count = 0;
      Vector3d centroid = Vector3d::Zero();
      for (std::size_t k = 0; k < loose.size; ++k) {
        if (groups.of_point[k] != static_cast<std::int32_t>(g)) continue;
        members[count++] = static_cast<std::uint32_t>(k);
        centroid += loose.point(k);
      }
      if (count == 0) continue;
      centroid /= static_cast<double>(count);
      Vector3d velocity = Vector3d::Zero();
      for (int axis = 0; axis < 3; ++axis) {
        std::size_t steps = 0;
        for (std::size_t m = 0; m < count; ++m)
          if (loose.has_step[members[m]] != 0) values[steps++] = loose.step(members[m])(axis);
        if (steps > 0) velocity(axis) = median_in_place(values.first(steps)) / elapsed_s;
      }
      Appearance appearance;
      for (std::size_t m = 0; m < count; ++m)
        appearance.add(frame.gray, matches.current.pixel[loose.feature[members[m]]]);
      std::int32_t object = touched(loose, members.first(count), centroid, velocity, seen, known);
      if (object == kNone) object = seen_again(centroid, velocity, appearance, frame.timestamp_s, seen, known);
      if (object == kNone && count >= options.fewest_features && objects_.size() < kMostObjects)
        object = begin(centroid, velocity, frame.timestamp_s);
      if (object == kNone) continue;
      for (std::size_t m = 0; m < count; ++m) object_of[loose.feature[members[m]]] = object;
    }
  }

  std::int32_t touched(const DynamicPoints& loose, span<const std::uint32_t> members, const Vector3d& centroid,
                       const Vector3d& velocity, span<const std::size_t> seen, std::size_t known) const {
    constexpr double kLimbs_m_s = 0.6;
    std::int32_t best = kNone;
    std::size_t most = 0;
    for (std::size_t o = 0; o < known; ++o) {
      if (seen[o] < options.fewest_features) continue;
      const TrackedObject& object = objects_[o];
      const Vector3d there = object.mean_velocity + object.velocity_at(centroid) - object.linear.velocity();
      if (!((there - velocity).norm() < kLimbs_m_s)) continue;
      std::size_t near = 0;
      for (const std::uint32_t k : members) {
        const auto is_near = [&](const Vector3d& point) {
          return (point - loose.point(k)).squaredNorm() <= MotionGroups::kReach_m * MotionGroups::kReach_m;
        };
        near += std::any_of(object.points.begin(), object.points.end(), is_near);
      }
      if (2 * near >= members.size() && near > most) {
        most = near;
        best = static_cast<std::int32_t>(o);
      }
    }
    return best;
  }

  /// The lost object that is nearest in place, motion and appearance.
  std::int32_t seen_again(const Vector3d& centroid, const Vector3d& velocity, const Appearance& appearance,
                          double timestamp_s, span<const std::size_t> seen, std::size_t known) const {
    constexpr double kNear_m = 0.4, kNearPerSecond = 0.8, kSameMotion_m_s = 1.2, kAlike = 0.5, kMostCost = 1.6;
    std::int32_t best = kNone;
    double least = kMostCost;
    for (std::size_t o = 0; o < known; ++o) {
      const TrackedObject& object = objects_[o];
      if (seen[o] >= options.fewest_features) continue;
      const double unseen_s = timestamp_s - object.mover.last_seen_s;
      const double place = (centroid - object.mover.centroid).norm() / (kNear_m + kNearPerSecond * unseen_s);
      if (!(place < 1.0)) continue;
      const double motion = (velocity - object.linear.velocity()).norm() / kSameMotion_m_s;
      const double look = static_cast<double>(appearance.distance(object.appearance)) / kAlike;
      const double cost = place * place + motion * motion * 0.5 + look * look * 0.5;
      if (cost < least) {
        least = cost;
        best = static_cast<std::int32_t>(o);
      }
    }
    return best;
  }

  std::int32_t begin(const Vector3d& centroid, const Vector3d& velocity, double timestamp_s) {
    objects_.emplace_back();
    TrackedObject& object = objects_.back();
    object.mover.centroid = centroid;
    object.mover.first_seen_s = object.mover.last_seen_s = timestamp_s;
    object.linear.correct(velocity, 0.01 * Matrix3d::Identity());
    return static_cast<std::int32_t>(objects_.size() - 1);
  }

  /// What hangs together and moves alike is one object, the one that was known first.
  void merge(span<std::int32_t> object_of) {
    for (std::size_t b = objects_.size(); b-- > 1;) {
      for (std::size_t a = 0; a < b; ++a) {
        TrackedObject &one = objects_[a], &other = objects_[b];
        if (!one.is_seen || !other.is_seen || one.points.empty() || other.points.empty()) continue;
        const bool are_known = one.is_confirmed && other.is_confirmed;  // then they must clearly be one
        Vector3d u = are_known ? one.long_velocity : one.mean_velocity;
        const Vector3d& v = are_known ? other.long_velocity : other.mean_velocity;
        u += one.velocity_at(other.mover.centroid) - one.linear.velocity();  // if it turns
        const double slowest = are_known ? 2 * kSlow_m_s : kSlow_m_s, alike = are_known ? 0.5 * kAlike_m_s : kAlike_m_s;
        if (!(std::min(u.norm(), v.norm()) > slowest) || !((u - v).norm() < alike)) continue;
        if (!TrackedObject::touch(one, other, are_known ? MotionGroups::kReach_m : kLimb_m)) continue;
        const bool keeps_other = other.is_confirmed && (!one.is_confirmed || other.mover.id < one.mover.id);
        if (keeps_other) std::swap(one, other);
        for (const Vector3d& point : other.points)
          if (one.points.size() < TrackedObject::kMostPoints) one.points.push_back(point);
        for (std::int32_t& of : object_of) {
          if (of == static_cast<std::int32_t>(b) || of == static_cast<std::int32_t>(a)) of = static_cast<std::int32_t>(a);
          if (of > static_cast<std::int32_t>(b)) --of;
        }
        objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(b));
        break;
      }
    }
  }

  /// Measures an object's motion and takes over where its points are now.
  template <class Camera>
  void update(std::size_t o, span<const std::int32_t> object_of, span<const Label> labels, const Matches& matches,
              const Pose& current_from_reference, const Camera& camera, const FrameView& frame, double elapsed_s,
              Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    TrackedObject& object = objects_[o];
    const span<WhitenedPair> pairs = workspace.take<WhitenedPair>(matches.size());
    std::size_t members = 0, steps = 0, dynamic = 0;
    Appearance appearance;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (object_of[i] != static_cast<std::int32_t>(o)) continue;
      ++members;
      dynamic += labels[i].verdict == Verdict::dynamic;
      WhitenedPair pair;
      if (pair_of(matches, i, current_from_reference, camera, pair)) pairs[steps++] = pair;
      appearance.add(frame.gray, matches.current.pixel[i]);
    }
    object.is_seen = members >= options.fewest_features;
    if (!object.is_seen) {
      object.mover.state = MoverState::lost;
      object.linear.fade(std::exp(-elapsed_s / kFade_s));
      return;
    }
    ++object.seen_frames;
    object.mover.last_seen_s = frame.timestamp_s;
    object.appearance.blend(appearance, 0.1f);
    measure(object, pairs.first(steps), current_from_reference, elapsed_s, workspace);
    refresh_points(object, o, object_of, labels, matches, camera, frame, dynamic);
    settle(object, members, elapsed_s);
  }

  void measure(TrackedObject& object, span<const WhitenedPair> pairs, const Pose& current_from_reference,
               double elapsed_s, Workspace& workspace) const {
    const std::optional<ObjectMotion> shifted = ObjectMotionEstimator::translation(pairs, workspace);
    if (!shifted) return;  // as predicted
    ObjectMotion best = *shifted;
    const std::optional<ObjectMotion> turned = ObjectMotionEstimator::rigid(pairs, shifted->moved);
    const double share = 1.0 - std::exp(-elapsed_s / 0.3);
    object.rigid_share += share * ((turned ? turned->inlier_share : 0.0) - object.rigid_share);
    if (turned) observe_turn(object, *turned, elapsed_s);
    const bool is_rigid = turned && object.rigid_share > kRigid;
    if (is_rigid && object.turns) best = *turned;
    Mover& mover = object.mover;
    mover.has_rotation = is_rigid;
    mover.current_from_reference = orthonormalized(best.moved * current_from_reference);
    mover.covariance = kCorrelation * (is_rigid ? turned->covariance : shifted->covariance);
    const Vector3d before = inverted(best.moved) * object.mover.centroid;
    const Vector3d step = object.mover.centroid - before;
    const Matrix3d step_covariance = kCorrelation * shifted->covariance.bottomRightCorner<3, 3>();
    object.linear.correct(step / elapsed_s, step_covariance / (elapsed_s * elapsed_s));
    const double half_second = 1.0 - std::exp(-elapsed_s / kMean_s);
    const double second = 1.0 - std::exp(-elapsed_s / kLong_s);
    object.long_velocity += (object.seen_frames <= 1 ? 1.0 : second) * (step / elapsed_s - object.long_velocity);
    object.mean_velocity += (object.seen_frames <= 1 ? 1.0 : half_second) * (step / elapsed_s - object.mean_velocity);
    object.path += step;
    object.path_covariance += step_covariance;
  }

  /// A turn that noise explains is none: integrated over a second, noise would be degrees.
  static void observe_turn(TrackedObject& object, const ObjectMotion& turned, double elapsed_s) {
    constexpr double kTurns_sq = 25.0, kNoLonger_sq = 9.0;  // squared standard deviations
    const Vector3d turn = vector_from_rotation(turned.moved.linear()) / elapsed_s;
    const Matrix3d covariance = kCorrelation / (elapsed_s * elapsed_s) * turned.covariance.topLeftCorner<3, 3>();
    object.angular.correct(turn, covariance);
    const double share = 1.0 - std::exp(-elapsed_s / kMean_s);
    object.mean_turn += share * (turn - object.mean_turn);
    object.mean_turn_covariance += share * (share * covariance - (2.0 - share) * object.mean_turn_covariance);
    const Cholesky<3> factors(object.mean_turn_covariance);
    const double sigmas_sq = object.mean_turn.dot(factors.solve(object.mean_turn));
    object.turns = sigmas_sq > (object.turns ? kNoLonger_sq : kTurns_sq);
  }

  /// The dynamic members' points are the object's, and those that something nearer hides now; where these are few, as
  /// of an object that has just stopped, the old ones stay.
  template <class Camera>
  void refresh_points(TrackedObject& object, std::size_t o, span<const std::int32_t> object_of,
                      span<const Label> labels, const Matches& matches, const Camera& camera, const FrameView& frame,
                      std::size_t dynamic) const {
    constexpr DepthTolerance kSameSurface{0.1};
    const auto is_hidden = [&](const Vector3d& point) {
      constexpr double kNearest_m = 0.05;
      if (frame.depth.empty() || !(point.z() > kNearest_m)) return false;
      const DepthScale to_depth(frame.image(), frame.depth.image);
      const Vector2f pixel = to_depth(camera.distort(camera.project(point)).template cast<float>());
      if (!(frame.depth.image.border_distance_px(pixel.x(), pixel.y()) >= 0.0f)) return false;
      const auto there_m = static_cast<double>(frame.depth.metres(rounded(pixel.x()), rounded(pixel.y())));
      return there_m > 0 && there_m < point.z() - kSameSurface.at(0.0);
    };
    if (2 * dynamic >= object.points.size()) {
      std::size_t hidden = 0;
      for (const Vector3d& point : object.points)
        if (hidden < TrackedObject::kMostPoints / 2 && is_hidden(point)) object.points[hidden++] = point;
      object.points.resize(hidden);
    }
    const std::size_t room = TrackedObject::kMostPoints - object.points.size();
    const std::size_t every = std::max<std::size_t>(1, (dynamic + room) / std::max<std::size_t>(room, 1));
    std::size_t next = 0;
    for (std::size_t i = 0; i < matches.size() && object.points.size() < TrackedObject::kMostPoints; ++i)
      if (object_of[i] == static_cast<std::int32_t>(o) && labels[i].verdict == Verdict::dynamic && next++ % every == 0)
        object.points.push_back(matches.current.point[i]);
    object.mover.centroid = object.centroid_of_points();
  }

  void settle(TrackedObject& object, std::size_t members, double elapsed_s) {
    const double speed = object.mean_speed();
    object.slow_s = speed < kStands_m_s ? object.slow_s + elapsed_s : 0.0;
    if (object.slow_s >= kParkedAfter_s)
      object.mover.state = MoverState::parked;
    else if (object.mover.state != MoverState::parked || speed > 2 * kStands_m_s)
      object.mover.state = MoverState::moving;
    if (object.is_confirmed) return;
    const double path_m = object.path.norm();
    const double least_m = options.least_path_m * std::clamp(std::sqrt(20.0 / static_cast<double>(members)), 0.4, 1.0);
    if (!(path_m > (speed > kSlow_m_s ? least_m : 3 * least_m)) || members < 12) return;
    const Cholesky<3> factors(object.path_covariance);
    const double sigmas_sq = object.path.dot(factors.solve(object.path));
    object.is_confirmed = sigmas_sq > options.least_path_sigmas * options.least_path_sigmas && object.seen_frames >= 2;
    if (object.is_confirmed) object.mover.id = ++last_id_;
  }

  void forget(span<std::int32_t> object_of, double timestamp_s) {
    std::size_t kept = 0;
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      const TrackedObject& object = objects_[o];
      const double unseen_s = timestamp_s - object.mover.last_seen_s;
      const bool is_kept = unseen_s <= (object.is_confirmed ? options.remembered_s : kTentative_s);
      if (is_kept && kept != o) std::swap(objects_[kept], objects_[o]);
      for (std::int32_t& of : object_of)
        if (of == static_cast<std::int32_t>(o)) of = is_kept ? static_cast<std::int32_t>(kept) : kNone;
      kept += is_kept;
    }
    objects_.resize(kept);
  }

  void report(const Matches& matches, const Regions& regions, span<const std::int32_t> object_of,
              Movers& result) const {
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      const TrackedObject& object = objects_[o];
      if (!object.is_confirmed) continue;
      Mover mover = object.mover;
      mover.velocity = object.linear.velocity();
      mover.velocity_covariance = object.linear.covariance();
      mover.first_feature = result.feature.size();
      mover.first_pixel = result.pixel.size();
      for (std::size_t i = 0; i < matches.size(); ++i) {
        if (object_of[i] != static_cast<std::int32_t>(o)) continue;
        result.pixel.push_back(matches.current.pixel[i]);
        if (i >= matches.host_count) continue;
        result.feature.push_back(static_cast<std::uint32_t>(i));
        result.of_feature[i] = static_cast<std::int32_t>(result.list.size());
      }
      mover.feature_count = result.feature.size() - mover.first_feature;
      mover.pixel_count = result.pixel.size() - mover.first_pixel;
      name(mover, regions, result);
      if (mover.pixel_count > 0) mover.box = box_of(result.pixel, mover);
      result.list.push_back(mover);
    }
  }

  static void name(Mover&, const Regions&, const Movers&) {}

  static Box box_of(const std::vector<Vector2f>& pixels, const Mover& mover) {
    Vector2f low = pixels[mover.first_pixel], high = low;
    for (std::size_t k = mover.first_pixel; k < mover.first_pixel + mover.pixel_count; ++k) {
      low = low.cwiseMin(pixels[k]);
      high = high.cwiseMax(pixels[k]);
    }
    return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  }

  std::vector<TrackedObject> objects_;
  std::uint32_t last_id_ = 0;
};

template <class Visit>
void each_option(MoverTracking& stage, Visit& visit) {
  visit("fewest_features", stage.options.fewest_features, OptionRange{3, 1e6});
  visit("least_path_m", stage.options.least_path_m, OptionRange{0, 100});
  visit("least_path_sigmas", stage.options.least_path_sigmas, OptionRange{0, 1000});
  visit("remembered_s", stage.options.remembered_s, OptionRange{0, 3600});
  visit("pixel_sigma", stage.options.pixel_sigma, OptionRange{0.01, 100});
}

}  // namespace stillpoint
