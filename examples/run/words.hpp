// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a run found, in plain words: for standard output and the top of the report.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "figures.hpp"
#include "options.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_run {

/// "3.1 cm", "0.8 mm", "1.25 m".
inline std::string length_words(double metres) {
  if (metres < 0.00995) return stillpoint::format_fixed(metres * 1000, 1) + " mm";
  if (metres < 0.995) return stillpoint::format_fixed(metres * 100, metres < 0.0995 ? 1 : 0) + " cm";
  return stillpoint::format_fixed(metres, 2) + " m";
}

/// "21 %", "3.4 %".
inline std::string percent_words(double share) {
  const double percent = 100 * share;
  return stillpoint::format_fixed(percent, percent > 0 && std::abs(percent) < 9.95 ? 1 : 0) + " %";
}

inline std::string count_words(std::size_t count, const char* noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

namespace detail {

inline std::string trajectory_words(const RunRecord& run, const Figures& figures) {
  if (!run.has_backend) return "No tracker ran behind the filter, so there is no trajectory.";
  const auto &with = figures.filtered.ate_rmse_m, &without = figures.unfiltered.ate_rmse_m;
  if (with && without)
    return "With the filter the trajectory is off by " + length_words(*with) + " (ATE), without it by " +
           length_words(*without) + ".";
  if (with) return "With the filter the trajectory is off by " + length_words(*with) + " (ATE).";
  if (without) return "Without the filter the trajectory is off by " + length_words(*without) + " (ATE).";
  const bool is_near_in_time =
      figures.filtered.absolute.alignment.status != stillpoint::AlignmentStatus::too_few_points ||
      figures.unfiltered.absolute.alignment.status != stillpoint::AlignmentStatus::too_few_points;
  const std::string why =
      !run.ground_truth ? "There is no reference"
      : is_near_in_time
          ? "The camera or the tracker stayed at one place or on a line, which fits the reference in many ways"
          : "Fewer than three poses of the reference are within 10 ms of the trajectory's (is its clock "
            "another one?)";
  const std::string unknown = why + ", so the error of the trajectory is not known";
  if (!figures.divergence_max_m) return unknown + ".";
  return unknown + "; with and without the filter it differs by up to " + length_words(*figures.divergence_max_m) + ".";
}

inline std::string label_words(const RunRecord& run) {
  const auto recall = run.labels.recall(), false_positives = run.labels.false_positive_rate();
  if (!recall && !false_positives) return "";
  std::string words;
  if (recall) words += "Of the features on moving objects it dropped " + percent_words(*recall);
  if (false_positives)
    words += (recall ? ", of those on the background " : "Of the features on the background it dropped ") +
             percent_words(*false_positives);
  return words + '.';
}

inline std::string detector_words(const Options& options, const DetectorRecord& detector, const Figures& figures) {
  const stillpoint::DetectorCounters& frames = detector.counters;
  std::string words = options.prior_name() + " (" + std::string(to_string(detector.layout)) + ", " +
                      std::to_string(detector.input.width) + " x " + std::to_string(detector.input.height) +
                      ") answered on " + std::to_string(frames.detected) + " of " +
                      count_words(frames.offered, "frame");
  if (figures.detection_ms)
    words += ", in " + stillpoint::format_fixed(figures.detection_ms->median, 0) + " ms (p95 " +
             stillpoint::format_fixed(figures.detection_ms->p95, 0) + " ms)";
  if (frames.replaced > 0) words += "; it skipped " + count_words(frames.replaced, "frame") + " while it was busy";
  if (frames.failed > 0)
    words += "; it failed on " + count_words(frames.failed, "frame") + ", the last time with: " + detector.last_error;
  return words + '.';
}

/// What is probably wrong with the input, as a twentieth of the frames says at least; else empty.
inline std::string commonest_hint(const RunRecord& run) {
  std::map<std::string, std::size_t> frames;
  for (const FrameSummary& frame : run.frames)
    if (*frame.hint != '\0') ++frames[frame.hint];
  const auto commonest =
      std::max_element(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const bool is_common = commonest != frames.end() && 20 * commonest->second >= run.frames.size();
  return is_common ? commonest->first : std::string();
}

inline std::size_t unjudged_frames(const RunRecord& run) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    count += i > 0 && !stillpoint::judged(run.frames[i].status) ? 1 : 0;
  return count;
}

}  // namespace detail

/// One sentence a fact, the most important first.
inline std::vector<std::string> sentences(const Options& options, const RunRecord& run, const Figures& figures) {
  std::vector<std::string> result;
  const std::size_t dropped = figures.features - figures.kept;
  const bool is_oracle = options.prior == "labels";
  std::string first =
      (is_oracle ? "Looked up " : "Filtered ") + count_words(run.frames.size(), "frame") + " of " + run.sequence + "; ";
  if (figures.features == 0)
    first += "no feature was found in them.";
  else
    first += dropped == 0 ? "no feature was dropped."
                          : percent_words(static_cast<double>(dropped) / static_cast<double>(figures.features)) +
                                " of the features were dropped" + (is_oracle ? ", as the labels say." : ".");
  result.push_back(first);
  result.push_back(detail::trajectory_words(run, figures));
  for (const std::string& assumption : run.assumptions) result.push_back(assumption);
  if (run.missing_files > 0)
    result.push_back(count_words(run.missing_files, "image") + " that the sequence's lists name " +
                     (run.missing_files == 1 ? "is" : "are") + " missing: the frames were left out.");
  if (run.images_without_depth > 0)
    result.push_back(count_words(run.images_without_depth, "image") +
                     (run.images_without_depth == 1 ? " has no depth of its time and was left out."
                                                    : " have no depth of their time and were left out."));
  if (run.was_interrupted) result.push_back("The run was interrupted: later frames were not filtered.");
  const std::string labels = detail::label_words(run);
  if (!labels.empty()) result.push_back(labels);
  if (run.detector) result.push_back(detail::detector_words(options, *run.detector, figures));
  if (options.policies == "paper" && options.prior == "none")
    result.push_back(
        "The paper's method tests features inside boxes of moving classes only: without --prior boxes or "
        "a network it drops nothing.");
  if (options.policies == "monocular")
    result.push_back(
        "Without depth nothing is in metres, and objects that move along their epipolar lines are found inside boxes "
        "only: --prior boxes or a network helps.");
  if (const std::size_t unjudged = detail::unjudged_frames(run); unjudged > 0)
    result.push_back(count_words(unjudged, "frame") + " after the first could not be judged, and all features of " +
                     (unjudged == 1 ? "it" : "them") + " were kept" +
                     (run.has_depth || options.policies == "monocular"
                          ? "."
                          : ": they have no depth, which --policies " + options.policies + " needs."));
  if (const std::string hint = detail::commonest_hint(run); !hint.empty()) result.push_back("Hint: " + hint);
  if (figures.filtered.frames_without_pose.value_or(0) > 0)
    result.push_back(count_words(*figures.filtered.frames_without_pose, "frame") + " got no pose with the filter, " +
                     std::to_string(figures.unfiltered.frames_without_pose.value_or(0)) + " without it.");
  return result;
}

}  // namespace stillpoint_run
