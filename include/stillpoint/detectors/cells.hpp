// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Cells of a network's grids: how many there are tells layouts apart, and where each lies decodes them.

#include <algorithm>
#include <initializer_list>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// Cells along an edge; the last may be cut.
constexpr int cells_along(int extent_px, int stride_px) noexcept { return (extent_px + stride_px - 1) / stride_px; }

/// Cells of a grid.
constexpr int cells_of(const InputSize& input, int stride_px) noexcept {
  return cells_along(input.width, stride_px) * cells_along(input.height, stride_px);
}

/// Cells of all grids with strides 8, 16 … up to the last.
constexpr int cells_up_to(const InputSize& input, int last_stride_px) noexcept {
  int cells = 0;
  for (int stride_px = 8; stride_px <= last_stride_px; stride_px *= 2) cells += cells_of(input, stride_px);
  return cells;
}

/// The last stride if `count` is all cells of strides 8 to 32, or to 64; 0 if it is neither.
constexpr int last_stride(const InputSize& input, int count) noexcept {
  return count <= 0 ? 0 : count == cells_up_to(input, 32) ? 32 : count == cells_up_to(input, 64) ? 64 : 0;
}

/// Calls `visit(index, u, v, stride_px)` for all cells, strides ascending, each grid row by row.
template <class Visit>
void for_each_cell(const InputSize& input, int last_stride_px, Visit&& visit) {
  int index = 0;
  for (int stride_px = 8; stride_px <= last_stride_px; stride_px *= 2)
    for (int v = 0; v < cells_along(input.height, stride_px); ++v)
      for (int u = 0; u < cells_along(input.width, stride_px); ++u) visit(index++, u, v, stride_px);
}

}  // namespace stillpoint
