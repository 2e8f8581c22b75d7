// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which objects move, where, and how?   Dynamic features → objects with an identity, a motion and a velocity.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/movers/motion_groups.hpp"
#include "stillpoint/movers/mover_report.hpp"
#include "stillpoint/movers/moving_features.hpp"
#include "stillpoint/movers/object_association.hpp"
#include "stillpoint/movers/object_hypothesis.hpp"
#include "stillpoint/movers/object_identity.hpp"
#include "stillpoint/movers/object_update.hpp"
#include "stillpoint/movers/predicted_points.hpp"
#include "stillpoint/movers/tracked_object.hpp"

namespace stillpoint {

/// Follows objects. A dynamic feature belongs to the object beside whose predicted points it lies; what is left over is
/// grouped by motion, and a group is a part of an object that it touches, an object that was lost, or a new one. A new
/// object is reported once it has gone farther than noise would.
class MoverTracking {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::matches, capability::metric_motion>;

  struct Options {
    std::size_t fewest_features = 8;  ///< of an object that is seen; the filter's own corners count
    double least_path_m = 0.03;       ///< a new object of 20 features is reported when it has gone so far …
    double least_path_sigmas = 6.0;   ///< … and so many standard deviations of that
    double remembered_s = 2.0;        ///< an object that is not seen for longer is forgotten
    double pixel_sigma = 0.5;         ///< of a match, pixels
  };
  Options options;
  bool is_enabled = true;  ///< off: objects are forgotten, and nothing is spent; may change between frames. No option
  bool gives_back = true;  ///< kept features that move with the object that they lie on are dropped. No option

  /// @param motion  of the camera, in metres
  /// @param labels  of the filter; those that an object's motion explains better are changed (`gives_back`)
  /// @param result  empty, with an entry for each of the host's features
  template <class Camera>
  void track(const FrameView& frame, const Observations& observations, const Motion& motion, const Camera& camera,
             span<Label> labels, Movers& result, Workspace& workspace) {
    if (!is_enabled) return reset();
    const Workspace::Scope scope(workspace);
    const Matches& matches = observations.matches;
    objects_.reserve(kMostObjects);  // with the first frame, not with the first that moves
    result.reserve(matches.size(), kMostObjects);
    if (!(matches.elapsed_s > 0)) return;
    const MovingFeatures<Camera> features{frame,
                                          matches,
                                          labels,
                                          motion.current_from_reference,
                                          camera,
                                          options.pixel_sigma,
                                          workspace.take<std::int32_t>(matches.size(), kNone)};
    predict(motion, matches);
    const PixelGrid followed(matches.current.pixel, features.beside_px(), workspace,
                             [&](std::size_t i) { return !objects_.empty() && matches.metric(i); });
    const DynamicPoints loose = claim(features, followed, workspace);
    place(loose, features, workspace);
    ObjectAssociation::merge(objects_, features.object_of);
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      ObjectUpdate::run(objects_[o], static_cast<std::int32_t>(o), features, options.fewest_features, workspace);
    }
    take_lost_limbs_back(features.object_of);
    confirm(features.object_of, frame.timestamp_s);
    forget(features.object_of, frame.timestamp_s);
    if (gives_back) ObjectHypothesis::run(objects_, features, followed, labels, workspace);
    MoverReport::write(objects_, features, observations.regions, result, workspace);
  }

  /// Forgets every object; identifiers are not used again.
  void reset() noexcept { objects_.clear(); }

 private:
  static constexpr std::size_t kMostObjects = 32;
  static constexpr std::size_t kMostLoose = 4000;  // features that are grouped: K-means takes 10 ms of them
  static constexpr std::int32_t kNone = -1;
  static constexpr double kTentative_s = 0.2;  // an object that was never reported is forgotten after so long

  /// Where the objects are now. Over a frame or two that were not judged the camera went as it goes now; after more of
  /// them nobody knows where it looks, and so where the objects are.
  void predict(const Motion& motion, const Matches& matches) {
    constexpr double kLongestGuess_s = 0.11;  // a frame at 10 Hz, and what its stamps are rounded by
    if (matches.unjudged_s > kLongestGuess_s) return objects_.clear();
    const double elapsed_s = matches.elapsed_s + matches.unjudged_s;
    const Pose current_from_judged = matches.unjudged_s > 0
                                         ? scaled(motion.current_from_reference, elapsed_s / matches.elapsed_s)
                                         : motion.current_from_reference;
    for (TrackedObject& object : objects_) object.predict(current_from_judged, elapsed_s);
  }

  /// Gives features to the objects that they are of. What does not look dynamic may be of an object that hardly moves.
  /// @return the dynamic features that no object claims
  template <class Camera>
  DynamicPoints claim(const MovingFeatures<Camera>& features, const PixelGrid& followed, Workspace& workspace) const {
    const Matches& matches = features.matches;
    DynamicPoints loose(matches.size(), workspace);
    const PredictedPoints predicted(objects_, features.camera, matches.pixel_scale, workspace);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const bool is_dynamic = features.is_dynamic(i);
      if (!matches.current.has_depth(i) || (!is_dynamic && objects_.empty())) continue;
      const std::int32_t object = predicted.object_at(
          matches.current.pixel[i], matches.current.point[i], matches.current.depth_sigma_m[i],
          [&] { return features.velocity(i, followed); }, objects_);
      if (object == kNone) {
        if (is_dynamic) loose.add(i, features);
      } else if (is_dynamic || objects_[static_cast<std::size_t>(object)].mean_speed() < ObjectAssociation::kSlow_m_s) {
        features.object_of[i] = object;
      }
    }
    loose.thin_out(kMostLoose);
    return loose;
  }

  /// Groups what is left over, and finds or begins the object of each group.
  template <class Camera>
  void place(const DynamicPoints& loose, const MovingFeatures<Camera>& features, Workspace& workspace) {
    const MotionGroups groups(loose, features.elapsed_s(), workspace);
    const span<std::uint8_t> is_seen = workspace.take<std::uint8_t>(objects_.size());
    for (std::size_t o = 0; o < is_seen.size(); ++o)
      is_seen[o] = static_cast<std::size_t>(std::count(features.object_of.begin(), features.object_of.end(),
                                                       static_cast<std::int32_t>(o))) >= options.fewest_features;
    const span<std::uint32_t> members = workspace.take<std::uint32_t>(loose.size);
    for (std::size_t g = 0; g < groups.count; ++g) {
      std::size_t count = 0;
      for (std::size_t k = 0; k < loose.size; ++k)
        if (groups.of_point[k] == static_cast<std::int32_t>(g)) members[count++] = static_cast<std::uint32_t>(k);
      if (count == 0) continue;
      LooseGroup group(loose, {members.data(), count}, features.elapsed_s(), workspace);
      for (const std::uint32_t k : group.members)
        group.appearance.add(features.frame.gray, features.matches.current.pixel[loose.feature[k]]);
      std::int32_t object = ObjectAssociation::touched(group, loose, objects_, is_seen);
      if (object == kNone) object = ObjectAssociation::seen_again(group, features.frame.timestamp_s, objects_, is_seen);
      if (object == kNone && count >= options.fewest_features && objects_.size() < kMostObjects)
        object = begin(group, features.frame.timestamp_s);
      if (object == kNone) continue;
      for (const std::uint32_t k : group.members) features.object_of[loose.feature[k]] = object;
    }
  }

  std::int32_t begin(const LooseGroup& group, double timestamp_s) {
    constexpr double kSigma_m_s = 0.1;
    objects_.emplace_back();
    TrackedObject& object = objects_.back();
    object.mover.centroid = group.centroid;
    object.size_m.setZero();
    object.mover.first_seen_s = object.mover.last_seen_s = timestamp_s;
    object.linear.correct(group.velocity, kSigma_m_s * kSigma_m_s * Matrix3d::Identity());
    return static_cast<std::int32_t>(objects_.size() - 1);
  }

  void take_lost_limbs_back(span<std::int32_t> object_of) {
    for (std::size_t o = objects_.size(); o-- > 0;) {
      const std::int32_t body = ObjectIdentity::body_of_lost(objects_, o);
      if (body != kNone) ObjectIdentity::unite(objects_, static_cast<std::size_t>(body), o, object_of);
    }
  }

  /// Reports new objects, the largest first. One that proves to be an object that is known gets no identifier.
  void confirm(span<std::int32_t> object_of, double timestamp_s) {
    while (true) {
      std::size_t next = objects_.size();
      for (std::size_t o = 0; o < objects_.size(); ++o)
        if (moves(objects_[o]) && !ObjectIdentity::may_be_limb(objects_, o, timestamp_s) &&
            (next == objects_.size() || objects_[o].members > objects_[next].members))
          next = o;
      if (next == objects_.size()) return;
      const std::int32_t known = ObjectIdentity::known(objects_, next, timestamp_s);
      if (known != kNone) {
        ObjectIdentity::unite(objects_, static_cast<std::size_t>(known), next, object_of);
      } else {
        objects_[next].is_confirmed = true;
        objects_[next].mover.id = ++last_id_;
      }
    }
  }

  /// Is the way of an object that is not reported yet more than noise? The more features, the shorter; slow ones must
  /// go three times as far, since the errors that many features share look like slow motion.
  bool moves(const TrackedObject& object) const {
    constexpr std::size_t kFewest = 12;
    constexpr int kFewestFrames = 2;
    if (object.is_confirmed || !object.is_seen || object.members < kFewest || object.seen_frames < kFewestFrames)
      return false;
    const double by_members = std::clamp(std::sqrt(20.0 / static_cast<double>(object.members)), 0.4, 1.0);
    const double by_speed = object.mean_speed() > ObjectAssociation::kSlow_m_s ? 1.0 : 3.0;
    if (!(object.path.norm() > options.least_path_m * by_members * by_speed)) return false;
    const Cholesky<3> factors(object.path_covariance);
    const double sigmas_sq = object.path.dot(factors.solve(object.path));
    return sigmas_sq > options.least_path_sigmas * options.least_path_sigmas;
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
