// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Non-maximum suppression: of boxes of one class that overlap much, the best is left.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// Intersection over union, 0 to 1; 0 if either box has no area. Boxes are finite.
inline float box_overlap(const RawDetection& a, const RawDetection& b) noexcept {
  const double width = static_cast<double>(std::min(a.right, b.right)) - static_cast<double>(std::max(a.left, b.left));
  const double height = static_cast<double>(std::min(a.bottom, b.bottom)) - static_cast<double>(std::max(a.top, b.top));
  if (!(width > 0 && height > 0)) return 0;
  const auto area = [](const RawDetection& box) {
    return (static_cast<double>(box.right) - static_cast<double>(box.left)) *
           (static_cast<double>(box.bottom) - static_cast<double>(box.top));
  };
  const double both = width * height;
  return static_cast<float>(both / (area(a) + area(b) - both));
}

/// Greedy: the best box of a class stays, drops what overlaps it more than `highest_overlap`, then the best of the
/// rest. What stays is in the order of labels, the best of each first; among equal scores the one that came first is
/// better.
inline void drop_duplicates(std::vector<RawDetection>& found, float highest_overlap) {
  std::stable_sort(found.begin(), found.end(), [](const RawDetection& a, const RawDetection& b) {
    return a.label != b.label ? a.label < b.label : a.score > b.score;
  });
  std::size_t kept = 0, first_of_class = 0;
  for (RawDetection& box : found) {
    if (kept > 0 && found[kept - 1].label != box.label) first_of_class = kept;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(kept);
    const bool stays =
        std::all_of(found.begin() + static_cast<std::ptrdiff_t>(first_of_class), end,
                    [&](const RawDetection& better) { return box_overlap(better, box) <= highest_overlap; });
    if (!stays) continue;
    if (&found[kept] != &box) found[kept] = std::move(box);
    ++kept;
  }
  found.erase(found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
}

}  // namespace stillpoint
