// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// report.html: one file that needs no network and no script. What happened first, then plots, frames, tables.

#include <cstddef>
#include <string>
#include <vector>

#include "figures.hpp"
#include "html.hpp"
#include "options.hpp"
#include "overlay.hpp"
#include "report_plots.hpp"
#include "report_style.hpp"
#include "report_tables.hpp"
#include "stillpoint/version.hpp"
#include "words.hpp"

namespace stillpoint_run {

namespace detail {

inline std::string tile(const std::string& name, const std::string& value, const std::string& note) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "<small>" + escaped(note) + "</small></dd></div>";
}

/// The handful of figures that one looks for first; those that can't be had have no tile.
inline std::string tiles(const RunRecord& run, const Figures& figures) {
  std::string html;
  const auto &with = figures.filtered.ate_rmse_m, &without = figures.unfiltered.ate_rmse_m;
  if (with)
    html += tile("trajectory error, filtered", length_words(*with),
                 without ? "unfiltered " + length_words(*without) : "ATE, RMSE");
  if (figures.improvement_percent)
    html += tile("improvement", stillpoint::format_fixed(*figures.improvement_percent, 0) + " %", "of the ATE");
  if (const auto recall = run.labels.recall())
    html +=
        tile("moving features dropped", percent_words(*recall), "of " + std::to_string(run.labels.moving().features));
  if (const auto alarms = run.labels.false_alarms())
    html += tile("background dropped", percent_words(*alarms),
                 "of " + std::to_string(run.labels.background().features) + " features");
  if (figures.kept_share)
    html += tile("features kept", percent_words(*figures.kept_share),
                 "of " + stillpoint::format_fixed(*figures.features_per_frame, 0) + " a frame");
  for (const StageTime& stage : figures.times)
    if (stage.name == "filter" && stage.ms)
      html += tile("filter's time per frame", stillpoint::format_fixed(stage.ms->median, 1) + " ms",
                   "median; 95 % below " + stillpoint::format_fixed(stage.ms->p95, 1) + " ms");
  return html.empty() ? "" : "<dl class=\"tiles\">" + html + "</dl>\n";
}

inline std::string frames_section(const std::vector<Overlay>& overlays) {
  if (overlays.empty()) return "";
  const auto entry = [](const char* picture, const char* name) {
    return std::string("<li><svg viewBox=\"0 0 30 14\" aria-hidden=\"true\">") + picture + "</svg>" + name + "</li>";
  };
  std::string html =
      "<section><h2>Frames</h2><ul class=\"legend\">" +
      entry("<circle class=\"shape kept\" cx=\"15\" cy=\"7\" r=\"4.5\"/>", "kept: stands still") +
      entry("<path class=\"shape dynamic\" d=\"M10 2l10 10m0-10L10 12\"/>", "dynamic: dropped") +
      entry("<path class=\"shape unknown\" d=\"M11 3h8v8h-8Z\"/>", "unknown, kept") +
      entry("<path class=\"shape unknown\" d=\"M11 3h8v8h-8ZM7 7h16\"/>", "unknown, dropped") +
      entry("<path class=\"shape box\" d=\"M3 1h24v12H3Z\"/>", "box of the prior, seen in this frame") +
      entry("<path class=\"shape box\" stroke-dasharray=\"5 3\" d=\"M3 1h24v12H3Z\"/>", "carried from an earlier one") +
      entry("<path class=\"shape kept\" d=\"M3 11L27 3\"/>", "offset from where it would be if it stood, × 3") +
      "</ul><div class=\"frames\">\n";
  for (const Overlay& overlay : overlays)
    html += "<figure><img loading=\"lazy\" alt=\"Camera image with the verdict of each feature drawn on it. " +
            escaped(overlay.caption) + "\" src=\"data:image/jpeg;base64," + base64(overlay.jpeg) + "\"><figcaption>" +
            escaped(overlay.caption) + "</figcaption></figure>\n";
  return html + "</div></section>\n";
}

}  // namespace detail

/// The whole page.
inline std::string report_html(const Options& options, const RunRecord& run, const Figures& figures,
                               const std::vector<Overlay>& overlays) {
  const std::string title = "stillpoint: " + run.sequence;
  const std::vector<std::string> found = sentences(options, run, figures);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>" +
      escaped(title) + "</title><style>" + kReportStyle + "</style></head>\n<body><main>\n<h1>" + escaped(title) +
      "</h1>\n<p class=\"lead\">" + escaped(found[0]) + ' ' + escaped(found[1]) + "</p>\n";
  for (std::size_t i = 2; i < found.size(); ++i) html += "<p class=\"more\">" + escaped(found[i]) + "</p>\n";
  html += detail::tiles(run, figures) + "<section><h2>Over the run</h2><div class=\"plots\">\n";
  for (const Plot& plot : report_plots(run, figures)) html += figure_of(plot);
  html += "</div></section>\n" + detail::frames_section(overlays) +
          "<section><h2>Numbers</h2><div class=\"tables\">\n" + report_tables(options, run, figures) +
          "</div></section>\n";
  if (run.has_backend && run.ground_truth)
    html +=
        "<p class=\"more\">ATE: distance from the reference after alignment (rotation and translation), poses paired "
        "by nearest time within 10 ms. RPE: difference of the motion over a frame or a second.</p>\n";
  return html + "<footer>stillpoint_run " STILLPOINT_VERSION "</footer>\n</main></body></html>\n";
}

}  // namespace stillpoint_run
