// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features lie on one another?   A detector with octaves finds a corner again in each of them: what older frames
// show of one, they show of the other.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"

namespace stillpoint {

/// Features that were looked for, among which the next one may find its like. They come cell by cell: only those of one
/// cell are remembered.
class SamePlace {
 public:
  /// @param cell_px  side of the cells in which the features come
  explicit SamePlace(float cell_px) noexcept : cell_px_(cell_px) {}

  /// The feature that came before and lies on feature `i`: within a pixel, and on its surface where both have depth.
  /// `i` itself where there is none; it is remembered then.
  std::size_t find(const FrameFeatures& features, std::size_t i) noexcept {
    const Vector2f pixel = features.pixel[i];
    enter_cell_of(pixel);
    for (std::size_t k = 0; k < count_; ++k)
      if (is_near(pixel, pixel_[k]) && is_same_surface(features, i, feature_[k])) return feature_[k];
    if (count_ < kMost) {
      pixel_[count_] = pixel;
      feature_[count_++] = static_cast<std::uint32_t>(i);
    }
    return i;
  }

 private:
  static constexpr std::size_t kMost = 64;  // in a cell: those after them are looked for each by itself
  static constexpr float kNear_px = 1.0f;   // patches of eight pixels are the same there but for a line

  /// Pixels may lie anywhere: the numbers of cells need not fit an integer.
  void enter_cell_of(const Vector2f& pixel) noexcept {
    const float column = std::floor(pixel.x() / cell_px_), row = std::floor(pixel.y() / cell_px_);
    if (!(column == column_ && row == row_)) count_ = 0;
    column_ = column;
    row_ = row;
  }

  static bool is_near(const Vector2f& a, const Vector2f& b) noexcept {
    return std::abs(a.x() - b.x()) <= kNear_px && std::abs(a.y() - b.y()) <= kNear_px;
  }

  static bool is_same_surface(const FrameFeatures& features, std::size_t i, std::size_t j) noexcept {
    if (features.has_depth(i) != features.has_depth(j)) return false;
    return !features.has_depth(i) || std::abs(features.depth_m[i] - features.depth_m[j]) <= features.depth_sigma_m[i];
  }

  float cell_px_;
  float column_ = -1, row_ = -1;  // of the cell
  std::array<Vector2f, kMost> pixel_;
  std::array<std::uint32_t, kMost> feature_;
  std::size_t count_ = 0;
};

}  // namespace stillpoint
