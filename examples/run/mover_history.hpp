// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The movers of a run, each over all of its frames.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "frame_record.hpp"

namespace stillpoint_run {

/// One object from the first to the last frame of the run that knows it.
struct MoverHistory {
  std::uint32_t id = 0;
  std::string class_name = "unknown";  ///< the last that a detector gave it
  std::size_t first_frame = 0, last_frame = 0;
  std::size_t seen_frames = 0;  ///< in which it is not lost
  double greatest_speed_m_s = 0.0;
  std::vector<MoverInFrame> frames;  ///< in their order

  /// Null in a frame that does not have it.
  const MoverInFrame* in(std::size_t frame) const {
    const auto found = std::lower_bound(frames.begin(), frames.end(), frame,
                                        [](const MoverInFrame& seen, std::size_t i) { return seen.frame < i; });
    return found != frames.end() && found->frame == frame ? &*found : nullptr;
  }
  /// Of its path in the page's data.
  std::string key() const { return "mover " + std::to_string(id); }
  /// As in "id 2 (person)".
  std::string name() const {
    return "id " + std::to_string(id) + (class_name == "unknown" ? "" : " (" + class_name + ')');
  }
};

/// The movers of the report, by identifier.
/// @param most  of more, those that were seen longest
inline std::vector<MoverHistory> mover_histories(const RunRecord& run, std::size_t most = 20) {
  std::map<std::uint32_t, MoverHistory> by_id;
  for (const MoverInFrame& seen : run.movers) {
    MoverHistory& mover = by_id[seen.id];
    if (mover.frames.empty()) mover.first_frame = seen.frame;
    mover.id = seen.id;
    mover.last_frame = seen.frame;
    mover.frames.push_back(seen);
    if (seen.class_name != "unknown") mover.class_name = seen.class_name;
    if (seen.state == stillpoint::MoverState::lost) continue;
    ++mover.seen_frames;
    mover.greatest_speed_m_s = std::max(mover.greatest_speed_m_s, seen.speed_m_s);
  }
  std::vector<MoverHistory> movers;
  for (auto& [id, mover] : by_id) movers.push_back(std::move(mover));
  std::stable_sort(movers.begin(), movers.end(),
                   [](const MoverHistory& a, const MoverHistory& b) { return a.seen_frames > b.seen_frames; });
  if (movers.size() > most) movers.resize(most);
  std::sort(movers.begin(), movers.end(), [](const MoverHistory& a, const MoverHistory& b) { return a.id < b.id; });
  return movers;
}

/// Colour of a mover of the report, by its place in the list; the page has so many.
inline constexpr std::size_t kMoverColours = 6;
inline std::string mover_class(std::size_t index) { return "mover" + std::to_string(index % kMoverColours); }

}  // namespace stillpoint_run
