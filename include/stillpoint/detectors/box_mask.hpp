// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Rasters over boxes: made from a rule, cut with their box.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// The cell that a place lies in, of a row of cells from 0 on; -1 outside, and for NaN.
/// @param place  in cells
inline int cell_at(float place, int cells) noexcept {
  return place >= 0.0f && place < static_cast<float>(cells) ? std::min(static_cast<int>(place), cells - 1) : -1;
}

/// A raster over the box.
/// @param inside  `bool(float x, float y)` for the middle of each cell, x and y in pixels of the input
template <class Inside>
std::shared_ptr<const BoxMask> make_mask(const RawDetection& box, int columns, int rows, Inside&& inside) {
  auto mask = std::make_shared<BoxMask>();
  mask->columns = std::max(columns, 1);
  mask->rows = std::max(rows, 1);
  mask->inside.reserve(static_cast<std::size_t>(mask->columns) * static_cast<std::size_t>(mask->rows));
  for (int v = 0; v < mask->rows; ++v) {
    const float y = box.top + (static_cast<float>(v) + 0.5f) / static_cast<float>(mask->rows) * (box.bottom - box.top);
    for (int u = 0; u < mask->columns; ++u) {
      const float x =
          box.left + (static_cast<float>(u) + 0.5f) / static_cast<float>(mask->columns) * (box.right - box.left);
      mask->inside.push_back(inside(x, y) ? 1 : 0);
    }
  }
  return mask;
}

/// The part of `whole.mask` that lies over `part`, a box within `whole`; cells keep about their size.
inline std::shared_ptr<const BoxMask> crop_mask(const RawDetection& whole, const RawDetection& part) {
  const float width = whole.right - whole.left, height = whole.bottom - whole.top;
  const float columns = static_cast<float>(whole.mask->columns) * (part.right - part.left) / width;
  const float rows = static_cast<float>(whole.mask->rows) * (part.bottom - part.top) / height;
  if (columns == static_cast<float>(whole.mask->columns) && rows == static_cast<float>(whole.mask->rows))
    return whole.mask;
  return make_mask(
      part, static_cast<int>(std::ceil(columns)), static_cast<int>(std::ceil(rows)),
      [&](float x, float y) { return whole.mask->at((x - whole.left) / width, (y - whole.top) / height); });
}

}  // namespace stillpoint
