// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move, when there is no depth?   Epipolar geometry without a scale.

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/motion/epipolar/epipolar_motion.hpp"

namespace stillpoint {

/// `EpipolarMotion` that claims no metres (`Motion::metric` is false) and leaves out features of a low static prior.
class MonocularMotion : public EpipolarMotion {
 public:
  using Needs = Capabilities<capability::matches>;
  using Provides = Capabilities<capability::subpixel_motion>;

  MonocularMotion() {
    options.unit_translation = true;
    options.least_static_prior = 0.5f;
    options.threshold_px = 0.5;
    options.min_inlier_share = 0.5;  // of what lies in no box: fewer are no world, and the frame is kept as it is
  }
};

}  // namespace stillpoint
