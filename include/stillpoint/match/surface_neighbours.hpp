// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which cells of surface adjoin each other, in the image and in depth?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The cells of a regular grid that adjoin each other in the image and in space.
class SurfaceNeighbours {
 public:
  /// @param cells     in rows from the upper left; a cell may be missing
  /// @param step_px   spacing of the grid
  /// @param focal_px  of the camera
  SurfaceNeighbours(span<const SurfaceCell> cells, float step_px, double focal_px, Workspace& workspace)
      : cells_(cells), step_px_(step_px), reach_(kSteepest * static_cast<double>(step_px) / focal_px) {
    for (const SurfaceCell& cell : cells) {
      columns_ = std::max(columns_, column(cell.pixel) + 1);
      rows_ = std::max(rows_, row(cell.pixel) + 1);
    }
    at_ = workspace.take<std::uint32_t>(columns_ * rows_, kNone);
    for (std::size_t s = 0; s < cells.size(); ++s)
      at_[row(cells[s].pixel) * columns_ + column(cells[s].pixel)] = static_cast<std::uint32_t>(s);
  }

  /// Calls `visit(index)` for each cell that adjoins a place.
  template <class Visit>
  void around(const Vector2f& pixel, double depth_m, const Visit& visit) const {
    const std::size_t u = column(pixel), v = row(pixel);
    for (std::size_t y = v > 0 ? v - 1 : 0; y < std::min(v + 2, rows_); ++y)
      for (std::size_t x = u > 0 ? u - 1 : 0; x < std::min(u + 2, columns_); ++x) {
        const std::uint32_t index = at_[y * columns_ + x];
        if (index == kNone) continue;
        const double there_m = cells_[index].point.z();
        if (std::abs(there_m - depth_m) <= reach_ * std::min(there_m, depth_m)) visit(std::size_t{index});
      }
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr double kSteepest = 2.75;  // tangent of 70 degrees: a steeper step from cell to cell is an edge

  std::size_t column(const Vector2f& pixel) const noexcept { return index_of(pixel.x()); }
  std::size_t row(const Vector2f& pixel) const noexcept { return index_of(pixel.y()); }
  std::size_t index_of(float coordinate_px) const noexcept {
    return static_cast<std::size_t>(std::max(coordinate_px, 0.0f) / step_px_);
  }

  span<const SurfaceCell> cells_;
  float step_px_;
  double reach_;  // of two cells' depths, relative
  std::size_t columns_ = 0, rows_ = 0;
  span<std::uint32_t> at_;
};

}  // namespace stillpoint
