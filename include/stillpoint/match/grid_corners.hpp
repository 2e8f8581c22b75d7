// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Corners of our own, one for each cell of a grid: support by area, not by where the texture is.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

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
  const int cells_across = (columns + cell_px - 1) / cell_px;
  struct Best {
    float strength = 0;
    int u = 0, v = 0;
  };
  const span<Best> best = workspace.take<Best>(static_cast<std::size_t>(cells_across));
  // Column sums of the gradient products over 2 kRadius + 1 rows slide down the image.
  const span<float> xx = workspace.take<float>(width), xy = workspace.take<float>(width),
                    yy = workspace.take<float>(width), half_trace = workspace.take<float>(width),
                    strength = workspace.take<float>(width);
  const auto add_row = [&](int v, float sign) {
    const std::uint8_t* const above = image.row<std::uint8_t>(v - 1);
    const std::uint8_t* const here = image.row<std::uint8_t>(v);
    const std::uint8_t* const below = image.row<std::uint8_t>(v + 1);
    float *const pxx = xx.data(), *const pxy = xy.data(), *const pyy = yy.data();
    for (int u = 1; u < columns - 1; ++u) {
      const auto gx = static_cast<float>(here[u + 1] - here[u - 1]), gy = static_cast<float>(below[u] - above[u]);
      pxx[u] += sign * gx * gx;
      pxy[u] += sign * gx * gy;
      pyy[u] += sign * gy * gy;
    }
  };
  const auto flush = [&] {
    for (Best& cell : best) {
      if (cell.strength > weakest) corners.emplace_back(static_cast<float>(cell.u), static_cast<float>(cell.v));
      cell = Best{};
    }
  };
  for (int v = kBorder - kRadius; v < kBorder + kRadius; ++v) add_row(v, 1.0f);
  for (int v = kBorder; v < rows - kBorder; ++v) {
    add_row(v + kRadius, 1.0f);
    const auto across = [](const float* sums) {  // over 2 kRadius + 1 columns
      return [sums](int u) { return sums[u - 2] + sums[u - 1] + sums[u] + sums[u + 1] + sums[u + 2]; };
    };
    const auto sum_xx = across(xx.data()), sum_xy = across(xy.data()), sum_yy = across(yy.data());
    float *const mean = half_trace.data(), *const out = strength.data();
    for (int u = kBorder; u < columns - kBorder; ++u) {
      const float a = sum_xx(u), b = sum_xy(u), c = sum_yy(u);
      mean[u] = 0.5f * (a + c);
      out[u] = 0.25f * (a - c) * (a - c) + b * b;
    }
    // Eigen's roots come four at a time; std::sqrt's would one by one, because of errno.
    Eigen::Map<Eigen::ArrayXf> all(out, columns);
    all = Eigen::Map<const Eigen::ArrayXf>(mean, columns) - all.sqrt();
    for (int begin = 0, end = cell_px; begin < columns; begin = end, end += cell_px) {
      Best& cell = best[static_cast<std::size_t>(begin / cell_px)];
      const int first = std::max(begin, kBorder), last = std::min(end, columns - kBorder);
      if (first >= last || !(all.segment(first, last - first).maxCoeff() > cell.strength)) continue;
      for (int u = first; u < last; ++u)
        if (out[u] > cell.strength) cell = {out[u], u, v};
    }
    add_row(v - kRadius, -1.0f);
    if ((v + 1) % cell_px == 0) flush();
  }
  flush();
}

}  // namespace stillpoint
