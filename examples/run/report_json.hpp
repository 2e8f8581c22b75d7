// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// report.json: the figures of a run, for programs. A figure that can't be had is null.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "figures.hpp"
#include "options.hpp"
#include "settings.hpp"
#include "stillpoint/version.hpp"

namespace stillpoint_run {

namespace detail {

template <class Value>
nlohmann::ordered_json or_null(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json relative_error_json(const RelativeError& filtered, const RelativeError& unfiltered) {
  return {{"translation_rmse_m", or_null(filtered.translation_m)},
          {"rotation_rmse_deg", or_null(filtered.rotation_deg)},
          {"translation_rmse_unfiltered_m", or_null(unfiltered.translation_m)},
          {"rotation_rmse_unfiltered_deg", or_null(unfiltered.rotation_deg)}};
}

inline nlohmann::ordered_json labels_json(const RunRecord& run) {
  const stillpoint::FilterScore& score = run.labels;
  const auto count = [&run](std::size_t features) { return run.has_labels ? std::optional(features) : std::nullopt; };
  return {{"recall", or_null(score.recall())},
          {"false_alarms", or_null(score.false_positive_rate())},
          {"moving", or_null(count(score.moving().features))},
          {"background", or_null(count(score.background().features))},
          {"parked_dropped", or_null(score.parked_dropped())},
          {"predicted_mask",
           {{"recall", or_null(run.predicted_mask.recall())},
            {"false_alarms", or_null(run.predicted_mask.false_positive_rate())}}}};
}

/// Frames: offered = skipped + replaced + detected + failed.
inline nlohmann::ordered_json detector_json(const RunRecord& run, const Figures& figures) {
  if (!run.detector) return nullptr;
  const DetectorRecord& detector = *run.detector;
  const auto time = [&figures](double Spread::*member) {
    return or_null(figures.detection_ms ? std::optional((*figures.detection_ms).*member) : std::nullopt);
  };
  return {{"layout", to_string(detector.layout)},
          {"input_width", detector.input.width},
          {"input_height", detector.input.height},
          {"frames",
           {{"offered", detector.counters.offered},
            {"skipped", detector.counters.skipped},
            {"replaced", detector.counters.replaced},
            {"detected", detector.counters.detected},
            {"failed", detector.counters.failed}}},
          {"timing_ms", {{"median", time(&Spread::median)}, {"p95", time(&Spread::p95)}}},
          {"last_error", detector.last_error.empty() ? nlohmann::ordered_json(nullptr)
                                                     : nlohmann::ordered_json(detector.last_error)}};
}

}  // namespace detail

/// @return text with a line's end. Key by key: shares from 0 to 1, units in the keys' names, labels' `moving` and
///         `background` the number of features that the shares are of.
/// @param stages  options of the filter's stages; null where nothing filtered
inline std::string report_json(const Options& options, const RunRecord& run, const Figures& figures,
                               const nlohmann::ordered_json& stages) {
  nlohmann::ordered_json arguments = nlohmann::ordered_json::object();
  for (const auto& [name, value] : settings(options)) arguments[name] = value;
  nlohmann::ordered_json statuses = nlohmann::ordered_json::object();
  for (const auto& [status, frames] : figures.statuses) statuses[to_string(status)] = frames;
  nlohmann::ordered_json warnings = nlohmann::ordered_json::object();
  for (const auto& [warning, frames] : figures.warnings) warnings[to_string(warning)] = frames;
  nlohmann::ordered_json times = nlohmann::ordered_json::object();
  for (const StageTime& stage : figures.times) {
    const auto value = [&stage](double Spread::*member) {
      return detail::or_null(stage.ms ? std::optional((*stage.ms).*member) : std::nullopt);
    };
    times[stage.name] = {
        {"median", value(&Spread::median)}, {"p95", value(&Spread::p95)}, {"max", value(&Spread::max)}};
  }
  const nlohmann::ordered_json report = {
      {"version", STILLPOINT_VERSION},
      {"sequence", run.sequence},
      {"policies", options.policies},
      {"prior", options.prior_name()},
      {"detector", detail::detector_json(run, figures)},
      {"frames", run.frames.size()},
      {"missing_files", run.missing_files},
      {"images_without_depth", run.images_without_depth},
      {"interrupted", run.was_interrupted},
      {"assumptions", run.assumptions},
      {"features_per_frame", detail::or_null(figures.features_per_frame)},
      {"kept_share", detail::or_null(figures.kept_share)},
      {"statuses", statuses},
      {"warnings", warnings},
      {"timing_ms", times},
      {"ate_rmse_m", detail::or_null(figures.filtered.ate_rmse_m)},
      {"ate_rmse_unfiltered_m", detail::or_null(figures.unfiltered.ate_rmse_m)},
      {"frames_without_pose", detail::or_null(figures.filtered.frames_without_pose)},
      {"improvement_percent", detail::or_null(figures.improvement_percent)},
      {"divergence",
       {{"translation_max_m", detail::or_null(figures.divergence_max_m)},
        {"rotation_max_deg", detail::or_null(figures.divergence_max_deg)}}},
      {"rpe",
       {{"frame", detail::relative_error_json(figures.filtered.rpe_frame, figures.unfiltered.rpe_frame)},
        {"second", detail::relative_error_json(figures.filtered.rpe_second, figures.unfiltered.rpe_second)}}},
      {"labels", detail::labels_json(run)},
      {"arguments", arguments},
      {"options", stages}};
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
         '\n';  // folder names may be any bytes
}

}  // namespace stillpoint_run
