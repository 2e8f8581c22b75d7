// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How much of each part of the last frame stood still: a coarse grid over the image.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Weights from 0 (moves) to 1, by the verdicts of the features and the static prior of the surfaces in each cell.
class StaticWeights {
 public:
  /// @param labels  of all features, after the memory
  void assign(const Observations& observations, span<const Label> labels, int image_width, int image_height) {
    const Matches& matches = observations.matches;
    const Remembered& remembered = observations.remembered;
    cell_px_ = std::max(kCell_px, rounded(matches.pixel_scale * static_cast<float>(kCell_px)));
    columns_ = std::max(1, (image_width + cell_px_ - 1) / cell_px_);
    rows_ = std::max(1, (image_height + cell_px_ - 1) / cell_px_);
    refill(sum_, static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
    for (std::size_t i = 0; i < matches.size(); ++i)
      add(matches.current.pixel[i], labels[i].keep ? remembered.static_prior[i] : 0.0f, 1.0f);
    const span<const SurfaceCell> cells = matches.past_observations.surfaces;
    for (std::size_t s = 0; s < cells.size(); ++s)
      add(cells[s].pixel, remembered.surface_static_prior[s], kSurfaceVote);
  }

  /// 1 where nothing is known.
  float at(const Vector2f& pixel) const noexcept {
    const Cell* const cell = find(pixel);
    return cell == nullptr || !(cell->votes > 0) ? 1.0f : cell->weight / cell->votes;
  }

  void clear() noexcept { columns_ = rows_ = 0; }

 private:
  static constexpr int kCell_px = 24;          // at a focal length of 525 px, as corners and surfaces are spread
  static constexpr float kSurfaceVote = 0.5f;  // where there are features, they know better

  struct Cell {
    float weight = 0, votes = 0;
  };

  const Cell* find(const Vector2f& pixel) const noexcept {
    if (!(pixel.x() >= 0 && pixel.y() >= 0)) return nullptr;
    const int u = static_cast<int>(std::min(pixel.x(), 1e6f)) / cell_px_;
    const int v = static_cast<int>(std::min(pixel.y(), 1e6f)) / cell_px_;
    if (u >= columns_ || v >= rows_) return nullptr;
    return &sum_[static_cast<std::size_t>(v) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(u)];
  }

  void add(const Vector2f& pixel, float weight, float votes) noexcept {
    Cell* const cell = const_cast<Cell*>(find(pixel));
    if (cell == nullptr) return;
    cell->weight += votes * weight;
    cell->votes += votes;
  }

  std::vector<Cell> sum_;
  int columns_ = 0, rows_ = 0, cell_px_ = kCell_px;
};

}  // namespace stillpoint
