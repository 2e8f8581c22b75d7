// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What has no depth: how likely does it move, by the features around it?   Clusters → log-odds, prior

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// The features with depth around one without; near ones weigh more, (1 − r² / reach²)².
struct Surroundings {
  bool any = false;
  float evidence = 0;       ///< mean of their clusters' scores above the threshold, nats
  float dynamic_share = 0;  ///< weighted share of those whose log-odds of this frame are above 0, 0 to 1

  /// @param grid      the features with depth that have a cluster
  /// @param evidence  one per feature: its cluster's score above the threshold, nats
  /// @param labels    with the log-odds of this frame
  static Surroundings of(const Vector2f& pixel, float reach_px, const PixelGrid& grid, span<const float> evidence,
                         span<const Label> labels) {
    const float reach_sq = reach_px * reach_px;
    float weights = 0;
    Surroundings sum;
    grid.within(pixel, reach_px, [&](std::size_t j, float squared) {
      const float near = 1 - squared / reach_sq, weight = near * near;
      weights += weight;
      sum.evidence += weight * evidence[j];
      if (labels[j].log_odds > 0) sum.dynamic_share += weight;
    });
    if (!(weights > 0)) return {};
    return {true, sum.evidence / weights, sum.dynamic_share / weights};
  }
};

/// How often is depth missing on dynamic features, compared with static ones? A sensor that loses depth at glass, metal
/// and in the shadow of its projector loses it on static surfaces; one that loses it at hair and dark cloth, or
/// anywhere, on people as well. Counted in every frame: features without depth whose surroundings are dynamic, or
/// static, against those with depth.
class DepthlessPrior {
 public:
  void add_with_depth(bool is_dynamic) noexcept { ++(is_dynamic ? dynamic_ : static_).with_depth; }

  /// One between both kinds counts as neither.
  void add_without_depth(const Surroundings& around) noexcept {
    constexpr float kSurrounded = 0.9f;
    if (!around.any) return;
    if (around.dynamic_share > kSurrounded) ++dynamic_.without_depth;
    if (around.dynamic_share < 1 - kSurrounded) ++static_.without_depth;
  }

  /// log P(no depth | dynamic) / P(no depth | static), nats, at most 0.
  float log_ratio() const noexcept {
    const float of_static = (static_.without_depth + 1) / (static_.with_depth + static_.without_depth + 2);
    const float usual = kUsualFeatures * of_static * std::exp(kUsual / kExcess);
    const float of_dynamic =
        (dynamic_.without_depth + usual) / (dynamic_.with_depth + dynamic_.without_depth + kUsualFeatures);
    return std::clamp(kExcess * std::log(of_dynamic / of_static), kLeast, 0.0f);
  }

 private:
  static constexpr float kUsual = -1.5f;          // where nothing moves that could be counted, nats
  static constexpr float kUsualFeatures = 20.0f;  // as many counted features weigh as much as that
  // Background beside a mover is surrounded by its features, too, so that the counted ratio is too near to 1. Of
  // 1, 1.5, 2 and 3 this one has the fewest errors over recordings with depth lost on movers and without
  // (docs/design/sweeps.md).
  static constexpr float kExcess = 1.5f;
  static constexpr float kLeast = -4.0f;  // nats: e^-4 of the static background's

  struct Count {
    float with_depth = 0, without_depth = 0;
  };
  Count static_, dynamic_;
};

}  // namespace stillpoint
