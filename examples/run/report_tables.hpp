// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The tables of the report: numbers with their units.

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explanations.hpp"
#include "figures.hpp"
#include "html.hpp"
#include "mover_history.hpp"
#include "options.hpp"
#include "settings.hpp"
#include "words.hpp"

namespace stillpoint_run {

/// A table whose first column names the row; the others are numbers, or text.
class Table {
 public:
  Table(const char* caption, std::initializer_list<const char*> heads, bool holds_numbers = true)
      : cell_(holds_numbers ? "<td class=\"n\">" : "<td>") {
    html_ = "<div class=\"scroll\"><table><caption>" + escaped(caption) + "</caption><thead><tr>";
    bool is_first = true;
    for (const char* head : heads) {
      html_ += std::string(is_first || !holds_numbers ? "<th scope=\"col\">" : "<th scope=\"col\" class=\"n\">") +
               escaped(head) + "</th>";
      is_first = false;
    }
    html_ += "</tr></thead><tbody>";
  }

  /// @param meaning  one sentence that stands below the name
  Table& row(const std::string& name, std::initializer_list<std::string> cells, const std::string& meaning = "") {
    html_ += "<tr><th scope=\"row\">" + escaped(name) +
             (meaning.empty() ? "" : "<small>" + escaped(meaning) + "</small>") + "</th>";
    for (const std::string& cell : cells) html_ += cell_ + escaped(cell) + "</td>";
    html_ += "</tr>";
    return *this;
  }

  std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
  std::string cell_;
};

namespace detail {

inline std::string fixed_or_none(const std::optional<double>& value, int decimals, double factor = 1.0) {
  return value ? stillpoint::format_fixed(factor * *value, decimals) : "n/a";
}

inline std::string count_or_none(const std::optional<std::size_t>& value) {
  return value ? std::to_string(*value) : "n/a";
}

inline std::string trajectory_table(const Figures& figures) {
  Table table("Trajectory", {"", "with the filter", "without"});
  const auto row = [&](const char* name, const char* meaning, int decimals, double factor, auto&& read) {
    table.row(name,
              {fixed_or_none(read(figures.filtered), decimals, factor),
               fixed_or_none(read(figures.unfiltered), decimals, factor)},
              meaning);
  };
  constexpr char kAte[] =
      "absolute trajectory error: distance from the reference after one rigid alignment, poses paired by nearest time "
      "within 10 ms";
  constexpr char kRpe[] = "relative pose error: difference of the motion over this time from the reference's";
  row("ATE, RMSE, cm", kAte, 2, 100, [](const TrajectoryFigures& t) { return t.ate_rmse_m; });
  row("RPE over a frame, RMSE, mm", kRpe, 2, 1000,
      [](const TrajectoryFigures& t) { return t.rpe_frame.translation_m; });
  row("RPE over a frame, RMSE, degrees", "", 3, 1, [](const TrajectoryFigures& t) { return t.rpe_frame.rotation_deg; });
  row("RPE over a second, RMSE, cm", "", 2, 100, [](const TrajectoryFigures& t) { return t.rpe_second.translation_m; });
  row("RPE over a second, RMSE, degrees", "", 3, 1,
      [](const TrajectoryFigures& t) { return t.rpe_second.rotation_deg; });
  table.row(
      "frames without a pose",
      {count_or_none(figures.filtered.frames_without_pose), count_or_none(figures.unfiltered.frames_without_pose)},
      "the tracker was lost");
  table.row("improvement of the ATE, %", {fixed_or_none(figures.improvement_percent, 1), ""});
  table.row("furthest apart, cm", {fixed_or_none(figures.divergence_max_m, 1, 100), ""},
            "of the filtered and the unfiltered trajectory, which start at the same pose");
  return table.html();
}

inline std::string label_table(const RunRecord& run) {
  const stillpoint::FilterScore& score = run.labels;
  Table table("Features by label, all frames after the first", {"", "features", "dropped", "share, %"});
  const auto row = [&table](const char* name, const stillpoint::DropCount& count, const char* meaning) {
    table.row(name,
              {std::to_string(count.features), std::to_string(count.dropped), fixed_or_none(count.share(), 1, 100)},
              meaning);
  };
  row("on moving objects (recall)", score.moving(), "should be dropped: 100 % is right");
  row("on the background (false positives)", score.background(), "should be kept: 0 % is right");
  row("on parked objects (moved before)", score.parked(), "either is right");
  return table.html();
}

inline std::string mover_table(const RunRecord& run, const std::vector<MoverHistory>& movers) {
  Table table("Movers: first and last seen, in how many frames, greatest speed",
              {"", "from, s", "to, s", "frames", "m/s"});
  for (const MoverHistory& mover : movers) {
    std::size_t last = mover.last_frame;
    while (mover.in(last) == nullptr || mover.in(last)->state == stillpoint::MoverState::lost) --last;
    table.row(mover.name(), {stillpoint::format_fixed(run.frames[mover.first_frame].time_s, 2),
                             stillpoint::format_fixed(run.frames[last].time_s, 2), std::to_string(mover.seen_frames),
                             stillpoint::format_fixed(mover.greatest_speed_m_s, 2)});
  }
  return table.html();
}

inline std::string time_table(const Figures& figures) {
  Table table("Time per frame, ms", {"", "median", "p95", "maximum"});
  const auto meaning_of = [](const std::string& name) -> std::string {
    for (std::size_t s = 0; s < stillpoint::kStageCount; ++s)
      if (const auto stage = static_cast<stillpoint::Stage>(s); name == to_string(stage)) return explained(stage);
    return "";
  };
  for (const StageTime& stage : figures.times) {
    const auto value = [&stage](double Spread::*member) {
      return stage.ms ? stillpoint::format_fixed((*stage.ms).*member, 3) : std::string("n/a");
    };
    const std::string name = stage.name == "filter"    ? "filter, all of the above"
                             : stage.name == "extract" ? "beside it: ORB features"
                             : stage.name == "track"   ? "beside it: tracking"
                                                       : stage.name;
    table.row(name, {value(&Spread::median), value(&Spread::p95), value(&Spread::max)}, meaning_of(stage.name));
  }
  return table.html();
}

inline std::string detector_table(const Options& options, const DetectorRecord& detector, const Figures& figures) {
  Table table("Detector", {"", "value"}, false);
  const stillpoint::DetectorCounters& frames = detector.counters;
  table.row("network", {options.prior_name()});
  table.row("layout", {std::string(to_string(detector.layout))});
  table.row("input",
            {std::to_string(detector.input.width) + " x " + std::to_string(detector.input.height) + " pixels"});
  table.row("frames offered", {std::to_string(frames.offered)});
  table.row("not looked at, by --detect-every", {std::to_string(frames.skipped)});
  table.row("replaced by a newer one", {std::to_string(frames.replaced)});
  table.row("answered", {std::to_string(frames.detected)});
  table.row("failed", {std::to_string(frames.failed)});
  if (figures.detection_ms)
    table.row("time of an answer", {stillpoint::format_fixed(figures.detection_ms->median, 1) + " ms; p95 " +
                                    stillpoint::format_fixed(figures.detection_ms->p95, 1) + " ms"});
  if (!detector.last_error.empty()) table.row("last error", {detector.last_error});
  return table.html();
}

inline std::string status_table(const Figures& figures) {
  Table table("Status of the frames", {"status", "frames"});
  for (const auto& [status, frames] : figures.statuses)
    table.row(to_string(status), {std::to_string(frames)}, explained(status));
  for (const auto& [warning, frames] : figures.warnings)
    table.row(std::string("warning: ") + to_string(warning), {std::to_string(frames)}, explained(warning));
  return table.html();
}

inline std::string settings_table(const Options& options) {
  Table table("Settings of this run (stillpoint_run --help explains them)", {"option", "value"}, false);
  for (const auto& [name, value] : settings(options)) table.row(name, {value});
  return table.html();
}

}  // namespace detail

/// All tables, those without content left out.
inline std::string report_tables(const Options& options, const RunRecord& run, const Figures& figures,
                                 const std::vector<MoverHistory>& movers) {
  std::string html;
  if (run.has_backend) html += detail::trajectory_table(figures);
  if (run.has_labels) html += detail::label_table(run);
  if (!movers.empty()) html += detail::mover_table(run, movers);
  if (run.detector) html += detail::detector_table(options, *run.detector, figures);
  return html + detail::time_table(figures) + detail::status_table(figures) + detail::settings_table(options);
}

}  // namespace stillpoint_run
