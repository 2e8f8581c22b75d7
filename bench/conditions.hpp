// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The conditions that the filter must hold under, and one run of the filter and of a tracker under one of them.

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy_sequence.hpp"
#include "backends/odometry.hpp"
#include "backends/oracle_filter.hpp"
#include "degradations.hpp"
#include "depth_degradations.hpp"
#include "stillpoint/evaluation/trajectory_error.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/null_filter.hpp"
#include "stillpoint/policies.hpp"
#include "tally.hpp"

namespace stillpoint::bench {

/// What is done to a recording before the filter sees it.
struct Condition {
  std::string name;
  std::size_t every = 1;                      ///< one frame of so many; a phase is the first that is read
  double missing_probability = 0;             ///< of each frame after the second
  Camera (*camera)(const Camera&) = nullptr;  ///< where it is not the recording's
  /// @param camera of the recording
  std::function<Degradation(const Camera& camera, std::uint64_t seed)> degrade;

  /// Runs whose mean is the figure: one a phase and seed.
  std::size_t runs(std::size_t seeds) const noexcept { return every * seeds; }

  /// The frame with which a run begins. Those of one phase begin one after the other: what a tracker does with a single
  /// frame, by chance, decides its error, and without that the runs of what has no random numbers would all be the
  /// same.
  std::size_t first_frame(std::size_t run) const noexcept {
    constexpr std::size_t kLater = 3;
    const std::size_t phase = run % every, seed = run / every;
    return phase + std::max(every, kLater) * seed;
  }
};

/// All conditions, `recorded` (nothing is done) first.
inline std::vector<Condition> conditions() {
  using Make = std::function<Degradation(const Camera&, std::uint64_t)>;
  const auto random = [](Degradation (*make)(std::uint64_t)) {
    return Make([make](const Camera&, std::uint64_t seed) { return make(seed); });
  };
  const auto fixed = [](Degradation (*make)()) {
    return Make([make](const Camera&, std::uint64_t) { return make(); });
  };
  const Make none = [](const Camera&, std::uint64_t) { return [](RawFrame&) {}; };
  const Make projector = [](const Camera& camera, std::uint64_t) { return shadow(camera.fx()); };
  return {
      {"recorded", 1, 0, nullptr, none},
      {"every3", 3, 0, nullptr, none},
      {"every6", 6, 0, nullptr, none},
      {"holes", 1, 0, nullptr, random(holes)},
      {"occlude", 1, 0, nullptr, fixed(occlude)},
      {"flicker", 1, 0, nullptr, random(flicker)},
      {"dark", 1, 0, nullptr, random(dark)},
      {"blur", 1, 0, nullptr, fixed(blur)},
      {"noise", 1, 0, nullptr, random(noise)},
      {"haze", 1, 0, nullptr, fixed(haze)},
      {"half", 1, 0, half_sized, fixed(half)},
      {"late_depth", 1, 0, nullptr, fixed(late_depth)},
      {"shifted_depth", 1, 0, nullptr, fixed(shifted_depth)},
      {"focal", 1, 0, wrong_focal, none},
      {"drop", 1, 0.2, nullptr, none},
      {"shadow", 1, 0, nullptr, projector},
      {"flying", 1, 0, nullptr, random(flying)},
      {"filled", 1, 0, nullptr, fixed(filled)},
      {"fattened", 1, 0, nullptr, fixed(fattened)},
      {"smoothed", 1, 0, nullptr, fixed(smoothed)},
      {"double", 1, 0, double_sized, fixed(doubled)},
      {"bumper", 1, 0, nullptr, fixed(bumper)},
  };
}

/// The frames of a recording under a condition, with ORB's keypoints.
/// @param run  which phase, and which seed of what is random
/// @throws Error where a file can't be read
inline LabelledSequence degraded_sequence(const std::filesystem::path& folder, const Condition& condition,
                                          std::size_t run, std::size_t most_frames) {
  const TumSequence source(folder);
  LabelledSequence sequence{condition.camera ? condition.camera(source.camera()) : source.camera(), {}};
  const Degradation degrade = condition.degrade(source.camera(), 1000 + run);
  Random random(2000 + run);
  const std::size_t count = std::min(source.frames().size(), most_frames);
  for (std::size_t i = condition.first_frame(run); i < count; i += condition.every) {
    const bool is_missing = random.uniform() < condition.missing_probability;
    if (sequence.frames.size() >= 2 && is_missing) continue;
    const RgbdImages images = source.load(i);
    RawFrame raw{images.colour, images.depth, source.has_labels() ? source.load_labels(i) : cv::Mat(),
                 source.depth_factor(), i};
    degrade(raw);
    LabelledFrame frame;
    cv::cvtColor(raw.colour, frame.gray, cv::COLOR_BGR2GRAY);
    frame.depth = raw.depth;
    frame.labels = raw.labels;
    frame.depth_factor = raw.depth_factor;
    frame.timestamp_s = source.frames()[i].timestamp_s;
    frame.world_from_camera = reference_pose(source, frame.timestamp_s);
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

/// Boxes of the folder's boxes.txt, as a perfect detector's, for images of the recording's size or `scale` times it.
inline void add_boxes(const std::filesystem::path& folder, double scale, LabelledSequence& sequence) {
  const std::vector<FrameBoxes> boxes = read_boxes(folder / "boxes.txt");
  for (LabelledFrame& frame : sequence.frames)
    frame.detections = detections_at(boxes, frame.timestamp_s, static_cast<float>(scale));
}

/// Root mean square of the absolute trajectory error against the sequence's own reference, metres.
inline std::optional<double> ate_rmse_m(const LabelledSequence& sequence, const Trajectory& estimate) {
  Trajectory reference;
  for (const LabelledFrame& frame : sequence.frames)
    if (frame.world_from_camera) reference.push_back({frame.timestamp_s, *frame.world_from_camera});
  if (reference.empty() || estimate.empty()) return std::nullopt;
  const AbsoluteTrajectoryError error = absolute_trajectory_error(reference, estimate, Alignment::se3);
  const double rmse = error_statistics(error.errors.translation_m).rmse;
  return std::isfinite(rmse) ? std::optional(rmse) : std::nullopt;
}

namespace detail {

inline void give_truth(examples::OracleFilter& filter, const LabelledFrame& frame) {
  filter.labels = image_traits<cv::Mat>::view(frame.labels);
}
inline void give_truth(NullFilter&, const LabelledFrame&) {}
template <class Policies>
void give_truth(FrameFilter<Policies>& filter, const LabelledFrame& frame) {
  filter.prior.detections = frame.detections;
}

}  // namespace detail

/// Runs the odometry of examples/ behind a filter.
/// @param observe  called as observe(frame, keypoints, result) for every frame, before the tracker
/// @return poses of the frames that have one
template <class Filter, class Observe>
Trajectory run_odometry(const LabelledSequence& sequence, Filter filter, Observe&& observe) {
  FilteredTracker tracker(std::move(filter), examples::RgbdOdometry(sequence.camera));
  tracker.tells_filter = false;
  Trajectory trajectory;
  for (const LabelledFrame& frame : sequence.frames) {
    detail::give_truth(tracker.filter, frame);
    const auto pose = tracker.track(
        frame.view(), [&](const auto& keypoints, const auto& result) { observe(frame, keypoints, result); });
    if (pose) trajectory.push_back({frame.timestamp_s, *pose});
  }
  return trajectory;
}

/// The figures of one run.
struct ConditionOutcome {
  Outcome filter;
  std::optional<double> ate_filtered_m;
};

/// The filter over a sequence, and, if asked for, the odometry behind it.
template <class Policies>
ConditionOutcome run_filter(const LabelledSequence& sequence, FrameFilter<Policies> filter, bool with_tracker) {
  Tally tally;
  const LabelledFrame* last = nullptr;
  const auto observe = [&](const LabelledFrame& frame, const auto& keypoints, const FrameResult& result) {
    LabelledFrame judged = frame;  // headers alone: images are shared
    judged.keypoints.assign(keypoints.begin(), keypoints.end());
    const Motion& motion = result.motion();
    tally.add(judged, last, result.keep(),
              motion.usable() ? std::optional(motion.current_from_reference) : std::nullopt);
    last = &frame;
  };
  ConditionOutcome outcome;
  if (with_tracker) {
    outcome.ate_filtered_m = ate_rmse_m(sequence, run_odometry(sequence, std::move(filter), observe));
  } else {
    const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
    std::vector<cv::KeyPoint> keypoints;
    for (const LabelledFrame& frame : sequence.frames) {
      detail::give_truth(filter, frame);
      orb->detect(frame.gray, keypoints);
      observe(frame, keypoints, filter.filter_frame(frame.view(), keypoints));
    }
  }
  outcome.filter = tally.outcome();
  return outcome;
}

}  // namespace stillpoint::bench
