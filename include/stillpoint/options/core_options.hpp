// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of what the core does itself, by name; the form is told in stage_options.hpp.

#include <cstddef>
#include <variant>

#include "stillpoint/core/depth_noise.hpp"
#include "stillpoint/core/frame_check.hpp"
#include "stillpoint/core/mask_prediction.hpp"

namespace stillpoint {

template <class Visit>
void each_option(FrameCheck& stage, Visit& visit) {
  visit.positive("longest_gap_s", stage.options.longest_gap_s);
}

/// The model's own parameters stand beside its name.
template <class Visit>
void each_option(AnyDepthNoise& noise, Visit& visit) {
  std::size_t model = noise.model.index();
  visit.choice("model", model, "kinect", "stereo", "tof");
  if (model != noise.model.index()) {
    if (model == 0) noise.model = KinectNoise{};
    if (model == 1) noise.model = StereoNoise{};
    if (model == 2) noise.model = TimeOfFlightNoise{};
  }
  if (auto* const stereo = std::get_if<StereoNoise>(&noise.model)) {
    visit.positive("focal_px", stereo->focal_px);
    visit.positive("baseline_m", stereo->baseline_m);
    visit.positive("disparity_sigma_px", stereo->disparity_sigma_px);
  }
  if (auto* const tof = std::get_if<TimeOfFlightNoise>(&noise.model)) {
    visit("constant_m", tof->constant_m);
    visit("per_metre", tof->per_metre);
  }
  visit.positive("scale", noise.scale);
}

template <class Visit>
void each_option(MaskPrediction& stage, Visit& visit) {
  visit("reach_px", stage.options.reach_px);
}

}  // namespace stillpoint
