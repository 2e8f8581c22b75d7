// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The frames of a run that are worth a look: by status, warning, score, share kept and error.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "run_paths.hpp"
#include "words.hpp"

namespace stillpoint_run {

struct Moment {
  std::size_t frame = 0;  ///< of the run, from 0
  std::vector<std::string> reasons;
};

namespace detail {

/// A value per frame, where there is one.
using FrameValues = std::vector<std::optional<double>>;

inline FrameValues values_of_frames(const RunRecord& run, const stillpoint::TrajectoryErrors& errors,
                                    const std::vector<double>& values) {
  FrameValues result;
  for (const auto& pose : pose_of_frame(run.frames, errors.timestamps_s))
    result.push_back(pose ? std::optional(values[*pose]) : std::nullopt);
  return result;
}

template <class Read>
FrameValues values_of_frames(const RunRecord& run, Read&& read) {
  FrameValues result;
  for (const FrameSummary& frame : run.frames) result.push_back(read(frame));
  return result;
}

/// The first frame with the greatest value above `least`.
inline std::optional<std::size_t> frame_of_greatest(const FrameValues& values, double least) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] && *values[i] > least && (!found || *values[i] > *values[*found])) found = i;
  return found;
}

}  // namespace detail

/// In the order of time; a frame with several reasons is one moment.
inline std::vector<Moment> moments(const RunRecord& run, const Figures& figures) {
  std::map<std::size_t, Moment> found;
  const auto add = [&found](std::size_t frame, std::string reason) {
    found[frame].frame = frame;
    found[frame].reasons.push_back(std::move(reason));
  };
  const auto add_greatest = [&](const detail::FrameValues& values, double least, auto&& words) {
    if (const auto frame = detail::frame_of_greatest(values, least)) add(*frame, words(*values[*frame]));
  };
  const auto add_first = [&](const std::string& name, std::size_t frames, auto&& has_it) {
    const auto first = std::find_if(run.frames.begin(), run.frames.end(), has_it);
    add(static_cast<std::size_t>(first - run.frames.begin()),
        "first of " + count_words(frames, "frame") + " with " + name);
  };

  for (const auto& [status, frames] : figures.statuses)
    if (status != stillpoint::Status::ok && status != stillpoint::Status::first_frame)
      add_first(std::string("status ") + to_string(status), frames,
                [wanted = status](const FrameSummary& frame) { return frame.status == wanted; });
  for (const auto& [warning, frames] : figures.warnings)
    add_first(std::string("warning ") + to_string(warning), frames,
              [wanted = warning](const FrameSummary& frame) { return frame.warnings.has(wanted); });

  const auto add_error = [&](const stillpoint::TrajectoryErrors& errors, const std::string& name) {
    constexpr double kLeast_m = 1e-4;  // less is no error
    add_greatest(detail::values_of_frames(run, errors, errors.translation_m), kLeast_m,
                 [&name](double metres) { return name + ": " + length_words(metres); });
  };
  add_error(figures.filtered.drift, "greatest error with the filter");
  add_error(figures.unfiltered.drift, "greatest error without the filter");
  if (!figures.has_errors()) add_error(figures.divergence, "the trajectories are furthest apart");

  const auto share_dropped = [](const FrameSummary& frame) -> std::optional<double> {
    if (frame.features == 0) return std::nullopt;
    return static_cast<double>(frame.features - frame.kept) / static_cast<double>(frame.features);
  };
  add_greatest(detail::values_of_frames(run, share_dropped), 0.0,
               [](double share) { return "most features dropped: " + percent_words(share); });
  constexpr double kAny = std::numeric_limits<double>::lowest();
  add_greatest(detail::values_of_frames(run, [](const FrameSummary& frame) { return frame.kept_score; }), kAny,
               [](double score) {
                 return "kept features agree least with the camera's motion: median score " +
                        stillpoint::format_fixed(score, 2);
               });
  add_greatest(detail::values_of_frames(run,
                                        [](const FrameSummary& frame) -> std::optional<double> {
                                          const auto share = frame.moving.share();
                                          return share && stillpoint::judged(frame.status) ? std::optional(1 - *share)
                                                                                           : std::nullopt;
                                        }),
               0.0, [](double share) { return "most features on movers kept: " + percent_words(share); });
  add_greatest(detail::values_of_frames(run, [](const FrameSummary& frame) { return frame.background.share(); }), 0.0,
               [](double share) { return "most of the background dropped: " + percent_words(share); });

  std::vector<Moment> result;
  for (auto& [frame, moment] : found) result.push_back(std::move(moment));
  return result;
}

}  // namespace stillpoint_run
