// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "report_html.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "html.hpp"
#include "moments.hpp"
#include "mover_history.hpp"
#include "page/page.hpp"
#include "report_data.hpp"
#include "report_plots.hpp"
#include "report_tables.hpp"
#include "run_paths.hpp"
#include "stillpoint/version.hpp"
#include "words.hpp"

namespace stillpoint_run {
namespace {

std::string tile(const std::string& name, const std::string& value, const std::string& note) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "<small>" + escaped(note) + "</small></dd></div>";
}

/// The handful of figures that one looks for first; those that can't be had have no tile.
std::string tiles(const RunRecord& run, const Figures& figures) {
  std::string html;
  const auto &with = figures.filtered.ate_rmse_m, &without = figures.unfiltered.ate_rmse_m;
  if (with)
    html += tile("trajectory error, filtered", length_words(*with),
                 (without ? "unfiltered " + length_words(*without) + "; " : "") + "ATE, RMSE");
  if (figures.improvement_percent)
    html += tile("improvement", stillpoint::format_fixed(*figures.improvement_percent, 0) + " %", "of the ATE");
  if (!figures.has_errors() && figures.divergence_max_m)
    html += tile("filtered and unfiltered differ by", length_words(*figures.divergence_max_m),
                 run.ground_truth ? "at most; the reference does not fit" : "at most; no reference");
  if (const auto recall = run.labels.recall())
    html += tile("moving features dropped", percent_words(*recall),
                 "recall, of " + std::to_string(run.labels.moving().features) + " features");
  if (const auto dropped = run.labels.false_positive_rate())
    html += tile("background dropped", percent_words(*dropped),
                 "false positives, of " + std::to_string(run.labels.background().features) + " features");
  if (figures.kept_share)
    html += tile("features kept", percent_words(*figures.kept_share),
                 "of " + stillpoint::format_fixed(*figures.features_per_frame, 0) + " per frame");
  for (const StageTime& stage : figures.times)
    if (stage.name == "filter" && stage.ms)
      html += tile("filter's time per frame", stillpoint::format_fixed(stage.ms->median, 1) + " ms",
                   "median; p95: " + stillpoint::format_fixed(stage.ms->p95, 1) + " ms");
  return html.empty() ? "" : "<dl class=\"tiles\">" + html + "</dl>\n";
}

std::string legend(bool has_movers) {
  const auto entry = [](const char* picture, const char* name) {
    return std::string("<li><svg viewBox=\"0 0 30 14\" aria-hidden=\"true\">") + picture + "</svg>" + name + "</li>";
  };
  return "<ul class=\"legend\">" +
         entry("<circle class=\"shape kept\" cx=\"15\" cy=\"7\" r=\"4.5\"/>", "kept: static") +
         entry("<path class=\"shape dynamic\" d=\"M10 2l10 10m0-10L10 12\"/>", "dynamic: dropped") +
         entry("<path class=\"shape unknown\" d=\"M11 3h8v8h-8Z\"/>", "unknown, kept") +
         entry("<path class=\"shape unknown\" d=\"M11 3h8v8h-8ZM7 7h16\"/>", "unknown, dropped") +
         entry("<path class=\"shape box\" d=\"M3 1h24v12H3Z\"/>", "box of the prior, seen in this frame") +
         entry("<path class=\"shape box\" stroke-dasharray=\"5 3\" d=\"M3 1h24v12H3Z\"/>",
               "carried from an earlier one") +
         entry("<path class=\"shape kept\" d=\"M3 11L27 3\"/>",
               "offset from where it would be if it were static, × 3") +
         (has_movers ? entry("<path class=\"shape mover0\" d=\"M3 1h24v12H3Z\"/>", "mover: identifier and speed")
                     : "") +
         "</ul>";
}

/// Where the script shows a frame; page/player.js.
std::string player(const PictureRoll& roll, bool has_movers) {
  return "<section id=\"frames\"><h2>Frames</h2>\n<div class=\"screen\"><img id=\"picture\" alt=\"Camera image\">"
         "<canvas id=\"drawing\" role=\"img\" aria-label=\"Verdict of each feature\"></canvas></div>\n"
         "<p id=\"feature\" class=\"more\" aria-live=\"polite\">Point at a feature, or tap it, to see why.</p>\n"
         "<p id=\"status\"></p>\n" +
         legend(has_movers) +
         "<p class=\"switches\"><label><input type=\"checkbox\" id=\"show_features\" checked> features</label> "
         "<label><input type=\"checkbox\" id=\"show_boxes\" checked> boxes</label> "
         "<label><input type=\"checkbox\" id=\"show_offsets\" checked> offsets</label> "
         "<label" +
         (has_movers ? "" : " hidden") +
         "><input type=\"checkbox\" id=\"show_movers\" checked> movers</label></p>\n"
         "<table id=\"reasons\"><caption>Why</caption><thead><tr><th scope=\"col\">reason</th>"
         "<th scope=\"col\" class=\"n\">kept</th><th scope=\"col\" class=\"n\">dropped</th></tr></thead>"
         "<tbody></tbody></table>\n" +
         (roll.stride() > 1
              ? "<p class=\"more\">One frame of " + std::to_string(roll.stride()) +
                    " has an image, so that the page stays small; the slider shows the nearest image.</p>\n"
              : "") +
         "<noscript><p class=\"more\">Frames and links from the plots to them need JavaScript.</p></noscript>\n"
         "</section>\n";
}

std::string moments_section(const RunRecord& run, const Figures& figures) {
  std::string html;
  for (const Moment& moment : moments(run, figures)) {
    std::string reasons;
    for (const std::string& reason : moment.reasons) reasons += (reasons.empty() ? "" : "; ") + reason;
    html += "<li><button type=\"button\" data-frame=\"" + std::to_string(moment.frame) + "\"><b>" +
            stillpoint::format_fixed(run.frames[moment.frame].time_s, 2) + " s</b> " + escaped(reasons) +
            "</button></li>\n";
  }
  return html.empty() ? ""
                      : "<section><h2>Moments worth a look</h2><ul class=\"moments\">\n" + html + "</ul></section>\n";
}

std::string maps_section(const DrawnPaths& paths) {
  if (paths.trajectories.empty()) return "";
  return "<section><h2>Trajectories</h2><div class=\"plots\">\n" + figure_of(map_plot(paths, {0, 1})) +
         figure_of(map_plot(paths, {1, 2})) + (paths.movers.empty() ? "" : figure_of(movers_map(paths))) +
         "<figure class=\"plot\"><h3>Trajectories in 3D</h3><canvas id=\"turntable\" tabindex=\"0\" role=\"img\" "
         "aria-label=\"Trajectories in 3D; the arrow keys turn them\"></canvas><figcaption>Drag to turn, or use the "
         "arrow keys; + and - or the wheel with Ctrl zoom. The grid is level, at the start's height, one metre a "
         "square "
         "unless it says otherwise.</figcaption></figure>\n</div></section>\n";
}

/// Stays at the lower edge of the window: wherever one reads, the moment can be changed.
constexpr char kClock[] =
    "<nav class=\"clock\" aria-label=\"Moment\"><a href=\"#frames\"><img id=\"thumbnail\" alt=\"To the frame\"></a>"
    "<button type=\"button\" id=\"back\" aria-label=\"Frame before\">&#9664;</button>"
    "<button type=\"button\" id=\"play\" aria-label=\"Play or pause\">play</button>"
    "<button type=\"button\" id=\"forth\" aria-label=\"Next frame\">&#9654;</button>"
    "<input type=\"range\" id=\"slider\" min=\"0\" value=\"0\" aria-label=\"Frame\"><output "
    "id=\"now\"></output></nav>\n";

constexpr char kHow[] =
    "<p class=\"more\">All times are seconds since the first frame. Slider, arrow keys (with Shift ten frames), Home, "
    "End "
    "and the space bar choose the moment; so does a click into a plot; every plot marks the moment. Frames are counted "
    "from "
    "0, as --start counts them.</p>\n";

}  // namespace

std::string report_html(const Options& options, const RunRecord& run, const Figures& figures,
                        const stillpoint::Camera& camera, const PictureRoll& roll) {
  const std::string title = "stillpoint: " + run.sequence;
  const std::vector<std::string> found = sentences(options, run, figures);
  const std::vector<MoverHistory> movers = mover_histories(run);
  const DrawnPaths paths = drawn_paths(run, figures, movers);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>" +
      escaped(title) + "</title><style>" + kReportStyle + "</style></head>\n<body><main>\n<h1>" + escaped(title) +
      "</h1>\n<p class=\"lead\">" + escaped(found[0]) + ' ' + escaped(found[1]) + "</p>\n";
  for (std::size_t i = 2; i < found.size(); ++i) html += "<p class=\"more\">" + escaped(found[i]) + "</p>\n";
  html += tiles(run, figures) + kHow + "<div class=\"desk\">\n<div class=\"left\">" + player(roll, !movers.empty()) +
          "</div>\n<div class=\"right\">" + moments_section(run, figures) + maps_section(paths) +
          "<section><h2>Over time</h2><div class=\"plots\">\n";
  for (const Plot& plot : report_plots(run, figures, movers)) html += figure_of(plot);
  html += "</div></section>\n</div>\n</div>\n<section><h2>Numbers</h2><div class=\"tables\">\n" +
          report_tables(options, run, figures, movers) +
          "</div></section>\n<footer>stillpoint_run " STILLPOINT_VERSION "</footer>\n" + kClock +
          "</main>\n<script type=\"application/json\" id=\"run\">" +
          report_data(options, run, paths, movers, camera, roll) + "</script>\n<script>\n\"use strict\";\n" +
          kReportScript + "</script>\n</body></html>\n";
  return html;
}

}  // namespace stillpoint_run
