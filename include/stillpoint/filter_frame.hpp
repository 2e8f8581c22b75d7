// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// FrameFilter: the whole pipeline. Which of a frame's features stand still?

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_scale.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/no_depth_registration.hpp"
#include "stillpoint/depth/no_hole_filling.hpp"
#include "stillpoint/fwd.hpp"
#include "stillpoint/movers/no_movers.hpp"
#include "stillpoint/pipeline/frame_check.hpp"
#include "stillpoint/pipeline/frame_history.hpp"
#include "stillpoint/pipeline/mask_prediction.hpp"
#include "stillpoint/pipeline/motion_expectation.hpp"
#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "stillpoint/pipeline/stage_fit.hpp"
#include "stillpoint/pipeline/use_check.hpp"

namespace stillpoint {

/// Tells which of a frame's features stand still. One filter for one camera; two filters know nothing of each other,
/// one is not for two threads. Prints nothing, starts no thread, changes nothing of the host's.
/// @tparam Policies one type for each stage (policies.hpp); inherit from a set and name another type to replace a
/// stage.
template <class Policies>
class FrameFilter : private PolicyContract<Policies>, private StageFit<Policies> {
 public:
  using Camera = typename Policies::Camera;
  using DepthNoise = typename Policies::DepthNoise;
  using Prior = typename Policies::Prior;
  using Matcher = typename Policies::Matcher;
  using EgoMotion = typename Policies::EgoMotion;
  using Memory = typename Policies::Memory;

  explicit FrameFilter(Camera camera_model) : camera(std::move(camera_model)), history_(Policies::kHistoryLength) {}

  Camera camera;                                     ///< intrinsics and distortion; one of another size begins anew
  FrameCheck frame_check;                            ///< which frames can be judged at all?
  DepthNoise depth_noise;                            ///< how wrong is a depth?
  typename Policies::DepthLookup depth_lookup;       ///< which depth belongs to a pixel?
  DepthRegistrationOf<Policies> depth_registration;  ///< does depth lie on the image?
  HoleFillingOf<Policies> hole_filling;              ///< what lies where the depth image has a hole?
  Prior prior;                                       ///< where may something move?
  Matcher matcher;                                   ///< where was each feature before?
  EgoMotion ego_motion;                              ///< how did the camera move?
  typename Policies::Scorer scorer;                  ///< how badly does each feature disagree with that motion?
  typename Policies::Gate gate;                      ///< which disagreement is more than noise?
  typename Policies::Classifier classifier;          ///< which features move together?
  Memory memory;                                     ///< what did we know of this feature?
  typename Policies::KeepFloor keep_floor;           ///< how much must be left?
  MoversOf<Policies> movers;                         ///< which objects move, and how?
  MaskPrediction mask_prediction;                    ///< where will the coming frame show moving objects?

  /// Judges the keypoints of a frame. Call it before the tracker, with frames in the order of time.
  /// @param host_frame  its views need not outlive the call
  /// @param keypoints   any contiguous range of a type with `keypoint_traits`; pixels of the image as it is
  /// @return            one verdict per keypoint, in their order, valid until the next call. A frame that can't be
  ///                    judged has a status that says why, and keeps everything.
  template <class Keypoints>
  const FrameResult& filter_frame(const FrameView& host_frame, const Keypoints& keypoints) {
    result_.begin(read_pixels(keypoints, pixels_), camera.width(), camera.height());
    if (!history_.empty() && !frame_check.has_size(history_.back(1).view().image(), camera)) reset();  // a new camera
    Status& status = result_.status_ = options_error().empty()
                                           ? frame_check(host_frame, expectation_.last_timestamp_s(), camera)
                                           : Status::invalid_options;
    FrameView frame = host_frame;
    if (!FrameCheck::rejects(status)) {
      mask_prediction.forget();
      if (status != Status::ok) reset();
      frame = with_gray(host_frame, gray_);
      if (frame.depth.empty()) frame.depth = DepthView();  // no stage reads a size without data
      if (status == Status::ok) {
        status = judge(frame);
        if (pixels_.empty()) status = Status::no_keypoints;  // the stages went on by corners of their own
      }
      history_.push(frame, result_.motion_);
      expectation_.advance(frame.timestamp_s, result_.motion_);
    }
    if (!judged(status)) result_.motion_.status = status;
    use_check_.observe(status, frame, camera, pixels_, result_.depth_m_, result_.motion_);
    result_.warnings_.add(use_check_.warnings());
    result_.warnings_.add(depth_registration.warnings());
    result_.hint_ = UseCheck::hint(status, result_.warnings_);
    return result_;
  }

  /// The host's own pose of the frame that was filtered last, after its tracking. Those of two frames in a row predict
  /// the next motion. A pose that is not rigid is none, nor is a motion of more than 100 m (`is_plausible_motion`).
  /// After a frame that was rejected, the host's pose is of that one's time and is not used.
  void feedback(const Pose& world_from_camera) {
    if (FrameCheck::rejects(result_.status())) return;
    const std::optional<Pose> host_motion = expectation_.feedback(world_from_camera);
    if (host_motion) use_check_.compare(*host_motion, result_.motion_);
  }

  /// What an IMU or wheels say of the coming motion; holds for the next frame. One that is not rigid, or
  /// longer than 100 m, is none (`is_plausible_motion`).
  void expect_motion(const Pose& current_from_reference) { expectation_.expect(current_from_reference); }

  /// Which keypoints of the frame that was filtered last move, by the host's own map: evidence of more views than the
  /// filter keeps. The memory takes it for the coming frame; one that remembers nothing does not.
  /// @param is_dynamic  one byte per keypoint, 1: moves. Of another length, or after a frame that was not judged: no
  ///                    evidence.
  void expect_dynamic(span<const std::uint8_t> is_dynamic) {
    if (is_dynamic.size() == result_.keep().size() && judged(result_.status()))
      stillpoint::expect_dynamic(memory, is_dynamic);
  }

  /// Where the coming frame should be looked at: for a host that extracts features only after it has seen a mask, so
  /// that its budget goes to static features. Everywhere, where the last frame was not judged for more than a want of
  /// keypoints, is more than a second older, not older at all or of another camera, or an option is out of its range. A
  /// frame that was rejected is none: the one before it is the last. It knows no keep-floor.
  /// @param timestamp_s  of the coming frame
  /// @param margin_px    more is dropped around moving objects; 8 in all measured figures (docs/adopting.md)
  /// @param mask         becomes gray8 of the camera's size: 255 keeps, 0 drops; its memory is reused
  void predicted_keep_mask(double timestamp_s, int margin_px, ImageBuffer& mask) {
    const bool is_new_camera = !history_.empty() && !frame_check.has_size(history_.back(1).view().image(), camera);
    if (is_new_camera || !options_error().empty()) return keep_everywhere(camera.width(), camera.height(), mask);
    const DepthView depth = history_.empty() ? DepthView() : history_.back(1).view().depth;
    mask_prediction.paint(timestamp_s, depth, camera.width(), camera.height(), margin_px, mask, workspace_);
  }

  /// Which option is out of its range, what it is and what it may be, as in "gate.false_positive_rate is 5, expected a
  /// number from 0.000001 to 0.5"; empty where all are in range. A frame is `invalid_options` as long as one is not.
  std::string options_error() {
    OptionCheck check;
    each_option(*this, check);
    return check.error();
  }

  /// Forgets all frames: where the images jump to another place, as when a recording begins again. Not for a
  /// relocalisation or a new map of the host: the images go on. Settings stay.
  void reset() {
    history_.clear();
    depth_registration.reset();
    hole_filling.reset();
    reset_policy(prior);
    matcher.reset();
    reset_policy(gate);
    memory.reset();
    movers.reset();
    expectation_ = MotionExpectation();
    mask_prediction.forget();
    last_judged_s_.reset();
  }

 private:
  /// @param frame  its depth is that of the image's time afterwards, if the motion is known
  Status judge(FrameView& frame) {
    const FrameView as_it_came = frame, reference = history_.back(1).view();
    Motion& motion = result_.motion_;
    Timings& timings = result_.timings_;
    workspace_.rewind();
    Matches& matches = observations_.matches;
    Regions& regions = observations_.regions;
    matches.begin(pixels_);
    matches.pixel_scale = pixel_scale(camera);
    matches.elapsed_s = frame.timestamp_s - reference.timestamp_s;
    matches.unjudged_s = last_judged_s_ ? reference.timestamp_s - *last_judged_s_ : 0.0;

    const MotionPrior expected = expectation_.at(frame.timestamp_s);
    Pose rough_motion = Pose::Identity();  // current_from_reference

    // Observations: where was each feature, and what is known of it?
    timings.run(Stage::prior, [&] { prior.regions(frame, regions); });
    timings.run(Stage::match, [&] {
      rough_motion = align(matcher, reference, frame, expected, camera, depth_noise);
      frame.depth = depth_registration.undo(reference, frame, rough_motion, camera);
      frame.depth = hole_filling.fill(reference, frame, rough_motion, camera, depth_noise);
      matcher.match(reference, frame, matches);
      frame.depth = fill_along_flow(hole_filling, reference, frame, matches, depth_noise, workspace_);
      frame.depth = undo_along_flow(depth_registration, as_it_came, frame, matches, workspace_);
      lift(frame, depth_lookup, camera, depth_noise, matches.current);
      lift(reference, depth_lookup, camera, depth_noise, matches.reference);
      regions.locate(matches.current.pixel, matches.current.depth_m);
      choose_keyframes(matcher, history_, frame, rough_motion, camera, depth_noise, matches, workspace_);
    });
    timings.run(Stage::memory, [&] { recall(memory, matches, observations_.remembered, workspace_); });

    // Motion: how did the camera move?
    timings.run(Stage::motion, [&] {
      motion = ego_motion.estimate(observations_, camera, expected, workspace_);
      motion.reference_timestamp_s = reference.timestamp_s;
    });
    timings.run(Stage::match, [&] { refuse_if_contradicted(matcher, camera, motion); });
    timings.run(Stage::prior, [&] { observe(prior, observations_, motion, camera); });
    if (!motion.usable()) {
      frame.depth = as_it_came.depth;
      return motion.status;
    }
    timings.run(Stage::match,
                [&] { reproject_into_past(matcher, history_, frame, motion, camera, depth_noise, observations_); });
    timings.run(Stage::motion, [&] { refine(ego_motion, observations_, camera, expected, motion, workspace_); });

    // Evidence: what disagrees with that motion, by more than noise?
    const span<FeatureScore> scores = workspace_.take<FeatureScore>(matches.size());
    Evidence evidence{scores, {}};
    timings.run(Stage::score, [&] { scorer.score(observations_, motion, camera, scores); });
    timings.run(Stage::gate, [&] { evidence.threshold = gate.threshold(scores, regions, workspace_); });

    // Verdicts: which features move together, what did we know, and how much must be left?
    const span<Label> labels = workspace_.take<Label>(matches.size());
    timings.run(Stage::classify, [&] { classifier.classify(observations_, evidence, labels, workspace_); });
    timings.run(Stage::gate, [&] { learn(gate, observations_, labels); });
    timings.run(Stage::memory, [&] { memory.update(observations_, motion, evidence, labels, workspace_); });
    timings.run(Stage::match, [&] {
      learn(matcher, observations_, labels);
      depth_registration.observe(as_it_came, matches, labels, motion, camera);
    });
    if constexpr (kHasMovers<Policies>)  // without, not even a look at the clock
      timings.run(Stage::movers,
                  [&] { movers.track(frame, observations_, motion, camera, labels, result_.movers_, workspace_); });
    timings.run(Stage::verdict, [&] {
      mask_prediction.remember(matches, labels, frame.timestamp_s);
      if constexpr (kHasMovers<Policies>) mask_prediction.follow(result_.movers_, matches, camera);
      keep_floor.apply(pixels_, frame.image(), labels.first(pixels_.size()), workspace_);
      result_.finish(labels, scores, matches.current.depth_m);
    });
    result_.warnings_ = motion.warnings;
    if (result_.keep_floor_kept() > 0) result_.warnings_.add(Warning::keep_floor);
    last_judged_s_ = frame.timestamp_s;
    return motion.status;
  }

  FrameHistory history_;
  MotionExpectation expectation_;
  std::optional<double> last_judged_s_;
  UseCheck use_check_;
  ImageBuffer gray_;
  std::vector<Vector2f> pixels_;
  Observations observations_;
  Workspace workspace_;
  FrameResult result_;
};

/// The options of all stages, in the order of the filter's members (core/options.hpp); the camera is none.
template <class Policies, class Visit>
void each_option(FrameFilter<Policies>& filter, Visit& visit) {
  visit("frame_check", filter.frame_check);
  visit("depth_noise", filter.depth_noise);
  visit("depth_lookup", filter.depth_lookup);
  visit("depth_registration", filter.depth_registration);
  visit("hole_filling", filter.hole_filling);
  visit("prior", filter.prior);
  visit("matcher", filter.matcher);
  visit("ego_motion", filter.ego_motion);
  visit("scorer", filter.scorer);
  visit("gate", filter.gate);
  visit("classifier", filter.classifier);
  visit("memory", filter.memory);
  visit("keep_floor", filter.keep_floor);
  if constexpr (kHasMovers<Policies>) visit("movers", filter.movers);
  visit("mask_prediction", filter.mask_prediction);
}

}  // namespace stillpoint
