// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The policy sets: one type for each stage of `FrameFilter`.

#include <cstddef>

#include "stillpoint/cluster/flow_neighbours.hpp"
#include "stillpoint/cluster/region_clusters.hpp"
#include "stillpoint/cluster/surface_clusters.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/gate/mean_gate.hpp"
#include "stillpoint/gate/tail_gate.hpp"
#include "stillpoint/match/lucas_kanade.hpp"
#include "stillpoint/match/patch_matcher.hpp"
#include "stillpoint/memory/evidence_memory.hpp"
#include "stillpoint/memory/no_memory.hpp"
#include "stillpoint/motion/epipolar/epipolar_motion.hpp"
#include "stillpoint/motion/epipolar/monocular_motion.hpp"
#include "stillpoint/motion/rigid/rigid_motion.hpp"
#include "stillpoint/motion/rigid/support_motion.hpp"
#include "stillpoint/prior/box_prior.hpp"
#include "stillpoint/prior/foreground_prior.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "stillpoint/score/offset_score.hpp"
#include "stillpoint/score/reprojection_score.hpp"
#include "stillpoint/score/sampson_score.hpp"
#include "stillpoint/verdict/keep_floor.hpp"
#include "stillpoint/verdict/no_keep_floor.hpp"

namespace stillpoint {

/// The paper's method, faithful to each equation; its printed errors are options of the stages, off by default.
struct PaperPolicies {
  using Camera = stillpoint::Camera;
  using DepthNoise = AnyDepthNoise;
  using DepthLookup = RoundedDepth;
  using Prior = BoxPrior;
  using Matcher = LucasKanade;
  using EgoMotion = EpipolarMotion;
  using Scorer = OffsetScore;
  using Gate = MeanGate;
  using Classifier = RegionClusters;
  using Memory = NoMemory;
  using KeepFloor = NoKeepFloor;
  static constexpr std::size_t kHistoryLength = 1;  ///< frames that are remembered
};

/// The paper's method with a metric 3D-3D ego-motion in place of the epipolar one.
struct PaperRigidPolicies : PaperPolicies {
  using EgoMotion = RigidMotion;
};

/// What users get: every feature is tested against several older frames, the prior only shifts odds, evidence adds up
/// over time, and the tracker is never left without features.
struct DefaultPolicies {
  using Camera = stillpoint::Camera;
  using DepthNoise = AnyDepthNoise;
  using DepthLookup = GuardedDepth;
  using Prior = PropagatedPrior;
  using Matcher = PatchMatcher;
  using EgoMotion = SupportMotion;
  using Scorer = ReprojectionScore;
  using Gate = TailGate;
  using Classifier = SurfaceClusters;
  using Memory = EvidenceMemory;
  using KeepFloor = stillpoint::KeepFloor;
  static constexpr std::size_t kHistoryLength = 16;  ///< half a second at 30 Hz, 15 MB in 640 × 480
};

/// For one camera without depth. Verdicts are by epipolar geometry between neighbouring frames and add up over time:
/// what moves along its epipolar line is not found, unless a detector's box covers it. Nothing is in metres.
struct MonocularPolicies : DefaultPolicies {
  using DepthLookup = NoDepth;
  using Matcher = LucasKanade;
  using EgoMotion = MonocularMotion;
  using Scorer = SampsonScore;
  using Classifier = FlowNeighbours;
  static constexpr std::size_t kHistoryLength = 1;
};

}  // namespace stillpoint
