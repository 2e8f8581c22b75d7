// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter that the options ask for, set as they say.

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "../backends/oracle_filter.hpp"
#include "frame_source.hpp"
#include "options.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/detectors/async_detector.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/policies.hpp"
#include "switch_off.hpp"
#include "switched_movers.hpp"
#include "watched_prior.hpp"

namespace stillpoint_run {

namespace detail {

inline stillpoint::AnyDepthNoise depth_noise(const Options& options, const FrameSource& source) {
  if (options.depth_noise == "stereo") {
    stillpoint::StereoNoise stereo;
    stereo.focal_px = source.camera().fx();
    return source.stereo_noise().value_or(stereo);
  }
  if (options.depth_noise == "tof") return stillpoint::TimeOfFlightNoise{};
  return stillpoint::KinectNoise{};
}

/// A filter set as the command line has it, then by the file of options, then by what the command line says expressly.
/// @param set  called as set(filter, says): applies the values of those arguments for which says("--name") is true
template <class Policies, class Set>
stillpoint::FrameFilter<Policies> make_filter(const Options& options, const stillpoint::Camera& camera,
                                              const Set& set) {
  stillpoint::FrameFilter<Policies> filter(camera);
  set(filter, [](std::string_view) { return true; });
  if (options.stages.empty()) return filter;
  stillpoint::read_options(options.stages, filter);
  set(filter, [&options](std::string_view name) { return options.is_given(name); });
  return filter;
}

template <class Policies>
stillpoint::FrameFilter<Policies> paper_filter(const Options& options, const FrameSource& source) {
  return make_filter<Policies>(options, source.camera(), [&](auto& filter, const auto& says) {
    if (says("--depth-noise")) filter.depth_noise = depth_noise(options, source);
    if (says("--seed")) filter.ego_motion.options.seed = filter.classifier.options.seed = options.seed;
    if (!says("--paper-as-printed")) return;
    filter.scorer.options.printed_eq8 = options.prints_error("eq8");
    if constexpr (std::is_same_v<typename Policies::EgoMotion, stillpoint::EpipolarMotion>) {
      filter.ego_motion.options.printed_eq3 = options.prints_error("eq3");
      filter.ego_motion.options.unit_translation = options.prints_error("unit-t");
    }
  });
}

inline SwitchedMotion::Kind motion_kind(const std::string& name) {
  return name == "rigid"      ? SwitchedMotion::Kind::rigid
         : name == "epipolar" ? SwitchedMotion::Kind::epipolar
                              : SwitchedMotion::Kind::support;
}

template <class Policies>
stillpoint::FrameFilter<Policies> default_filter(const Options& options, const FrameSource& source) {
  auto filter = make_filter<Policies>(options, source.camera(), [&](auto& set, const auto& says) {
    if (says("--depth-noise")) set.depth_noise = depth_noise(options, source);
    if (says("--false-positive-rate")) set.gate.options.false_positive_rate = options.false_positive_rate;
    if (says("--seed")) support_motion(set.ego_motion).options.seed = options.seed;
  });
  if constexpr (std::is_base_of_v<WithSwitchedMovers, Policies>) {
    filter.ego_motion.kind = motion_kind(options.ego_motion);
    filter.ego_motion.rigid.options.seed = filter.ego_motion.epipolar.options.seed = options.seed;
    filter.movers.tracking.is_enabled = options.has_movers();
  }
  switch_off(options.without, filter);
  return filter;
}

template <class Policies>
stillpoint::FrameFilter<Policies> monocular_filter(const Options& options, const FrameSource& source) {
  return make_filter<Policies>(options, source.camera(), [&](auto& set, const auto& says) {
    if (says("--false-positive-rate")) set.gate.options.false_positive_rate = options.false_positive_rate;
    if (says("--seed")) set.ego_motion.options.seed = options.seed;
  });
}

}  // namespace detail

/// Calls `use(filter)` with the filter that the options name. A further policy set is a further line.
template <class Use>
decltype(auto) with_filter(const Options& options, const FrameSource& source, Use&& use) {
  using stillpoint::DefaultPolicies;
  using stillpoint::PaperPolicies;
  using stillpoint::PaperRigidPolicies;
  if (options.prior == "labels") return use(examples::OracleFilter{});
  if (options.policies == "default") return use(detail::default_filter<Watched<WithSwitchedMovers>>(options, source));
  if (options.policies == "monocular")
    return use(detail::monocular_filter<Watched<stillpoint::MonocularPolicies>>(options, source));
  if (options.ego_motion == "rigid") return use(detail::paper_filter<Watched<PaperRigidPolicies>>(options, source));
  return use(detail::paper_filter<Watched<PaperPolicies>>(options, source));
}

/// Tells a filter what is known of the coming frame before it looks.
/// @param answer  of the detector; one that is there and empty says that it saw nothing
template <class Policies>
void prepare(stillpoint::FrameFilter<Policies>& filter, const SourceFrame& frame,
             const std::optional<stillpoint::DetectorAnswer>& answer) {
  filter.prior.prepare(frame.timestamp_s, answer ? &*answer : nullptr);
}
inline void prepare(examples::OracleFilter& filter, const SourceFrame& frame,
                    const std::optional<stillpoint::DetectorAnswer>&) {
  filter.labels = frame.labels;
}

}  // namespace stillpoint_run
