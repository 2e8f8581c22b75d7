// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What an object did since the last frame: its motion, its points, its state.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/movers/appearance.hpp"
#include "stillpoint/movers/moving_features.hpp"
#include "stillpoint/movers/object_motion.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Brings an object, as it was predicted, up to date with the features that are its own.
class ObjectUpdate {
 public:
  static constexpr double kMean_s = 0.3, kLong_s = 0.6;  // over which velocities are averaged

  /// @param index             of the object, in `features.object_of`
  /// @param fewest_features   of an object that is seen
  template <class Camera>
  static void run(TrackedObject& object, std::int32_t index, const MovingFeatures<Camera>& features,
                  std::size_t fewest_features, Workspace& workspace) {
    constexpr float kAppearanceShare = 0.1f;
    const Workspace::Scope scope(workspace);
    const Matches& matches = features.matches;
    const span<WhitenedPair> pairs = workspace.take<WhitenedPair>(matches.size());
    std::size_t members = 0, steps = 0, dynamic = 0;
    Appearance appearance;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (features.object_of[i] != index) continue;
      ++members;
      dynamic += features.is_dynamic(i);
      if (matches.metric(i)) pairs[steps++] = features.pair(i);
      appearance.add(features.frame.gray, matches.current.pixel[i]);
    }
    object.is_seen = members >= fewest_features;
    if (!object.is_seen) {
      lose(object, features.frame.timestamp_s, features.elapsed_s());
      return;
    }
    ++object.seen_frames;
    object.members = members;
    object.mover.last_seen_s = features.frame.timestamp_s;
    object.appearance.blend(appearance, kAppearanceShare);
    measure(object, pairs.first(steps), features.current_from_reference, features.elapsed_s(), workspace);
    refresh_points(object, index, features, dynamic);
    object.size_m = object.mover.extent_m.cwiseMax(object.size_m * std::exp(-features.elapsed_s() / kSize_s));
    settle(object, features.elapsed_s());
  }

 private:
  static constexpr double kKeeps_s = 1.0;         // for so long what is not seen keeps its velocity, …
  static constexpr double kFade_s = 1.0;          // … which then fades
  static constexpr double kSize_s = 2.0;          // for which the size of what is seen only in part is remembered
  static constexpr double kStands_m_s = 0.06;     // slower is at rest, …
  static constexpr double kParkedAfter_s = 0.25;  // … after so long
  static constexpr double kCorrelation = 4.0;     // neighbouring points share errors: covariances are too small by this
  static constexpr double kRigid = 0.82;          // mean share of points in one rigid motion from which on it is one

  /// Of the newest of `count` values, in a mean that forgets and is the plain mean as long as they are few.
  static double mean_share(double elapsed_s, double memory_s, int count) {
    return std::max(exponential_share(elapsed_s, memory_s), 1.0 / count);
  }

  /// The last bit of an object that is seen beside what covers it is measured badly: it goes on as it went on average,
  /// unless it has just started or stopped.
  static void lose(TrackedObject& object, double timestamp_s, double elapsed_s) {
    constexpr double kSteady_m_s = 0.3;
    const bool is_steady = (object.linear.velocity() - object.mean_velocity).norm() < kSteady_m_s;
    if (object.mover.state != MoverState::lost && is_steady) object.linear.set_velocity(object.mean_velocity);
    if (timestamp_s - object.mover.last_seen_s > kKeeps_s) object.linear.fade(std::exp(-elapsed_s / kFade_s));
    object.mover.state = MoverState::lost;
  }

  static void measure(TrackedObject& object, span<const WhitenedPair> pairs, const Pose& camera_motion,
                      double elapsed_s, Workspace& workspace) {
    const std::optional<ObjectMotion> shifted = ObjectMotionEstimator::translation(pairs, workspace);
    if (!shifted) return;  // as predicted
    const std::optional<ObjectMotion> turned = ObjectMotionEstimator::rigid(pairs, shifted->moved);
    const double inlier_share = turned ? turned->inlier_share : 0.0;
    object.rigid_share += exponential_share(elapsed_s, kMean_s) * (inlier_share - object.rigid_share);
    object.fit_share += mean_share(elapsed_s, kMean_s, 1 + object.seen_frames) * (inlier_share - object.fit_share);
    if (turned) {
      observe_turn(object, *turned, elapsed_s);
      observe_bending(object, pairs, shifted->moved, turned->moved, elapsed_s);
    }
    const bool is_rigid = turned && object.fit_share > kRigid && !object.bends();
    object.turns = object.turns && is_rigid;
    object.surely_turns = object.surely_turns && is_rigid && object.rigid_share > kRigid;
    const Pose& moved = object.surely_turns ? turned->moved : shifted->moved;
    Mover& mover = object.mover;
    mover.has_rotation = is_rigid;
    const Pose reported = object.turns ? with_pixels_weighed(turned->moved, pairs, workspace) : shifted->moved;
    mover.current_from_reference = orthonormalized(reported * camera_motion);
    mover.covariance = kCorrelation * (is_rigid ? turned->covariance : shifted->covariance);

    const Vector3d step = mover.centroid - inverted(moved) * mover.centroid, velocity = step / elapsed_s;
    const Matrix3d covariance = kCorrelation * shifted->covariance.bottomRightCorner<3, 3>();
    object.linear.correct(velocity, covariance / (elapsed_s * elapsed_s));
    object.mean_velocity += mean_share(elapsed_s, kMean_s, object.seen_frames) * (velocity - object.mean_velocity);
    object.long_velocity += mean_share(elapsed_s, kLong_s, object.seen_frames) * (velocity - object.long_velocity);
    object.path += step;
    object.path_covariance += covariance;
  }

  /// Where pixels are better than `pixel_sigma` says, depth has too much of a say: its noise turns a small object by
  /// degrees within a second. For the pose that is reported: associations and the test for a turn are as cautious as
  /// `pixel_sigma` is.
  static Pose with_pixels_weighed(const Pose& moved, span<const WhitenedPair> pairs, Workspace& workspace) {
    const double noise = ObjectMotionEstimator::pixel_noise(pairs, moved, workspace);
    if (!(noise < 1.0)) return moved;
    const std::optional<ObjectMotion> better = ObjectMotionEstimator::rigid(pairs, moved, noise);
    return better ? better->moved : moved;
  }

  /// A turn that noise explains is taken for none: integrated over a second, it would be degrees. Features are expected
  /// to turn with the object only where it is more certain still.
  static void observe_turn(TrackedObject& object, const ObjectMotion& turned, double elapsed_s) {
    constexpr double kTurns_sq = 9.0, kNoLonger_sq = 5.0;  // squared standard deviations
    constexpr double kSurely_sq = 25.0, kNoLongerSurely_sq = 9.0;
    const Vector3d turn = vector_from_rotation(turned.moved.linear()) / elapsed_s;
    const Matrix3d covariance = kCorrelation / (elapsed_s * elapsed_s) * turned.covariance.topLeftCorner<3, 3>();
    object.angular.correct(turn, covariance);
    const double share = mean_share(elapsed_s, kMean_s, 1 + object.seen_frames);
    object.mean_turn += share * (turn - object.mean_turn);
    object.mean_turn_covariance += share * (share * covariance - (2.0 - share) * object.mean_turn_covariance);
    const Cholesky<3> factors(object.mean_turn_covariance);
    const double sigmas_sq = object.mean_turn.dot(factors.solve(object.mean_turn));
    object.turns = sigmas_sq > (object.turns ? kNoLonger_sq : kTurns_sq);
    object.surely_turns = sigmas_sq > (object.surely_turns ? kNoLongerSurely_sq : kSurely_sq);
  }

  /// Do its parts move against each other when the turn is taken out?
  static void observe_bending(TrackedObject& object, span<const WhitenedPair> pairs, const Pose& shifted,
                              const Pose& turned, double elapsed_s) {
    constexpr double kMemory_s = 1.0;  // a stride
    const std::optional<double> left = ObjectMotionEstimator::bending_sq(pairs, turned, elapsed_s),
                                turn = ObjectMotionEstimator::bending_sq(pairs, shifted, elapsed_s);
    const double share = exponential_share(elapsed_s, kMemory_s);
    if (left) object.bending_sq += share * (*left - object.bending_sq);
    if (turn) object.bending_with_turn_sq += share * (*turn - object.bending_with_turn_sq);
  }

  /// The points of the dynamic members are the object's, and those that something nearer hides now. Where these are
  /// few, as of an object that has just stopped, the old ones stay.
  template <class Camera>
  static void refresh_points(TrackedObject& object, std::int32_t index, const MovingFeatures<Camera>& features,
                             std::size_t dynamic) {
    ObjectPoints& points = object.points;
    if (2 * dynamic >= points.size()) {
      std::size_t hidden = 0;
      for (const Vector3d& point : points)
        if (hidden < ObjectPoints::kMost / 2 && is_hidden(point, features)) points[hidden++] = point;
      points.shrink(hidden);
    }
    const std::size_t room = ObjectPoints::kMost - points.size(), every = room > 0 ? (dynamic + room) / room : 1;
    std::size_t next = 0;
    for (std::size_t i = 0; i < features.matches.size(); ++i)
      if (features.object_of[i] == index && features.is_dynamic(i) && next++ % every == 0)
        points.add(features.matches.current.point[i]);
    if (points.empty()) return;
    Vector3d sum = Vector3d::Zero(), low = points[0], high = points[0];
    for (const Vector3d& point : points) {
      sum += point;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    object.mover.centroid = sum / static_cast<double>(points.size());
    object.mover.extent_m = high - low;
  }

  /// Does the frame show something nearer in its place?
  template <class Camera>
  static bool is_hidden(const Vector3d& point, const MovingFeatures<Camera>& features) {
    constexpr double kNearest_m = 0.05, kNearer_m = 0.1;
    const FrameView& frame = features.frame;
    if (frame.depth.empty() || !(point.z() > kNearest_m)) return false;
    const Vector2d ideal = features.camera.project(point);
    const Vector2f pixel = DepthScale(frame.image(), frame.depth.image)(to_float(features.camera.distort(ideal)));
    if (!(frame.depth.image.border_distance_px(pixel.x(), pixel.y()) >= 0.0f)) return false;
    const auto there_m = static_cast<double>(frame.depth.metres(rounded(pixel.x()), rounded(pixel.y())));
    return there_m > 0 && there_m < point.z() - kNearer_m;
  }

  static void settle(TrackedObject& object, double elapsed_s) {
    const double speed = object.mean_speed();
    object.slow_s = speed < kStands_m_s ? object.slow_s + elapsed_s : 0.0;
    if (object.slow_s >= kParkedAfter_s)
      object.mover.state = MoverState::parked;
    else if (object.mover.state != MoverState::parked || speed > 2 * kStands_m_s)
      object.mover.state = MoverState::moving;
  }
};

}  // namespace stillpoint
