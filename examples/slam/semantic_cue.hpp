// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Do two places show the same objects? Rooms have many desks; the objects on them tell one from the other.

#include <algorithm>
#include <map>
#include <utility>

#include "frame.hpp"
#include "stillpoint/core/span.hpp"

namespace examples::slam {

/// How alike two lists of objects are: the intersection of histograms over class and third of the image's width, in
/// which an object in the neighbouring third counts half. People and cars are no part of a place: leave them out.
/// @return `least` for nothing in common to 1 for the same; 1 where one of them shows nothing at all
inline double semantic_similarity(stillpoint::span<const SeenObject> a, stillpoint::span<const SeenObject> b,
                                  double least = 0.2) {
  if (a.empty() || b.empty()) return 1.0;
  const auto histogram = [](stillpoint::span<const SeenObject> objects) {
    constexpr int kThirds = 3;
    std::map<std::pair<int, int>, double> bins;
    for (const SeenObject& object : objects)
      bins[{object.class_index, std::clamp(static_cast<int>(object.u * kThirds), 0, kThirds - 1)}] += 1.0;
    return bins;
  };
  auto of_a = histogram(a), of_b = histogram(b);
  double common = 0.0;
  const auto intersect = [&](int shift, double counts) {
    for (auto& [bin, left] : of_a) {
      const auto other = of_b.find({bin.first, bin.second + shift});
      if (other == of_b.end()) continue;
      const double both = std::min(left, other->second);
      left -= both;
      other->second -= both;
      common += counts * both;
    }
  };
  intersect(0, 1.0);
  intersect(-1, 0.5);
  intersect(1, 0.5);
  const double share = common / static_cast<double>(std::max(a.size(), b.size()));
  return least + (1.0 - least) * share;
}

}  // namespace examples::slam
