// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// MonocularPolicies: the stages for one camera without depth.

#include <cstddef>

#include "stillpoint/cluster/flow_neighbours.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/match/lucas_kanade.hpp"
#include "stillpoint/motion/epipolar/monocular_motion.hpp"
#include "stillpoint/policies/default_policies.hpp"
#include "stillpoint/score/sampson_score.hpp"

namespace stillpoint {

/// For one camera without depth. Verdicts are by epipolar geometry between neighbouring frames and add up over time:
/// a feature that moves along its epipolar line is not found, unless a detector's box covers it. Nothing is in metres.
struct MonocularPolicies : DefaultPolicies {
  using DepthLookup = NoDepth;
  using Matcher = LucasKanade;
  using EgoMotion = MonocularMotion;
  using Scorer = SampsonScore;
  using Classifier = FlowNeighbours;
  static constexpr std::size_t kHistoryLength = 1;
};

}  // namespace stillpoint
