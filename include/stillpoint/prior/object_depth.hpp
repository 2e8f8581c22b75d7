// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How far away is the object that a box was drawn around?

#include <array>
#include <cstddef>
#include <optional>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// Depth along a box, from its top to its bottom: a camera that looks down on a person has the head nearer than the
/// feet, by more than the person is thick.
struct ObjectDepth {
  double middle_m = 0;  ///< half way down
  double slope_m = 0;   ///< from the top to the bottom

  /// The line through the depths of the box's middle third, which the object fills for the most part: medians of rows,
  /// and of all slopes between two of them (Theil, Proc. KNAW 53, 1950), so that a row that sees past the object,
  /// between a person's legs, does no harm while fewer than 29 % are such.
  /// @return nothing where fewer than three rows have three depths
  static std::optional<ObjectDepth> measure(const DepthView& depth, const DepthScale& to_depth, const Box& box) {
    constexpr std::size_t kColumns = 9, kRows = 18, kFewest = 3;
    std::array<float, kRows> row_m, down;  // depth; share of the height, from the middle
    std::size_t rows = 0;
    for (std::size_t j = 0; j < kRows; ++j) {
      const float y = (static_cast<float>(j) + 0.5f) / kRows;
      std::array<float, kColumns> samples;
      std::size_t count = 0;
      for (std::size_t i = 0; i < kColumns; ++i) {
        const float x = 1.0f / 3.0f + (static_cast<float>(i) + 0.5f) / kColumns / 3.0f;
        const Vector2f pixel = to_depth({box.x + x * box.width, box.y + y * box.height});
        const auto depth_m = static_cast<float>(RoundedDepth{}.at(depth, pixel));
        if (depth_m > 0.0f) samples[count++] = depth_m;
      }
      if (count < kFewest) continue;
      row_m[rows] = median_in_place(span<float>(samples.data(), count));
      down[rows++] = y - 0.5f;
    }
    if (rows < kFewest) return std::nullopt;
    std::array<float, kRows*(kRows - 1) / 2> slopes;
    std::size_t pairs = 0;
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = a + 1; b < rows; ++b) slopes[pairs++] = (row_m[b] - row_m[a]) / (down[b] - down[a]);
    const float slope_m = median_in_place(span<float>(slopes.data(), pairs));
    for (std::size_t a = 0; a < rows; ++a) row_m[a] -= slope_m * down[a];
    const float middle_m = median_in_place(span<float>(row_m.data(), rows));
    return ObjectDepth{static_cast<double>(middle_m), static_cast<double>(slope_m)};
  }
};

}  // namespace stillpoint
