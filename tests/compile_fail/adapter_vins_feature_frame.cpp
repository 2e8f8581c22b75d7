// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A feature frame without an order, which one walk could not erase from.
// expected: stillpoint: a VINS feature frame must be a std::map from id to observations; see adapters/vins.hpp

#include <map>
#include <set>
#include <unordered_map>

#include "stillpoint/adapters/vins.hpp"

#ifdef STILLPOINT_MISTAKE
using FeatureFrame = std::unordered_map<int, double>;
#else
using FeatureFrame = std::map<int, double>;
#endif

std::size_t use(const std::set<int>& dropped, FeatureFrame& frame) {
  return stillpoint::vins::erase_features(dropped, frame);
}
