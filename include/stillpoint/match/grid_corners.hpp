// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Corners of our own, one for each cell of a grid: support by area, not by where the texture is.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/lanes.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

namespace detail {

/// Column sums of the products of the gradients (twice as long) over some rows: one row comes, one goes. Of each there
/// are three lines, xx, xy and yy, of the image's width. The first and the last column have no gradient.
/// @param row   products of the row that goes, overwritten with those of the one that comes
/// @param sums  of whole numbers, therefore exact
inline void slide_down(const ImageView& image, int v, float* row, float* sums) noexcept {
  const std::uint8_t* const above = image.row<std::uint8_t>(v - 1);
  const std::uint8_t* const here = image.row<std::uint8_t>(v);
  const std::uint8_t* const below = image.row<std::uint8_t>(v + 1);
  const int width = image.width;
  // Works on copies, which can't overlap as the compiler would have to fear of the rows.
  const auto slide = [&](int first, auto lane) {
    constexpr std::size_t kLane = decltype(lane)::value;
    std::array<std::uint8_t, kLane> left, right, up, down;
    std::memcpy(left.data(), here + first - 1, kLane);
    std::memcpy(right.data(), here + first + 1, kLane);
    std::memcpy(up.data(), above + first, kLane);
    std::memcpy(down.data(), below + first, kLane);
    std::array<std::int16_t, kLane> x, y;
    for (std::size_t i = 0; i < kLane; ++i) {
      x[i] = static_cast<std::int16_t>(right[i] - left[i]);
      y[i] = static_cast<std::int16_t>(down[i] - up[i]);
    }
    const auto exchange = [&](int line, const auto& a, const auto& b) {
      float* const old = row + line * width + first;
      float* const total = sums + line * width + first;
      std::array<float, kLane> goes, comes, sum;
      std::memcpy(goes.data(), old, sizeof(goes));
      std::memcpy(sum.data(), total, sizeof(sum));
      for (std::size_t i = 0; i < kLane; ++i) {
        comes[i] = static_cast<float>(a[i] * b[i]);
        sum[i] += comes[i] - goes[i];
      }
      std::memcpy(old, comes.data(), sizeof(comes));
      std::memcpy(total, sum.data(), sizeof(sum));
    };
    exchange(0, x, x);
    exchange(1, x, y);
    exchange(2, y, y);
  };
  constexpr int kLane = 16;
  int u = 1;
  for (; u + kLane < width; u += kLane) slide(u, std::integral_constant<std::size_t, kLane>());
  for (; u + 1 < width; ++u) slide(u, std::integral_constant<std::size_t, 1>());
}

/// Keeps the greater of two numbers in each column, of equal ones the first, and the row that it comes from.
/// @param columns  a multiple of four
inline void keep_strongest(const float* half_trace, const float* root, float row, std::size_t columns, float* strongest,
                           float* row_of) noexcept {
  const FloatLanes here{row, row, row, row};
  for (std::size_t u = 0; u < columns; u += 4) {
    const FloatLanes strength = float_lanes(half_trace + u) - float_lanes(root + u),
                     before = float_lanes(strongest + u);
    const FloatLanes kept = strength > before ? strength : before;
    const FloatLanes kept_row = strength > before ? here : float_lanes(row_of + u);
    std::memcpy(strongest + u, &kept, sizeof kept);
    std::memcpy(row_of + u, &kept_row, sizeof kept_row);
  }
}

}  // namespace detail

/// The strongest corner of each cell, by the smaller eigenvalue of the structure tensor over 5 × 5 pixels.
/// Source: Shi and Tomasi, "Good Features to Track", CVPR 1994, Eq. (23).
/// @param image      gray; the pyramid's first level is sharp enough and a quarter of the work
/// @param cell_px    side of a cell in pixels of `image`
/// @param weakest    a cell whose strongest corner is below has none
/// @param corners    appended to, pixels of `image`. O(pixels).
inline void grid_corners(const ImageView& image, int cell_px, float weakest, std::vector<Vector2f>& corners,
                         Workspace& workspace) {
  constexpr int kRadius = 2, kBorder = kRadius + 4;
  const int columns = image.width, rows = image.height;
  if (columns <= 2 * kBorder || rows <= 2 * kBorder) return;
  const Workspace::Scope scope(workspace);
  const auto width = static_cast<std::size_t>(columns);
  // Column sums of the gradient products over 2 kRadius + 1 rows slide down the image.
  constexpr int kRows = 2 * kRadius + 1;
  const std::size_t padded = (width + 3) / 4 * 4;
  const span<float> sums = workspace.take<float>(3 * width), root = workspace.take<float>(padded),
                    half_trace = workspace.take<float>(padded), strongest = workspace.take<float>(padded),
                    row_of = workspace.take<float>(padded);
  Eigen::Map<Eigen::ArrayXf> roots(root.data(), columns);
  const span<float> products = workspace.take<float>(3 * width * kRows);
  const auto add_row = [&](int v) {
    detail::slide_down(image, v, products.data() + 3 * width * static_cast<std::size_t>(v % kRows), sums.data());
  };
  const auto flush = [&] {
    for (int begin = 0; begin < columns; begin += cell_px) {
      std::size_t best = static_cast<std::size_t>(begin);
      for (auto u = best; u < static_cast<std::size_t>(std::min(begin + cell_px, columns)); ++u)
        if (strongest[u] > strongest[best] || (strongest[u] == strongest[best] && row_of[u] < row_of[best])) best = u;
      if (strongest[best] > weakest) corners.emplace_back(static_cast<float>(best), row_of[best]);
    }
    std::fill(strongest.begin(), strongest.end(), 0.0f);
  };
  for (int v = kBorder - kRadius; v < kBorder + kRadius; ++v) add_row(v);
  for (int v = kBorder; v < rows - kBorder; ++v) {
    add_row(v + kRadius);
    const auto across = [](const float* of) {  // over 2 kRadius + 1 columns
      return [of](int u) { return of[u - 2] + of[u - 1] + of[u] + of[u + 1] + of[u + 2]; };
    };
    const auto sum_xx = across(sums.data()), sum_xy = across(sums.data() + width),
               sum_yy = across(sums.data() + 2 * width);
    float* const out = root.data();
    for (int u = kBorder; u < columns - kBorder; ++u) {
      const float a = sum_xx(u), b = sum_xy(u), c = sum_yy(u);
      half_trace[static_cast<std::size_t>(u)] = 0.5f * (a + c);
      out[u] = 0.25f * (a - c) * (a - c) + b * b;
    }
    // Eigen's roots come four at a time; std::sqrt's would one by one, because of errno.
    roots = roots.sqrt();
    detail::keep_strongest(half_trace.data(), root.data(), static_cast<float>(v), padded, strongest.data(),
                           row_of.data());
    if ((v + 1) % cell_px == 0) flush();
  }
  flush();
}

}  // namespace stillpoint
