// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where may something move, when the detector is slow, late or misses?   Boxes are carried along with what they hold.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/prior/carried_detection.hpp"
#include "stillpoint/prior/foreground_prior.hpp"
#include "stillpoint/prior/image_motion.hpp"

namespace stillpoint {

/// The prior of `DefaultPolicies`. An answer of the detector is carried from its frame to the current one by the motion
/// of the features on each object, and on from there until it is seen again or expires. Two ways to hand answers over:
/// - `prior.detections = {...}` before `filter_frame`: seen in the coming frame. The prior takes them (the vector is
///   empty afterwards); a frame for which nothing was written has no answer.
/// - `prior.detected(timestamp_s, detections)`: seen in the frame of that time, the coming one or one long past.
///   Here an empty list is an answer too: the detector looked and saw nothing.
class PropagatedPrior : public ForegroundPrior {
 public:
  struct Carrying {
    double longest_s = 2.0;  ///< an object that was not seen for longer is forgotten
  };
  Carrying carrying;

  /// An answer of the detector, perhaps late. Answers come in the order of their frames: an older one than the last is
  /// ignored. So is one of a frame that lies further back than this prior remembers (`ImageMotions::kCapacity`), or
  /// came before `reset()`.
  /// @param timestamp_s  of the frame that was looked at
  void detected(double timestamp_s, const std::vector<Detection>& found) {
    if (!(timestamp_s > last_answer_s_) || is_forgotten(timestamp_s)) return;
    const double interval_s = images_.empty() ? 0.0 : images_.newest().elapsed_s;
    if (images_.empty() || timestamp_s > images_.newest().timestamp_s + 0.5 * interval_s) {
      detections = found;
      is_answered_ = true;
      return;
    }
    // The pipeline judges from its second frame on: an answer of the first is taken for one of the second.
    if (timestamp_s < images_[0].timestamp_s - 1.5 * interval_s) return;
    take_late(images_.nearest(timestamp_s), found);
  }

  /// The regions of a frame: what was seen in it, as it was handed over, then what is carried.
  void regions(const FrameView& frame, Regions& regions) {
    if (images_.empty()) began_s_ = frame.timestamp_s;
    const bool is_long_ago = frame.timestamp_s - began_s_ > carrying.longest_s;  // no answer comes so late
    if (is_long_ago) forgotten_s_ = -std::numeric_limits<double>::infinity();
    const ImageMotion& image = images_.push(frame);
    for (CarriedDetection& object : objects_) {
      object.predict(image);
      follow_depth(frame.depth, DepthScale(frame.image(), frame.depth.image), image.elapsed_s, object);
    }
    ForegroundPrior::regions(frame, regions);
    if (is_answered_ || !detections.empty()) {
      fresh_.clear();
      for (const Detection& seen : regions.detections) fresh_.emplace_back(seen, frame.timestamp_s);
      merge(frame.timestamp_s);
    }
    detections.clear();
    is_answered_ = false;
    forget(image);
    for (const CarriedDetection& object : objects_)
      if (object.seen_s < frame.timestamp_s) append(object, frame.timestamp_s - object.seen_s, regions);
  }

  /// What moved how since the frame before: the features on each object carry it.
  template <class Camera>
  void observe(const Observations& observations, const Motion& motion, const Camera& camera) {
    const Matches& matches = observations.matches;
    if (images_.empty()) return;
    images_.reserve(matches.size());
    ImageMotion& image = images_.newest();
    // Frames without keypoints came between: the steps of the features reach back over all of them.
    if (motion.reference_timestamp_s > image.timestamp_s - 0.99 * image.elapsed_s) return;
    image.set_steps(matches);
    if (motion.usable()) image.set_camera_motion(motion, camera);
    for (CarriedDetection& object : objects_) object.correct(image, kFewestFeatures, workspace_);
  }

  /// What is known of objects in the frame that came last.
  span<const CarriedDetection> objects() const noexcept { return objects_; }
  [[deprecated("objects(); gone in 0.4")]] span<const CarriedDetection> things() const noexcept { return objects_; }

  /// Forgets objects and frames; `detections` stay, they are of the coming frame.
  void reset() noexcept {
    if (!images_.empty()) forgotten_s_ = images_.newest().timestamp_s;
    objects_.clear();
    images_.clear();
    last_answer_s_ = -std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double kHalfLife_s = 1.0;    // in which the confidence of an unseen box halves
  static constexpr int kMostMissed = 8;         // an object that was missing in more answers in a row is forgotten
  static constexpr double kGrowth_per_s = 0.2;  // share of its size by which an unseen box grows on each side
  static constexpr float kLeastOverlap = 0.2f;  // intersection over union: above, a new box is a carried object's
  static constexpr double kMostJump_m = 0.2;    // of an object's depth between frames; more is something before it …
  static constexpr double kFastest_m_s = 3.0;   // … unless it can have come or gone so far
  static constexpr std::size_t kFewestFeatures = 4;  // on an object, to be carried by them

  /// Finds the depth of a carried object, which can't have jumped: then something else is before it, or it is behind
  /// something, and its old depth stays.
  void follow_depth(const DepthView& depth, const DepthScale& to_depth, double elapsed_s,
                    CarriedDetection& object) const {
    if (depth.empty()) return;
    Detection measured = object.detection;
    set_range(depth, to_depth, measured);
    const double jump_m = 0.5 * (measured.nearest_m + measured.farthest_m) - object.depth_m();
    if (object.has_depth_range() && !(std::abs(jump_m) <= std::max(kMostJump_m, kFastest_m_s * elapsed_s))) return;
    object.detection.nearest_m = measured.nearest_m;
    object.detection.farthest_m = measured.farthest_m;
    object.detection.depth_slope_m = measured.depth_slope_m;
  }

  /// Lives the frames through again that came after the answer's.
  void take_late(std::size_t frame, const std::vector<Detection>& found) {
    fresh_.clear();
    for (const Detection& seen : found) {
      if (!is_valid(seen)) continue;
      CarriedDetection object(seen, images_[frame].timestamp_s);
      set_range(images_[frame].depth(), images_[frame].to_depth(), object.detection);
      object.correct(images_[frame], kFewestFeatures, workspace_);
      for (std::size_t i = frame + 1; i < images_.size(); ++i) {
        const ImageMotion& image = images_[i];
        object.predict(image);
        follow_depth(image.depth(), image.to_depth(), image.elapsed_s, object);
        object.correct(image, kFewestFeatures, workspace_);
      }
      fresh_.push_back(object);
    }
    merge(images_[frame].timestamp_s);
    forget(images_.newest());
  }

  struct Overlap {
    float of_union;  ///< intersection over union
    std::uint32_t fresh, object;
  };

  /// Pairs what was seen with what is carried, the best overlap first. What is left over is new, or was missed.
  void merge(double answer_s) {
    const Workspace::Scope scope(workspace_);
    const span<char> is_taken = workspace_.take<char>(fresh_.size()), is_seen = workspace_.take<char>(objects_.size());
    find_overlaps();
    for (const Overlap& pair : overlaps_) {
      if (is_taken[pair.fresh] || is_seen[pair.object]) continue;
      is_taken[pair.fresh] = is_seen[pair.object] = 1;
      objects_[pair.object].refresh(fresh_[pair.fresh]);
    }
    for (std::size_t t = 0; t < is_seen.size(); ++t)
      if (!is_seen[t]) ++objects_[t].missed;
    for (std::size_t f = 0; f < fresh_.size(); ++f)
      if (!is_taken[f]) objects_.push_back(fresh_[f]);
    last_answer_s_ = answer_s;
  }

  /// All pairs that may be the same object, the best overlap first.
  void find_overlaps() {
    overlaps_.clear();
    for (std::uint32_t f = 0; f < fresh_.size(); ++f) {
      for (std::uint32_t t = 0; t < objects_.size(); ++t) {
        if (fresh_[f].detection.mobility != objects_[t].detection.mobility) continue;
        const float overlap = intersection_over_union(fresh_[f].detection.box, objects_[t].detection.box);
        if (overlap > kLeastOverlap) overlaps_.push_back({overlap, f, t});
      }
    }
    std::sort(overlaps_.begin(), overlaps_.end(), [](const Overlap& a, const Overlap& b) {
      return std::tie(b.of_union, a.fresh, a.object) < std::tie(a.of_union, b.fresh, b.object);
    });
  }

  /// Of a frame before `reset()`? What is older than boxes live is of another recording's clock.
  bool is_forgotten(double timestamp_s) const noexcept {
    return timestamp_s <= forgotten_s_ && timestamp_s >= forgotten_s_ - carrying.longest_s;
  }

  void forget(const ImageMotion& image) {
    const auto is_gone = [&](const CarriedDetection& object) {
      return !(image.timestamp_s - object.seen_s <= carrying.longest_s) || object.missed > kMostMissed ||
             !object.is_in(image);
    };
    objects_.erase(std::remove_if(objects_.begin(), objects_.end(), is_gone), objects_.end());
  }

  void append(const CarriedDetection& object, double unseen_s, Regions& regions) const {
    const auto decay = static_cast<float>(std::exp2(-unseen_s / kHalfLife_s));
    const Detection grown = object.grown(static_cast<float>(kGrowth_per_s * unseen_s), decay);
    if (is_valid(grown)) regions.detections.push_back(grown);
  }

  ImageMotions images_;
  std::vector<CarriedDetection> objects_, fresh_;
  std::vector<Overlap> overlaps_;
  bool is_answered_ = false;  // even if `detections` is empty
  double last_answer_s_ = -std::numeric_limits<double>::infinity();
  double forgotten_s_ = -std::numeric_limits<double>::infinity();  // frames until then are of before `reset()`
  double began_s_ = 0;                                             // of the first frame after it
  Workspace workspace_;
};

template <class Visit>
void each_option(PropagatedPrior& stage, Visit& visit) {
  each_option(static_cast<BoxPrior&>(stage), visit);
  visit("longest_s", stage.carrying.longest_s, OptionRange{0, 3600});
}

}  // namespace stillpoint
