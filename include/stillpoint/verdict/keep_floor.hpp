// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How much must be left?   A tracker that gets nothing is lost: where too few features would be left, the least dynamic
// ones are kept.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Keeps dynamic features, least log-odds first, until enough are kept, and until enough cells of a grid over the image
/// hold one: features in one corner of the image do not hold a pose. Each has `Reason::keep_floor`.
class KeepFloor {
 public:
  struct Options {
    std::size_t fewest_features = 30;  ///< trackers call themselves lost below 10 to 30 matches
    std::size_t fewest_cells = 3;      ///< of the grid
  };
  Options options;

  /// @return how many features it kept
  std::size_t apply(span<const Vector2f> pixels, const ImageView& image, span<Label> labels,
                    Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<std::size_t> kept_in_cell = workspace.take<std::size_t>(kColumns * kRows);
    const span<std::uint32_t> dropped = workspace.take<std::uint32_t>(labels.size());
    std::size_t kept = 0, count = 0, cells = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (!(image.border_distance_px(pixels[i].x(), pixels[i].y()) >= 0.0f)) continue;  // of no use to a tracker
      if (labels[i].keep)
        ++kept, cells += kept_in_cell[cell(pixels[i], image)]++ == 0;
      else
        dropped[count++] = static_cast<std::uint32_t>(i);
    }
    const bool enough_cells = cells >= options.fewest_cells;
    if (kept >= options.fewest_features && enough_cells) return 0;
    std::sort(dropped.begin(), dropped.begin() + count, [&](std::uint32_t a, std::uint32_t b) {
      return labels[a].log_odds != labels[b].log_odds ? labels[a].log_odds < labels[b].log_odds : a < b;
    });
    std::size_t rescued = 0;
    const auto rescue = [&](Label& label, std::size_t in_cell) {
      label.keep = true;
      label.reason = Reason::keep_floor;
      cells += kept_in_cell[in_cell]++ == 0;
      ++kept;
      ++rescued;
    };
    for (std::size_t k = 0; k < count && cells < options.fewest_cells; ++k) {  // an empty cell first
      const std::size_t in_cell = cell(pixels[dropped[k]], image);
      if (kept_in_cell[in_cell] == 0) rescue(labels[dropped[k]], in_cell);
    }
    for (std::size_t k = 0; k < count && kept < options.fewest_features; ++k)
      if (!labels[dropped[k]].keep) rescue(labels[dropped[k]], cell(pixels[dropped[k]], image));
    return rescued;
  }

 private:
  static constexpr std::size_t kColumns = 4, kRows = 3;  // of the grid: cells about as high as wide

  std::size_t cell(const Vector2f& pixel, const ImageView& image) const noexcept {
    const auto part = [](float coordinate, int size, std::size_t parts) -> std::size_t {
      const float scaled = coordinate / static_cast<float>(std::max(size, 1)) * static_cast<float>(parts);
      return std::isfinite(scaled) ? static_cast<std::size_t>(std::clamp(scaled, 0.0f, static_cast<float>(parts - 1)))
                                   : 0;
    };
    return part(pixel.y(), image.height, kRows) * kColumns + part(pixel.x(), image.width, kColumns);
  }
};

template <class Visit>
void each_option(KeepFloor& stage, Visit& visit) {
  visit("fewest_features", stage.options.fewest_features, OptionRange{0, 1e6});
  visit("fewest_cells", stage.options.fewest_cells, OptionRange{0, 12});
}

}  // namespace stillpoint
