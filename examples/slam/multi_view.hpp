// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Improved multi-view geometry over a window of keyframes (Section 3.5): bundle adjustment and the removal of what
// deviates from the structure, in turn, until nothing more deviates.

#include <cstddef>
#include <vector>

#include "bundle_adjustment.hpp"
#include "frame.hpp"
#include "map.hpp"
#include "stillpoint/core/span.hpp"

namespace examples::slam {

using stillpoint::span;

class MultiView {
 public:
  struct Options {
    std::size_t window_keyframes = 20;
    int fewest_shared = 15;      ///< points by which a keyframe belongs to the window of the newest
    int rounds = 3;              ///< of adjustment and removal, at most
    int iterations = 5;          ///< of each adjustment
    double few_changes = 0.002;  ///< share of the measurements by which removal may change for it to have converged
    bool adjusts = true;         ///< false: only what deviates is removed
  };
  Options options;

  MultiView(Camera camera, const MeasurementNoise& noise) : camera_(std::move(camera)), noise_(noise) {}

  /// The newest keyframe's window: what is adjusted, and the keyframes outside that hold it in place.
  BundleProblem gather(KeyframeId newest, const Map& map) const;
  /// The whole map; its first keyframe stays.
  BundleProblem gather_all(const Map& map) const;
  /// Adjusts and leaves out what deviates, until nothing more does. Needs no map: it may take its time.
  void converge(BundleProblem& problem) const;
  /// Puts the result into the map: poses, points, and what deviates is removed.
  void apply(const BundleProblem& problem, Map& map) const;

 private:
  void add_measurements(BundleProblem& problem, const Map& map, span<const PointId> points) const;
  std::size_t leave_out_what_deviates(BundleProblem& problem) const;

  Camera camera_;
  MeasurementNoise noise_;
};

}  // namespace examples::slam
