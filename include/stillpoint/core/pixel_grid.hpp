// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Points of an image sorted into square cells, for looking up neighbours.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// A grid over a list of pixels; points that are not finite are left out. Lives in the workspace.
class PixelGrid {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// @param accept `bool(std::size_t)`: which points take part
  template <class Accept>
  PixelGrid(span<const Vector2f> pixels, float cell_px, Workspace& workspace, const Accept& accept)
      : cells_per_px_(1.0f / cell_px) {
    const span<Entry> listed = workspace.take<Entry>(pixels.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (is_finite(pixels[i]) && accept(i)) listed[count++] = {pixels[i], static_cast<std::uint32_t>(i)};
    sort_into_cells(listed.first(count), workspace);
  }

  /// Calls `visit(index, squared_distance_px)` for every point within `radius_px`, cell by cell, in a fixed order.
  template <class Visit>
  void within(const Vector2f& pixel, float radius_px, const Visit& visit) const {
    runs_around(pixel, radius_px, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const float squared = (entry_[k].pixel - pixel).squaredNorm();
        if (squared <= radius_px * radius_px) visit(std::size_t{entry_[k].index}, squared);
      }
    });
  }

  /// The index of the nearest point within `radius_px` that is accepted, of equally near ones the first in the order of
  /// `within`; `kNone` where there is none.
  /// @param accept  `bool(index, squared_distance_px)`, asked of points that are nearer than all that were accepted
  template <class Accept>
  std::size_t nearest(const Vector2f& pixel, float radius_px, const Accept& accept) const {
    std::size_t nearest = kNone;
    float least = std::numeric_limits<float>::infinity();
    within(pixel, radius_px, [&](std::size_t i, float squared) {
      if (!(squared < least) || !accept(i, squared)) return;
      least = squared;
      nearest = i;
    });
    return nearest;
  }

  /// Points have a rank in the order of the cells. `visit(first, last)` is called for every run of ranks in the cells
  /// that the circle touches: all within it and some beyond, for loops that weigh instead of asking.
  template <class Visit>
  void runs_around(const Vector2f& pixel, float radius_px, const Visit& visit) const {
    if (!is_finite(pixel) || !(std::max(std::abs(pixel.x()), std::abs(pixel.y())) < 2 * kLargest_px)) return;
    const std::size_t u0 = clamped(pixel.x() - radius_px, columns_), u1 = clamped(pixel.x() + radius_px, columns_);
    const std::size_t v0 = clamped(pixel.y() - radius_px, rows_), v1 = clamped(pixel.y() + radius_px, rows_);
    for (std::size_t v = v0; v <= v1; ++v)
      visit(std::size_t{begin_[v * columns_ + u0]}, std::size_t{begin_[v * columns_ + u1 + 1]});
  }

  /// How many points take part.
  std::size_t size() const noexcept { return entry_.size(); }
  /// The index of the point of a rank.
  std::size_t index(std::size_t rank) const noexcept { return entry_[rank].index; }

 private:
  struct Entry {
    Vector2f pixel = Vector2f::Zero();
    std::uint32_t index = 0;
  };

  static constexpr float kLargest_px = 1e5f;
  static constexpr std::size_t kMostCells = 512;  // to a side: the last ones take in what is farther away

  /// A counting sort: count, sum up, put in place from behind.
  void sort_into_cells(span<const Entry> listed, Workspace& workspace) {
    Vector2f largest = Vector2f::Zero();
    for (const Entry& entry : listed)
      largest = {std::max(largest.x(), entry.pixel.x()), std::max(largest.y(), entry.pixel.y())};
    const auto cells_to = [this](float largest_px) {
      return std::min(static_cast<std::size_t>(std::min(largest_px, kLargest_px) * cells_per_px_) + 1, kMostCells);
    };
    columns_ = cells_to(largest.x());
    rows_ = cells_to(largest.y());
    begin_ = workspace.take<std::uint32_t>(columns_ * rows_ + 1);
    entry_ = workspace.take<Entry>(listed.size());
    for (const Entry& entry : listed) ++begin_[cell(entry.pixel)];
    std::uint32_t sum = 0;
    for (std::uint32_t& entry : begin_) entry = sum += entry;
    for (std::size_t k = listed.size(); k-- > 0;) entry_[--begin_[cell(listed[k].pixel)]] = listed[k];
  }

  std::size_t clamped(float coordinate_px, std::size_t count) const noexcept {
    return static_cast<std::size_t>(std::clamp(coordinate_px * cells_per_px_, 0.0f, static_cast<float>(count - 1)));
  }
  std::size_t cell(const Vector2f& pixel) const noexcept {
    return clamped(pixel.y(), rows_) * columns_ + clamped(pixel.x(), columns_);
  }

  float cells_per_px_;
  std::size_t columns_ = 1, rows_ = 1;
  span<std::uint32_t> begin_;
  span<Entry> entry_;  // cell by cell: a search reads on without jumps
};

}  // namespace stillpoint
