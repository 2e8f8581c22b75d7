// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a stage may offer on top of its contract: found by its form, used where it is there. docs/extending.md tells it
// in prose.

#include <type_traits>
#include <utility>

#include "stillpoint/core/frame_history.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/timings.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

// clang-format off

template <class P, class Camera, class Noise, class = void> struct looks_back : std::false_type {};
template <class P, class Camera, class Noise> struct looks_back<P, Camera, Noise, std::void_t<
    decltype(std::declval<P&>().survey(std::declval<const FrameHistory&>(), std::declval<const FrameView&>(),
    std::declval<const Pose&>(), std::declval<const Camera&>(), std::declval<const Noise&>(), std::declval<Matches&>(),
    std::declval<Workspace&>())),
    decltype(std::declval<P&>().look_back(std::declval<const FrameHistory&>(), std::declval<const FrameView&>(),
    std::declval<const Pose&>(), std::declval<const Camera&>(), std::declval<const Noise&>(),
    std::declval<Matches&>()))>> : std::true_type {};

template <class P, class Camera, class Noise, class = void> struct aligns : std::false_type {};
template <class P, class Camera, class Noise> struct aligns<P, Camera, Noise, std::void_t<decltype(std::declval<P&>().align(
    std::declval<const FrameView&>(), std::declval<const FrameView&>(), std::declval<const Pose&>(),
    std::declval<const Camera&>(), std::declval<const Noise&>()))>> : std::true_type {};

template <class P, class Camera, class = void> struct refines : std::false_type {};
template <class P, class Camera> struct refines<P, Camera, std::void_t<decltype(std::declval<P&>().refine(
    std::declval<Matches&>(), std::declval<const Regions&>(), std::declval<const Camera&>(),
    std::declval<const MotionPrior&>(), std::declval<Motion&>(), std::declval<Workspace&>()))>> : std::true_type {};

template <class P, class = void> struct recalls : std::false_type {};
template <class P> struct recalls<P, std::void_t<decltype(std::declval<P&>().recall(
    std::declval<Matches&>(), std::declval<Workspace&>()))>> : std::true_type {};

template <class P, class = void> struct learns : std::false_type {};
template <class P> struct learns<P, std::void_t<decltype(std::declval<P&>().learn(
    std::declval<const Matches&>(), std::declval<span<const Label>>()))>> : std::true_type {};

template <class P, class Camera, class = void> struct observes : std::false_type {};
template <class P, class Camera> struct observes<P, Camera, std::void_t<decltype(std::declval<P&>().observe(
    std::declval<const Matches&>(), std::declval<const Motion&>(), std::declval<const Camera&>()))>> : std::true_type {};

template <class P, class = void> struct resets : std::false_type {};
template <class P> struct resets<P, std::void_t<decltype(std::declval<P&>().reset())>> : std::true_type {};

// clang-format on

/// Before matching: a matcher may align the frames roughly.
/// @return current_from_reference: what is expected, where it does not
template <class Matcher, class Camera, class Noise>
Pose align(Matcher& matcher, const FrameView& reference, const FrameView& current, const MotionPrior& expected,
           const Camera& camera, const Noise& noise) {
  const Pose guess = expected.current_from_reference ? *expected.current_from_reference : Pose::Identity();
  if constexpr (aligns<Matcher, Camera, Noise>::value)
    return inverted(matcher.align(reference, current, inverted(guess), camera, noise));
  else
    return guess;
}

/// Before the motion: a matcher may survey older frames, and a memory may know features and surfaces; it fills their
/// trust.
/// @param stages  a `FrameFilter`
/// @param current_from_reference  roughly
template <class Stages>
void survey(Stages& stages, const FrameHistory& history, const FrameView& frame, const Pose& current_from_reference,
            Matches& matches, Workspace& workspace, Timings& timings) {
  using Memory = typename Stages::Memory;
  if constexpr (looks_back<typename Stages::Matcher, typename Stages::Camera, typename Stages::DepthNoise>::value) {
    Motion motion;
    motion.current_from_reference = current_from_reference;
    timings.run(Stage::match, [&] {
      stages.matcher.survey(history, frame, history.filter_from_current(motion), stages.camera, stages.depth_noise,
                            matches, workspace);
    });
  }
  if constexpr (recalls<Memory>::value) timings.run(Stage::memory, [&] { stages.memory.recall(matches, workspace); });
}

/// When the motion is known, be it usable or not: the prior may carry its regions along.
template <class Stages>
void observe(Stages& stages, const Matches& matches, const Motion& motion, Timings& timings) {
  if constexpr (observes<typename Stages::Prior, typename Stages::Camera>::value)
    timings.run(Stage::prior, [&] { stages.prior.observe(matches, motion, stages.camera); });
}

/// After the motion: the matcher looks for every feature in the older frames, and the motion may be refined by what is
/// seen there.
template <class Stages>
void look_back(Stages& stages, const FrameHistory& history, const FrameView& frame, const Regions& regions,
               const MotionPrior& expected, Matches& matches, Motion& motion, Workspace& workspace, Timings& timings) {
  using StageCamera = typename Stages::Camera;
  if constexpr (looks_back<typename Stages::Matcher, StageCamera, typename Stages::DepthNoise>::value) {
    timings.run(Stage::match, [&] {
      stages.matcher.look_back(history, frame, history.filter_from_current(motion), stages.camera, stages.depth_noise,
                               matches);
    });
    if constexpr (refines<typename Stages::EgoMotion, StageCamera>::value)
      timings.run(Stage::motion,
                  [&] { stages.ego_motion.refine(matches, regions, stages.camera, expected, motion, workspace); });
  }
}

/// A gate may learn from what is known to stand, between classifier and memory; a matcher from what moves, after it.
template <class Policy>
void learn(Policy& policy, const Matches& matches, span<const Label> labels) {
  if constexpr (learns<Policy>::value) policy.learn(matches, labels);
}

/// A prior or a gate may remember frames: these are forgotten with all others.
template <class Policy>
void reset_policy(Policy& policy) {
  if constexpr (resets<Policy>::value) policy.reset();
}

}  // namespace stillpoint
