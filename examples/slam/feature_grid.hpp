// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features lie near a pixel.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace examples::slam {

/// The features of a frame by the cells of a grid. Owned by its frame, unlike `stillpoint::PixelGrid`, and cheap to
/// keep.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(stillpoint::span<const stillpoint::Vector2d> pixels, int width_px, int height_px)
      : columns_(width_px / kCell_px + 1), rows_(height_px / kCell_px + 1) {
    const auto cells = static_cast<std::size_t>(columns_ * rows_);
    begin_.assign(cells + 1, 0);
    std::vector<std::size_t> cell_of;
    for (const stillpoint::Vector2d& pixel : pixels) {
      cell_of.push_back(static_cast<std::size_t>(row(pixel.y()) * columns_ + column(pixel.x())));
      ++begin_[cell_of.back() + 1];
    }
    for (std::size_t cell = 0; cell < cells; ++cell) begin_[cell + 1] += begin_[cell];
    feature_.resize(pixels.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < cell_of.size(); ++i) feature_[next[cell_of[i]]++] = static_cast<int>(i);
  }

  /// Calls visit(feature) for all in the cells that a square around `pixel` touches: more than those in the square.
  template <class Visit>
  void near(const stillpoint::Vector2d& pixel, double reach_px, Visit&& visit) const {
    if (feature_.empty() || !pixel.allFinite()) return;
    const int left = column(pixel.x() - reach_px), right = column(pixel.x() + reach_px);
    const int bottom = row(pixel.y() + reach_px);
    for (int y = row(pixel.y() - reach_px); y <= bottom; ++y) {
      const auto first = static_cast<std::size_t>(y * columns_);
      const std::size_t end = begin_[first + static_cast<std::size_t>(right) + 1];
      for (std::size_t i = begin_[first + static_cast<std::size_t>(left)]; i < end; ++i) visit(feature_[i]);
    }
  }

 private:
  static constexpr int kCell_px = 16;

  /// What lies outside of the image, undistorted pixels for example, is in the cells of its border.
  static int clamped(double pixel, int count) {
    return static_cast<int>(std::clamp(std::floor(pixel / kCell_px), 0.0, static_cast<double>(count - 1)));
  }
  int column(double u) const { return clamped(u, columns_); }
  int row(double v) const { return clamped(v, rows_); }

  int columns_ = 0, rows_ = 0;
  std::vector<std::size_t> begin_;  ///< of each cell in `feature_`
  std::vector<int> feature_;
};

}  // namespace examples::slam
