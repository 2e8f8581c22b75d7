// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the page's script knows of the run: frames, trajectories, pictures, and what the terms mean.

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explanations.hpp"
#include "figures.hpp"
#include "html.hpp"
#include "mover_history.hpp"
#include "options.hpp"
#include "picture_roll.hpp"
#include "run_paths.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_run {

namespace detail {

/// Four decimals: tenths of a millimetre, tenths of a millisecond.
inline nlohmann::json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1e4) / 1e4;
}

inline nlohmann::json frames_data(const Options& options, const RunRecord& run) {
  nlohmann::json frames = nlohmann::json::array();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FrameSummary& frame = run.frames[i];
    nlohmann::json warnings = nlohmann::json::array();
    frame.warnings.for_each([&warnings](stillpoint::Warning warning) { warnings.push_back(to_string(warning)); });
    frames.push_back({{"number", static_cast<std::size_t>(options.start) + i},
                      {"t", rounded(frame.time_s)},
                      {"stamp", stillpoint::format_fixed(frame.timestamp_s, 6)},
                      {"status", to_string(frame.status)},
                      {"warnings", std::move(warnings)},
                      {"features", frame.features},
                      {"kept", frame.kept},
                      {"ms", rounded(frame.timings.total_ms())}});
  }
  return frames;
}

/// name → [[right, ahead, up] or null, one per frame]; in the order in which they are drawn.
inline nlohmann::ordered_json paths_data(const std::vector<DrawnPath>& paths) {
  nlohmann::ordered_json data = nlohmann::ordered_json::object();
  for (const DrawnPath& path : paths) {
    nlohmann::json points = nlohmann::json::array();
    for (const std::optional<stillpoint::Vector3d>& point : path.of_frame)
      if (point)
        points.push_back({rounded(point->x()), rounded(point->y()), rounded(point->z())});
      else
        points.push_back(nullptr);
    data[path.key] = std::move(points);
  }
  return data;
}

/// Each mover from its frame `from` on: `seen` is [x, y, width, height, speed, state] or null, `path` as those above.
inline nlohmann::json movers_data(const std::vector<MoverHistory>& movers, const std::vector<DrawnPath>& paths) {
  nlohmann::json data = nlohmann::json::array();
  for (std::size_t m = 0; m < movers.size(); ++m) {
    nlohmann::json seen = nlohmann::json::array(), path = nlohmann::json::array();
    for (std::size_t i = movers[m].first_frame; i <= movers[m].last_frame; ++i) {
      seen.push_back(nullptr);
      if (const MoverInFrame* const now = movers[m].in(i))
        seen.back() = {std::round(now->box.x),      std::round(now->box.y),  std::round(now->box.width),
                       std::round(now->box.height), rounded(now->speed_m_s), to_string(now->state)};
      path.push_back(nullptr);
      if (m < paths.size() && paths[m].of_frame[i])
        path.back() = {rounded(paths[m].of_frame[i]->x()), rounded(paths[m].of_frame[i]->y()),
                       rounded(paths[m].of_frame[i]->z())};
    }
    data.push_back({{"key", movers[m].key()},
                    {"name", movers[m].name()},
                    {"colour", m % kMoverColours},
                    {"from", movers[m].first_frame},
                    {"seen", std::move(seen)},
                    {"path", std::move(path)}});
  }
  return data;
}

inline nlohmann::json pictures_data(const std::vector<Picture>& pictures) {
  nlohmann::json data = nlohmann::json::array();
  for (const Picture& picture : pictures) {
    nlohmann::json boxes = nlohmann::json::array();
    for (const auto& [region, class_name] : picture.regions) {
      const stillpoint::Box& box = region.detection.box;
      boxes.push_back({{"box", {rounded(box.x), rounded(box.y), rounded(box.width), rounded(box.height)}},
                       {"name", (class_name.empty() ? "" : class_name + ": ") + to_string(region.detection.mobility)},
                       {"moves", region.detection.mobility == stillpoint::Mobility::dynamic},
                       {"carried", region.is_carried}});
    }
    data.push_back({{"frame", picture.frame},
                    {"boxes", std::move(boxes)},
                    {"features", "data:application/octet-stream;base64," + base64(picture.features)},
                    {"jpeg", "data:image/jpeg;base64," + base64(picture.jpeg)}});
  }
  return data;
}

inline nlohmann::json terms_data() {
  nlohmann::json reasons = nlohmann::json::array(), statuses = nlohmann::json::object(),
                 warnings = nlohmann::json::object();
  for (std::size_t i = 0; i < stillpoint::kReasonCount; ++i) {
    const auto reason = static_cast<stillpoint::Reason>(i);
    reasons.push_back({to_string(reason), explained(reason)});
  }
  reasons.push_back({"label", "the label image says so: nothing was judged"});  // of the oracle
  for (std::size_t i = 0; i < stillpoint::kStatusCount; ++i) {
    const auto status = static_cast<stillpoint::Status>(i);
    statuses[to_string(status)] = explained(status);
  }
  for (std::size_t i = 0; i < stillpoint::kWarningCount; ++i) {
    const auto warning = static_cast<stillpoint::Warning>(i);
    warnings[to_string(warning)] = explained(warning);
  }
  return {{"reasons", std::move(reasons)}, {"statuses", std::move(statuses)}, {"warnings", std::move(warnings)}};
}

}  // namespace detail

/// JSON that can stand in a script element.
inline std::string report_data(const Options& options, const RunRecord& run, const DrawnPaths& paths,
                               const std::vector<MoverHistory>& movers, const stillpoint::Camera& camera,
                               const PictureRoll& roll) {
  const nlohmann::ordered_json data = {{"width", camera.width()},
                                       {"height", camera.height()},
                                       {"stride", roll.stride()},
                                       {"frames", detail::frames_data(options, run)},
                                       {"paths", detail::paths_data(paths.trajectories)},
                                       {"movers", detail::movers_data(movers, paths.movers)},
                                       {"pictures", detail::pictures_data(roll.pictures())},
                                       {"terms", detail::terms_data()}};
  constexpr int kOneLine = -1;  // of a detector's class names nobody knows the encoding
  std::string text = data.dump(kOneLine, ' ', false, nlohmann::json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace stillpoint_run
