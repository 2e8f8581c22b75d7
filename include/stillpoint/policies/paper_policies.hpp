// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// PaperPolicies and PaperRigidPolicies: the stages of the paper's method.

#include <cstddef>

#include "stillpoint/cluster/region_clusters.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/gate/mean_gate.hpp"
#include "stillpoint/match/lucas_kanade.hpp"
#include "stillpoint/memory/no_memory.hpp"
#include "stillpoint/motion/epipolar/epipolar_motion.hpp"
#include "stillpoint/motion/rigid/rigid_motion.hpp"
#include "stillpoint/prior/box_prior.hpp"
#include "stillpoint/score/offset_score.hpp"
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

}  // namespace stillpoint
