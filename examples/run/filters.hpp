// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter that the options ask for, set as they say.

#include <type_traits>
#include <utility>
#include <vector>

#include "../backends/oracle_filter.hpp"
#include "frame_source.hpp"
#include "options.hpp"
#include "stillpoint/core/depth_noise.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint_run {

namespace detail {

inline stillpoint::AnyDepthNoise depth_noise(const Options& options, const stillpoint::Camera& camera) {
  if (options.depth_noise == "stereo") {
    stillpoint::StereoNoise stereo;
    stereo.focal_px = camera.fx();
    return {stereo};
  }
  if (options.depth_noise == "tof") return {stillpoint::TimeOfFlightNoise{}};
  return {stillpoint::KinectNoise{}};
}

template <class Policies>
stillpoint::FrameFilter<Policies> paper_filter(const Options& options, const stillpoint::Camera& camera) {
  stillpoint::FrameFilter<Policies> filter(camera);
  filter.depth_noise = depth_noise(options, camera);
  filter.scorer.options.printed_eq8 = options.prints_error("eq8");
  if constexpr (std::is_same_v<typename Policies::EgoMotion, stillpoint::EpipolarMotion>) {
    filter.ego_motion.options.printed_eq3 = options.prints_error("eq3");
    filter.ego_motion.options.unit_translation = options.prints_error("unit-t");
  }
  filter.ego_motion.options.seed = options.seed;
  filter.classifier.options.seed = options.seed;
  return filter;
}

}  // namespace detail

/// Calls `use(filter)` with the filter that the options name. A further policy set is a further line.
template <class Use>
decltype(auto) with_filter(const Options& options, const stillpoint::Camera& camera, Use&& use) {
  using stillpoint::PaperPolicies;
  using stillpoint::PaperRigidPolicies;
  if (options.prior == "labels") return use(examples::OracleFilter{});
  if (options.ego_motion == "rigid") return use(detail::paper_filter<PaperRigidPolicies>(options, camera));
  return use(detail::paper_filter<PaperPolicies>(options, camera));
}

/// Tells a filter what is known of the coming frame before it looks.
template <class Policies>
void prepare(stillpoint::FrameFilter<Policies>& filter, const SourceFrame&,
             const std::vector<stillpoint::Detection>& detections) {
  filter.prior.detections = detections;
}
inline void prepare(examples::OracleFilter& filter, const SourceFrame& frame,
                    const std::vector<stillpoint::Detection>&) {
  filter.labels = frame.labels;
}

}  // namespace stillpoint_run
