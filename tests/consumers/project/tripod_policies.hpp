// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Policies of a host that stands on a tripod and tracks its features itself. No OpenCV.

#include <stillpoint/cluster/region_clusters.hpp>
#include <stillpoint/depth/depth_noise.hpp>
#include <stillpoint/filter_frame.hpp>
#include <stillpoint/gate/mean_gate.hpp>
#include <stillpoint/match/provided_matches.hpp>
#include <stillpoint/memory/no_memory.hpp>
#include <stillpoint/prior/box_prior.hpp>
#include <stillpoint/score/offset_score.hpp>
#include <stillpoint/verdict/no_keep_floor.hpp>
#include <stillpoint/version.hpp>

struct Tripod {
  stillpoint::Motion estimate(const stillpoint::Observations&, const stillpoint::Camera&,
                              const stillpoint::MotionPrior&, stillpoint::Workspace&) const {
    stillpoint::Motion motion;
    motion.status = stillpoint::Status::ok;
    return motion;
  }
};

struct TripodPolicies {
  using Camera = stillpoint::Camera;
  using DepthNoise = stillpoint::AnyDepthNoise;
  using DepthLookup = stillpoint::RoundedDepth;
  using Prior = stillpoint::BoxPrior;
  using Matcher = stillpoint::ProvidedMatches;
  using EgoMotion = Tripod;
  using Scorer = stillpoint::OffsetScore;
  using Gate = stillpoint::MeanGate;
  using Classifier = stillpoint::RegionClusters;
  using Memory = stillpoint::NoMemory;
  using KeepFloor = stillpoint::NoKeepFloor;
  static constexpr std::size_t kHistoryLength = 1;
};
