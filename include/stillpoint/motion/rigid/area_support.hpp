// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features speak for the camera's motion?   One per cell of a grid: support counts area, not texture.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// One flag per feature. All are set unless `host_supports`: corners of the matcher are spread over the image
/// already. Otherwise one match per cell that is not near the border: the first with depths, or the first at all.
/// @param cell_px  side of a cell, pixels; below 1 all flags are set
inline span<const std::uint8_t> area_support(const Matches& matches, float cell_px, Workspace& workspace) {
  const bool is_spread = !matches.host_supports || !(cell_px >= 1);
  const span<std::uint8_t> speaks =
      workspace.take<std::uint8_t>(matches.size(), is_spread ? std::uint8_t{1} : std::uint8_t{0});
  if (is_spread) return speaks;
  Vector2f largest = Vector2f::Zero();
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches.matched(i))
      largest = {std::max(largest.x(), matches.current.pixel[i].x()),
                 std::max(largest.y(), matches.current.pixel[i].y())};
  const auto cell_of = [cell_px](float coordinate_px) { return static_cast<std::size_t>(coordinate_px / cell_px); };
  const std::size_t columns = cell_of(largest.x()) + 1, rows = cell_of(largest.y()) + 1;
  constexpr std::uint32_t kNobody = 0;
  const span<std::uint32_t> chosen = workspace.take<std::uint32_t>(columns * rows, kNobody);  // index + 1
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches.matched(i) || matches.state[i] == MatchState::near_edge) continue;
    const Vector2f pixel = matches.current.pixel[i];
    std::uint32_t& of_cell = chosen[cell_of(pixel.y()) * columns + cell_of(pixel.x())];
    if (of_cell == kNobody || (matches.metric(i) && !matches.metric(of_cell - 1)))
      of_cell = static_cast<std::uint32_t>(i + 1);
  }
  for (const std::uint32_t of_cell : chosen)
    if (of_cell != kNobody) speaks[of_cell - 1] = 1;
  return speaks;
}

}  // namespace stillpoint
