// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A policy set that keeps every contract without OpenCV. Each file beside this one makes one mistake in it.

#include <vector>

#include "stillpoint/cluster/region_clusters.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/gate/mean_gate.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/memory/no_memory.hpp"
#include "stillpoint/prior/box_prior.hpp"
#include "stillpoint/score/offset_score.hpp"
#include "stillpoint/verdict/no_keep_floor.hpp"

/// The camera stands on a tripod.
struct NoEgoMotion {
  template <class Camera>
  stillpoint::Motion estimate(const stillpoint::Observations&, const Camera&, const stillpoint::MotionPrior&,
                              stillpoint::Workspace&) const {
    stillpoint::Motion motion;
    motion.status = stillpoint::Status::ok;
    return motion;
  }
};

struct SoundPolicies {
  using Camera = stillpoint::Camera;
  using DepthNoise = stillpoint::AnyDepthNoise;
  using DepthLookup = stillpoint::RoundedDepth;
  using Prior = stillpoint::BoxPrior;
  using Matcher = stillpoint::ProvidedMatches;
  using EgoMotion = NoEgoMotion;
  using Scorer = stillpoint::OffsetScore;
  using Gate = stillpoint::MeanGate;
  using Classifier = stillpoint::RegionClusters;
  using Memory = stillpoint::NoMemory;
  using KeepFloor = stillpoint::NoKeepFloor;
  static constexpr std::size_t kHistoryLength = 1;
};

/// What a host writes.
template <class Policies>
void use(const typename Policies::Camera& camera) {
  stillpoint::FrameFilter<Policies> filter(camera);
  filter.filter_frame(stillpoint::FrameView(), std::vector<stillpoint::Vector2f>(3));
  filter.reset();
}
