// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The numbers of a run: counts, times, trajectory errors, recall and false positives.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detector_record.hpp"
#include "frame_record.hpp"
#include "map_files.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/evaluation/trajectory_error.hpp"

namespace stillpoint_run {

/// What a run leaves behind, as far as it fits into memory.
struct RunRecord {
  std::string sequence;
  std::vector<FrameSummary> frames;
  std::vector<MoverInFrame> movers;  ///< of all frames, in their order
  bool has_backend = false, has_stages = false, has_labels = false, has_depth = true;
  bool was_interrupted = false;
  std::size_t missing_files = 0;                ///< that the sequence's lists name
  std::size_t images_without_depth = 0;         ///< of its time: they are no frames
  std::vector<std::string> assumptions;         ///< of the source, where nobody told it
  stillpoint::Trajectory filtered, unfiltered;  ///< world: the camera in the first frame; as a map has them in the end
  stillpoint::Trajectory live;                  ///< the filtered one, as it was known at the time
  std::optional<MapFiles> map;                  ///< of a tracker that has one: it adjusts poses later
  std::optional<stillpoint::Trajectory> ground_truth;
  std::optional<DetectorRecord> detector;  ///< empty where no network ran
  stillpoint::FilterScore labels;
  stillpoint::FilterScore predicted_mask;  ///< the same features, dropped by the mask that was predicted of their frame
};

struct Spread {
  double median = 0.0, p95 = 0.0, max = 0.0;
};

/// Median, 95th percentile (the smallest value that 95 % do not exceed) and maximum; empty of nothing.
inline std::optional<Spread> spread_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const double median = stillpoint::error_statistics(values).median;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  return Spread{median, values[rank - 1], values.back()};
}

/// Root mean square of the relative error over a delta; empty where the trajectory is too short.
struct RelativeError {
  std::optional<double> translation_m, rotation_deg;
};

struct TrajectoryFigures {
  std::optional<std::size_t> frames_without_pose;  ///< empty without a backend
  std::optional<double> ate_rmse_m;
  RelativeError rpe_frame, rpe_second;  ///< over one frame and over one second
  stillpoint::AbsoluteTrajectoryError absolute;
  stillpoint::Similarity reference_from_estimate;  ///< as it is drawn
  stillpoint::TrajectoryErrors drift;              ///< of the poses as they are drawn
};

struct StageTime {
  std::string name;
  std::optional<Spread> ms;
};

struct Figures {
  std::size_t features = 0, kept = 0;
  std::vector<std::pair<stillpoint::Status, std::size_t>> statuses;   ///< those that occurred, in the order of the enum
  std::vector<std::pair<stillpoint::Warning, std::size_t>> warnings;  ///< likewise
  std::vector<StageTime> times;
  std::optional<Spread> detection_ms;  ///< of a network
  std::optional<double> features_per_frame, kept_share, improvement_percent;
  TrajectoryFigures filtered, unfiltered;
  stillpoint::TrajectoryErrors divergence;  ///< of the unfiltered trajectory from the filtered one, laid on its start
  std::optional<double> divergence_max_m, divergence_max_deg;

  /// Whether a trajectory could be laid on a reference.
  bool has_errors() const noexcept { return filtered.ate_rmse_m || unfiltered.ate_rmse_m; }
};

namespace detail {

inline std::optional<double> rmse(const std::vector<double>& errors) {
  const stillpoint::ErrorStatistics statistics = stillpoint::error_statistics(errors);
  return std::isfinite(statistics.rmse) ? std::optional(statistics.rmse) : std::nullopt;
}

inline RelativeError relative_error(const RunRecord& run, const stillpoint::Trajectory& estimate, double delta_frames,
                                    stillpoint::PairSelection pairs) {
  stillpoint::RelativeErrorOptions options;
  options.delta = delta_frames;
  options.pairs = pairs;
  const stillpoint::TrajectoryErrors errors =
      stillpoint::relative_trajectory_error(*run.ground_truth, estimate, options);
  return {rmse(errors.translation_m), rmse(errors.rotation_deg)};
}

/// How many frames make a second, at least one; by the median time between frames.
inline double frames_per_second(const std::vector<FrameSummary>& frames) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < frames.size(); ++i) steps_s.push_back(frames[i].timestamp_s - frames[i - 1].timestamp_s);
  if (steps_s.empty()) return 1.0;
  return std::max(1.0, std::round(1.0 / stillpoint::error_statistics(steps_s).median));
}

inline TrajectoryFigures trajectory_figures(const RunRecord& run, const stillpoint::Trajectory& estimate) {
  TrajectoryFigures figures;
  if (!run.has_backend) return figures;
  figures.frames_without_pose = run.frames.size() - estimate.size();
  if (!run.ground_truth) return figures;
  figures.absolute = stillpoint::absolute_trajectory_error(*run.ground_truth, estimate, stillpoint::Alignment::se3);
  figures.ate_rmse_m = rmse(figures.absolute.errors.translation_m);
  figures.rpe_frame = relative_error(run, estimate, 1.0, stillpoint::PairSelection::consecutive);
  figures.rpe_second = relative_error(run, estimate, frames_per_second(run.frames), stillpoint::PairSelection::all);
  return figures;
}

inline void append_difference(stillpoint::TrajectoryErrors& errors, double timestamp_s,
                              const stillpoint::Pose& difference) {
  errors.timestamps_s.push_back(timestamp_s);
  errors.translation_m.push_back(difference.translation().norm());
  errors.rotation_deg.push_back(stillpoint::kDegreesPerRadian * stillpoint::rotation_angle(difference.linear()));
}

/// Lays both trajectories on the reference by the alignment of the better one: they start at the same pose, so that
/// what the other has drifted shows as it is. (Its own alignment would turn its start away to spread the error evenly.)
inline void lay_on_reference(const RunRecord& run, Figures& figures) {
  TrajectoryFigures &with = figures.filtered, &without = figures.unfiltered;
  const bool start_together = !run.filtered.empty() && !run.unfiltered.empty() &&
                              run.filtered.front().timestamp_s == run.unfiltered.front().timestamp_s;
  const auto own = [](TrajectoryFigures& of) { return of.absolute.alignment.target_from_source; };
  if (with.ate_rmse_m) with.reference_from_estimate = own(with);
  if (without.ate_rmse_m) without.reference_from_estimate = own(without);
  if (start_together && with.ate_rmse_m && without.ate_rmse_m)
    (*with.ate_rmse_m <= *without.ate_rmse_m ? without : with).reference_from_estimate =
        (*with.ate_rmse_m <= *without.ate_rmse_m ? with : without).reference_from_estimate;
  const auto drift = [&run](const stillpoint::Trajectory& estimate, TrajectoryFigures& of) {
    if (!of.ate_rmse_m) return;
    const stillpoint::AssociatedTrajectories pairs = stillpoint::associate(*run.ground_truth, estimate, 0.01);
    const stillpoint::Trajectory laid = stillpoint::transformed(of.reference_from_estimate, pairs.estimate);
    for (std::size_t i = 0; i < laid.size(); ++i)
      append_difference(of.drift, laid[i].timestamp_s,
                        pairs.reference[i].world_from_camera.inverse() * laid[i].world_from_camera);
  };
  drift(run.filtered, with);
  drift(run.unfiltered, without);
}

/// How far the two trajectories part, at the moments that both have a pose of: from the first of them on, since one may
/// begin later than the other, at an origin of its own.
inline stillpoint::TrajectoryErrors divergence(const stillpoint::Trajectory& filtered,
                                               const stillpoint::Trajectory& unfiltered) {
  stillpoint::TrajectoryErrors errors;
  std::optional<stillpoint::Pose> filtered_from_unfiltered;  // worlds
  std::size_t k = 0;
  for (const auto& pose : filtered) {
    while (k < unfiltered.size() && unfiltered[k].timestamp_s < pose.timestamp_s) ++k;
    if (k == unfiltered.size()) break;
    if (unfiltered[k].timestamp_s != pose.timestamp_s) continue;
    const stillpoint::Pose& other = unfiltered[k].world_from_camera;
    if (!filtered_from_unfiltered) filtered_from_unfiltered = pose.world_from_camera * other.inverse();
    append_difference(errors, pose.timestamp_s, pose.world_from_camera.inverse() * *filtered_from_unfiltered * other);
  }
  return errors;
}

inline std::optional<double> greatest(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(*std::max_element(values.begin(), values.end()));
}

/// Times are those of frames that were judged: on the others the stages did not run.
inline std::vector<StageTime> stage_times(const RunRecord& run) {
  const auto spread = [&run](bool judged_only, auto&& read) {
    std::vector<double> values;
    for (const FrameSummary& frame : run.frames)
      if (!judged_only || (run.has_stages && stillpoint::judged(frame.status))) values.push_back(read(frame));
    return spread_of(std::move(values));
  };
  std::vector<StageTime> times;
  for (std::size_t s = 0; s < stillpoint::kStageCount; ++s) {
    const auto stage = static_cast<stillpoint::Stage>(s);
    times.push_back({to_string(stage), spread(true, [stage](const FrameSummary& f) { return f.timings[stage]; })});
  }
  times.push_back({"filter", spread(true, [](const FrameSummary& f) { return f.timings.total_ms(); })});
  times.push_back({"extract", spread(false, [](const FrameSummary& f) { return f.extract_ms; })});
  if (run.has_backend) times.push_back({"track", spread(false, [](const FrameSummary& f) { return f.track_ms; })});
  return times;
}

}  // namespace detail

/// Computes all figures of a run.
inline Figures evaluate(const RunRecord& run) {
  Figures figures;
  for (std::size_t s = 0; s < stillpoint::kStatusCount; ++s) {
    const auto status = static_cast<stillpoint::Status>(s);
    const auto count = std::count_if(run.frames.begin(), run.frames.end(),
                                     [status](const FrameSummary& frame) { return frame.status == status; });
    if (count > 0) figures.statuses.emplace_back(status, static_cast<std::size_t>(count));
  }
  for (std::size_t w = 0; w < stillpoint::kWarningCount; ++w) {
    const auto warning = static_cast<stillpoint::Warning>(w);
    const auto count = std::count_if(run.frames.begin(), run.frames.end(),
                                     [warning](const FrameSummary& frame) { return frame.warnings.has(warning); });
    if (count > 0) figures.warnings.emplace_back(warning, static_cast<std::size_t>(count));
  }
  for (const FrameSummary& frame : run.frames) {
    figures.features += frame.features;
    figures.kept += frame.kept;
  }
  if (!run.frames.empty())
    figures.features_per_frame = static_cast<double>(figures.features) / static_cast<double>(run.frames.size());
  if (figures.features > 0)
    figures.kept_share = static_cast<double>(figures.kept) / static_cast<double>(figures.features);
  figures.times = detail::stage_times(run);
  if (run.detector) figures.detection_ms = spread_of(run.detector->times_ms);
  figures.filtered = detail::trajectory_figures(run, run.filtered);
  figures.unfiltered = detail::trajectory_figures(run, run.unfiltered);
  detail::lay_on_reference(run, figures);
  figures.divergence = detail::divergence(run.filtered, run.unfiltered);
  figures.divergence_max_m = detail::greatest(figures.divergence.translation_m);
  figures.divergence_max_deg = detail::greatest(figures.divergence.rotation_deg);
  if (figures.filtered.ate_rmse_m && figures.unfiltered.ate_rmse_m)
    figures.improvement_percent =
        stillpoint::improvement_percent(*figures.unfiltered.ate_rmse_m, *figures.filtered.ate_rmse_m);
  return figures;
}

}  // namespace stillpoint_run
