// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// FrameFilter: the whole pipeline. Which of a frame's features stand still?

#include <optional>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/depth_lookup.hpp"
#include "stillpoint/core/frame_check.hpp"
#include "stillpoint/core/frame_history.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/core/policy_traits.hpp"

namespace stillpoint {

struct DefaultPolicies;

/// Tells which of a frame's features stand still. One filter for one camera; two filters know nothing of each other,
/// one is not for two threads. Prints nothing, starts no thread, changes nothing of the host's.
/// @tparam Policies one type for each stage (policies.hpp); inherit from a set and name another type to replace a
/// stage.
template <class Policies = DefaultPolicies>
class FrameFilter : private PolicyContract<Policies> {
 public:
  using Camera = typename Policies::Camera;
  using DepthNoise = typename Policies::DepthNoise;
  using Matcher = typename Policies::Matcher;
  using EgoMotion = typename Policies::EgoMotion;
  using Memory = typename Policies::Memory;

  explicit FrameFilter(Camera camera_model) : camera(std::move(camera_model)), history_(Policies::kHistoryLength) {}

  Camera camera;                                ///< intrinsics and distortion
  FrameCheck frame_check;                       ///< which frames can be judged at all?
  DepthNoise depth_noise;                       ///< how wrong is a depth?
  typename Policies::DepthLookup depth_lookup;  ///< which depth belongs to a pixel?
  typename Policies::Prior prior;               ///< where may something move?
  Matcher matcher;                              ///< where was each feature before?
  EgoMotion ego_motion;                         ///< how did the camera move?
  typename Policies::Scorer scorer;             ///< how badly does each feature disagree with that motion?
  typename Policies::Gate gate;                 ///< which disagreement is more than noise?
  typename Policies::Classifier classifier;     ///< what moves together?
  Memory memory;                                ///< what did we know of this feature?
  typename Policies::KeepFloor keep_floor;      ///< how much must be left?

  /// Judges the key points of a frame. Call it before the tracker, with frames in the order of time.
  /// @param host_frame  its views need not outlive the call
  /// @param keypoints   any contiguous range of a type with `keypoint_traits`; pixels of the image as it is
  /// @return            one verdict a key point, in their order, valid until the next call. A frame that can't be
  /// judged
  ///                    has a status that says why, and keeps everything.
  template <class Keypoints>
  const FrameResult& filter_frame(const FrameView& host_frame, const Keypoints& keypoints) {
    result_.begin(read_pixels(keypoints), camera.width(), camera.height());
    Status& status = result_.status_ = frame_check(host_frame, last_timestamp_s_, camera);
    if (!FrameCheck::rejects(status)) {
      if (status != Status::ok) reset();
      const FrameView frame = with_gray(host_frame);
      if (status == Status::ok) status = pixels_.empty() ? Status::no_keypoints : judge(frame);
      remember(frame);
    }
    if (!judged(status)) result_.motion_.status = status;
    return result_;
  }

  /// The host's own pose of the frame that was filtered last, after its tracking. Those of two frames in a row predict
  /// the next motion. A pose that is not finite is none.
  void feedback(const Pose& world_from_camera) {
    if (!world_from_camera.matrix().allFinite()) return;
    world_from_last_ = world_from_camera;
    if (world_from_second_last_) last_motion_ = orthonormalized(world_from_camera.inverse() * *world_from_second_last_);
  }

  /// What an IMU or wheels say of the coming motion; holds for the next frame. A pose that is not finite is none.
  void expect_motion(const Pose& current_from_reference) {
    if (current_from_reference.matrix().allFinite()) motion_prior_.current_from_reference = current_from_reference;
  }

  /// Forgets every frame: after a relocalisation, a jump, the loop of a recording. Settings stay.
  void reset() {
    history_.clear();
    matcher.reset();
    memory.reset();
    last_timestamp_s_.reset();
    world_from_last_.reset();
    world_from_second_last_.reset();
    last_motion_.reset();
    motion_prior_ = MotionPrior{};
    filter_from_camera_ = Pose::Identity();
  }

 private:
  Status judge(const FrameView& frame) {
    const FrameView reference = history_.back(1).view();
    Motion& motion = result_.motion_;
    Timings& timings = result_.timings_;
    if (!motion_prior_.current_from_reference && last_motion_)
      motion_prior_.current_from_reference =
          scaled(*last_motion_, (frame.timestamp_s - *last_timestamp_s_) / last_interval_s_);
    workspace_.rewind();
    matches_.begin(pixels_);

    timings.run(Stage::prior, [&] { prior.regions(frame, regions_); });
    timings.run(Stage::match, [&] {
      matcher.match(reference, frame, matches_);
      lift(frame, depth_lookup, camera, depth_noise, matches_.current);
      lift(reference, depth_lookup, camera, depth_noise, matches_.reference);
    });
    regions_.locate(matches_.current.pixel);
    if constexpr (recalls<Memory>::value) timings.run(Stage::memory, [&] { memory.recall(matches_, workspace_); });
    timings.run(Stage::motion, [&] {
      motion = ego_motion.estimate(matches_, regions_, camera, motion_prior_, workspace_);
      motion.reference_timestamp_s = reference.timestamp_s;
    });
    if (!motion.usable()) return motion.status;
    if constexpr (looks_back<Matcher, Camera, DepthNoise>::value) look_again(frame, motion, timings);

    const span<FeatureScore> scores = workspace_.take<FeatureScore>(matches_.size());
    const span<Label> labels = workspace_.take<Label>(matches_.size());
    Threshold threshold;
    timings.run(Stage::score, [&] { scorer.score(matches_, motion, camera, scores); });
    timings.run(Stage::gate, [&] { threshold = gate.threshold(scores, regions_, workspace_); });
    timings.run(Stage::classify,
                [&] { classifier.classify(matches_, scores, threshold, regions_, labels, workspace_); });
    timings.run(Stage::memory, [&] { memory.update(matches_, motion, scores, labels, workspace_); });
    timings.run(Stage::verdict, [&] {
      keep_floor.apply(pixels_, frame.image(), labels.first(pixels_.size()), workspace_);
      result_.finish(labels, scores, matches_.current.depth_m);
    });
    return result_.keep_floor_kept() > 0 ? Status::keep_floor : motion.status;
  }

  /// With the motion known, looks for every feature in older frames, and refines the motion by what is seen there.
  void look_again(const FrameView& frame, Motion& motion, Timings& timings) {
    timings.run(Stage::match, [&] {
      matcher.look_back(history_, frame, filter_from(motion), camera, depth_noise, matches_, workspace_);
    });
    if constexpr (recalls_surfaces<Memory>::value)
      timings.run(Stage::memory, [&] { memory.recall_surfaces(matches_, workspace_); });
    if constexpr (refines<EgoMotion, Camera>::value)
      timings.run(Stage::motion, [&] { ego_motion.refine(matches_, regions_, camera, motion, workspace_); });
  }

  /// The filter's own chained pose of the current frame.
  Pose filter_from(const Motion& motion) const {
    return orthonormalized(filter_from_camera_ * motion.current_from_reference.inverse());
  }

  /// Makes this frame the reference of the next.
  void remember(const FrameView& frame) {
    const Motion& motion = result_.motion_;
    if (motion.usable())
      filter_from_camera_ = filter_from(motion);
    else
      history_.clear();  // the older frames' poses are not known from here
    history_.push(frame, filter_from_camera_);
    if (last_timestamp_s_) last_interval_s_ = frame.timestamp_s - *last_timestamp_s_;
    last_timestamp_s_ = frame.timestamp_s;
    world_from_second_last_ = world_from_last_;
    world_from_last_.reset();
    motion_prior_ = MotionPrior{};
    last_motion_.reset();
    if (motion.usable()) last_motion_ = motion.current_from_reference;
  }

  template <class Keypoints>
  span<const Vector2f> read_pixels(const Keypoints& keypoints) {
    using Keypoint = typename decltype(span(keypoints))::value_type;
    static_assert(detail::has_keypoint_traits<Keypoint>::value,
                  "stillpoint: specialise stillpoint::keypoint_traits<YourKeypoint> with static Vector2f pixel(const "
                  "YourKeypoint&); see core/keypoint.hpp");
    pixels_.clear();
    for (const Keypoint& keypoint : keypoints) pixels_.push_back(keypoint_traits<Keypoint>::pixel(keypoint));
    return pixels_;
  }

  FrameView with_gray(FrameView frame) {
    if (frame.gray.empty()) {
      gray_from_bgr(frame.colour, gray_);
      frame.gray = gray_.view();
    }
    return frame;
  }

  FrameHistory history_;
  ImageBuffer gray_;
  std::vector<Vector2f> pixels_;
  Regions regions_;
  Matches matches_;
  Workspace workspace_;
  FrameResult result_;
  MotionPrior motion_prior_;         // what the host expects of the coming frame
  std::optional<Pose> last_motion_;  // else the velocity holds: what was done within last_interval_s_
  double last_interval_s_ = 0.0;
  Pose filter_from_camera_ = Pose::Identity();
  std::optional<Pose> world_from_last_, world_from_second_last_;  // the host's poses of the last two frames
  std::optional<double> last_timestamp_s_;
};

}  // namespace stillpoint
