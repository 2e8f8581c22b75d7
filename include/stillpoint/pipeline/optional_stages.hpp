// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a stage may offer on top of its contract: found by its form, used where it is there. docs/extending.md tells it
// in prose.

#include <cstdint>
#include <type_traits>
#include <utility>

#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

// clang-format off

template <class P, class Camera, class Noise, class = void> struct reprojects_into_past : std::false_type {};
template <class P, class Camera, class Noise> struct reprojects_into_past<P, Camera, Noise, std::void_t<
    decltype(std::declval<P&>().choose_keyframes(std::declval<const FrameHistory&>(), std::declval<const FrameView&>(),
    std::declval<const Pose&>(), std::declval<const Camera&>(), std::declval<const Noise&>(), std::declval<Matches&>(),
    std::declval<Workspace&>())),
    decltype(std::declval<P&>().reproject_into_past(std::declval<const FrameHistory&>(), std::declval<const FrameView&>(),
    std::declval<const Pose&>(), std::declval<const Camera&>(), std::declval<const Noise&>(),
    std::declval<Observations&>()))>> : std::true_type {};

template <class P, class Camera, class Noise, class = void> struct aligns : std::false_type {};
template <class P, class Camera, class Noise> struct aligns<P, Camera, Noise, std::void_t<decltype(std::declval<P&>().align(
    std::declval<const FrameView&>(), std::declval<const FrameView&>(), std::declval<const Pose&>(),
    std::declval<const Camera&>(), std::declval<const Noise&>()))>> : std::true_type {};

template <class P, class Noise, class = void> struct fills_along_flow : std::false_type {};
template <class P, class Noise> struct fills_along_flow<P, Noise, std::void_t<
    decltype(static_cast<DepthView>(std::declval<P&>().fill_along_flow(std::declval<const FrameView&>(),
    std::declval<const FrameView&>(), std::declval<const Matches&>(), std::declval<const Noise&>(),
    std::declval<Workspace&>())))>> : std::true_type {};

template <class P, class = void> struct undoes_along_flow : std::false_type {};
template <class P> struct undoes_along_flow<P, std::void_t<
    decltype(static_cast<DepthView>(std::declval<P&>().undo_along_flow(std::declval<const FrameView&>(),
    std::declval<const FrameView&>(), std::declval<const Matches&>(), std::declval<Workspace&>())))>> : std::true_type {};

template <class P, class Camera, class = void> struct contradicts : std::false_type {};
template <class P, class Camera> struct contradicts<P, Camera, std::void_t<decltype(static_cast<bool>(
    std::declval<const P&>().contradicts(std::declval<const Pose&>(), std::declval<const Camera&>())))>> : std::true_type {};

template <class P, class Camera, class = void> struct refines : std::false_type {};
template <class P, class Camera> struct refines<P, Camera, std::void_t<decltype(std::declval<P&>().refine(
    std::declval<Observations&>(), std::declval<const Camera&>(), std::declval<const MotionPrior&>(),
    std::declval<Motion&>(), std::declval<Workspace&>()))>> : std::true_type {};

template <class P, class = void> struct recalls : std::false_type {};
template <class P> struct recalls<P, std::void_t<decltype(std::declval<P&>().recall(
    std::declval<const Matches&>(), std::declval<Remembered&>(), std::declval<Workspace&>()))>> : std::true_type {};

template <class P, class = void> struct learns : std::false_type {};
template <class P> struct learns<P, std::void_t<decltype(std::declval<P&>().learn(
    std::declval<const Observations&>(), std::declval<span<const Label>>()))>> : std::true_type {};

template <class P, class Camera, class = void> struct observes : std::false_type {};
template <class P, class Camera> struct observes<P, Camera, std::void_t<decltype(std::declval<P&>().observe(
    std::declval<const Observations&>(), std::declval<const Motion&>(), std::declval<const Camera&>()))>> : std::true_type {};

template <class P, class = void> struct expects_dynamic : std::false_type {};
template <class P> struct expects_dynamic<P, std::void_t<decltype(std::declval<P&>().expect_dynamic(
    std::declval<span<const std::uint8_t>>()))>> : std::true_type {};

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

/// After matching: a filling of holes may take depth along the flow of the corners.
/// @return the depth image of `frame`, its holes filled
template <class HoleFilling, class Noise>
DepthView fill_along_flow([[maybe_unused]] HoleFilling& hole_filling, [[maybe_unused]] const FrameView& reference,
                          const FrameView& frame, [[maybe_unused]] const Matches& matches,
                          [[maybe_unused]] const Noise& noise, [[maybe_unused]] Workspace& workspace) {
  if constexpr (fills_along_flow<HoleFilling, Noise>::value)
    return hole_filling.fill_along_flow(reference, frame, matches, noise, workspace);
  else
    return frame.depth;
}

/// After matching: a delay of depth may be undone along the flow of the corners.
/// @param as_it_came  the frame that `undo` was given, `frame` with what it returned, its holes filled
/// @return the depth image of `frame`, of the image's time
template <class DepthRegistration>
DepthView undo_along_flow([[maybe_unused]] DepthRegistration& depth_registration,
                          [[maybe_unused]] const FrameView& as_it_came, const FrameView& frame,
                          [[maybe_unused]] const Matches& matches, [[maybe_unused]] Workspace& workspace) {
  if constexpr (undoes_along_flow<DepthRegistration>::value)
    return depth_registration.undo_along_flow(as_it_came, frame, matches, workspace);
  else
    return frame.depth;
}

/// Before the motion: a matcher may choose older frames, and say what came within the past seconds.
/// @param current_from_reference  roughly
template <class Matcher, class Camera, class Noise>
void choose_keyframes([[maybe_unused]] Matcher& matcher, [[maybe_unused]] const FrameHistory& history,
                      [[maybe_unused]] const FrameView& frame, [[maybe_unused]] const Pose& current_from_reference,
                      [[maybe_unused]] const Camera& camera, [[maybe_unused]] const Noise& noise,
                      [[maybe_unused]] Matches& matches, [[maybe_unused]] Workspace& workspace) {
  if constexpr (reprojects_into_past<Matcher, Camera, Noise>::value) {
    Motion roughly;
    roughly.current_from_reference = current_from_reference;
    matcher.choose_keyframes(history, frame, history.filter_from_current(roughly), camera, noise, matches, workspace);
  }
}

/// After the host's tracking: a memory may take what the host's map says of the last frame's keypoints.
template <class Memory>
void expect_dynamic([[maybe_unused]] Memory& memory, [[maybe_unused]] span<const std::uint8_t> is_dynamic) {
  if constexpr (expects_dynamic<Memory>::value) memory.expect_dynamic(is_dynamic);
}

/// Before the motion: a memory may know features and surfaces.
template <class Memory>
void recall([[maybe_unused]] Memory& memory, const Matches& matches, Remembered& remembered,
            [[maybe_unused]] Workspace& workspace) {
  remembered.begin(matches);
  if constexpr (recalls<Memory>::value) memory.recall(matches, remembered, workspace);
}

/// After the motion: where it is in doubt, a matcher that sees the whole frames may contradict it.
template <class Matcher, class Camera>
void refuse_if_contradicted([[maybe_unused]] const Matcher& matcher, [[maybe_unused]] const Camera& camera,
                            [[maybe_unused]] Motion& motion) {
  if constexpr (contradicts<Matcher, Camera>::value) {
    if (!motion.usable() || !motion.doubtful) return;
    if (matcher.contradicts(inverted(motion.current_from_reference), camera)) motion.refuse(Status::no_consensus);
  }
}

/// When the motion is known, be it usable or not: the prior may carry its regions along.
template <class Prior, class Camera>
void observe([[maybe_unused]] Prior& prior, [[maybe_unused]] const Observations& observations,
             [[maybe_unused]] const Motion& motion, [[maybe_unused]] const Camera& camera) {
  if constexpr (observes<Prior, Camera>::value) prior.observe(observations, motion, camera);
}

/// After the motion: the matcher may look for every feature in the older frames.
template <class Matcher, class Camera, class Noise>
void reproject_into_past([[maybe_unused]] Matcher& matcher, [[maybe_unused]] const FrameHistory& history,
                         [[maybe_unused]] const FrameView& frame, [[maybe_unused]] const Motion& motion,
                         [[maybe_unused]] const Camera& camera, [[maybe_unused]] const Noise& noise,
                         [[maybe_unused]] Observations& observations) {
  if constexpr (reprojects_into_past<Matcher, Camera, Noise>::value)
    matcher.reproject_into_past(history, frame, history.filter_from_current(motion), camera, noise, observations);
}

/// And the motion may be refined by what was seen there.
template <class EgoMotion, class Camera>
void refine([[maybe_unused]] EgoMotion& ego_motion, [[maybe_unused]] Observations& observations,
            [[maybe_unused]] const Camera& camera, [[maybe_unused]] const MotionPrior& expected,
            [[maybe_unused]] Motion& motion, [[maybe_unused]] Workspace& workspace) {
  if constexpr (refines<EgoMotion, Camera>::value)
    if (!observations.matches.past_observations.frames().empty())
      ego_motion.refine(observations, camera, expected, motion, workspace);
}

/// A gate may learn from static features, between classifier and memory; a matcher from dynamic ones, after it.
template <class Policy>
void learn(Policy& policy, const Observations& observations, span<const Label> labels) {
  if constexpr (learns<Policy>::value) policy.learn(observations, labels);
}

/// A prior or a gate may remember frames: these are forgotten with all others.
template <class Policy>
void reset_policy(Policy& policy) {
  if constexpr (resets<Policy>::value) policy.reset();
}

}  // namespace stillpoint
