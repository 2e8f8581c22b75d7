// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// DefaultPolicies: the stages of `FrameFilter<>`, and nothing of the other sets.

#include <cstddef>

#include "stillpoint/cluster/surface_clusters.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/depth/depth_registration.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/depth/temporal_hole_filling.hpp"
#include "stillpoint/gate/tail_gate.hpp"
#include "stillpoint/match/patch_matcher.hpp"
#include "stillpoint/memory/evidence_memory.hpp"
#include "stillpoint/motion/rigid/support_motion.hpp"
#include "stillpoint/movers/no_movers.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "stillpoint/score/reprojection_score.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint {

/// What users get: every feature is tested against several older frames, the prior only shifts odds, evidence adds up
/// over time, and the tracker is never left without features.
struct DefaultPolicies {
  using Camera = stillpoint::Camera;
  using DepthNoise = AnyDepthNoise;
  using DepthLookup = GuardedDepth;
  using DepthRegistration = stillpoint::DepthRegistration;
  using HoleFilling = TemporalHoleFilling;
  using Prior = PropagatedPrior;
  using Matcher = PatchMatcher;
  using EgoMotion = SupportMotion;
  using Scorer = ReprojectionScore;
  using Gate = TailGate;
  using Classifier = SurfaceClusters;
  using Memory = EvidenceMemory;
  using KeepFloor = stillpoint::KeepFloor;
  using Movers = NoMovers;
  static constexpr std::size_t kHistoryLength = 16;  ///< half a second at 30 Hz, 15 MB in 640 × 480
};

}  // namespace stillpoint
