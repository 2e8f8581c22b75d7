// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Do the stages of a policy set go together?   A pair that does not is one compiler error: its text says what is
// missing, and the line "in instantiation of" before it names both types.

#include <cstddef>
#include <type_traits>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint {

namespace detail {

// has_NAME<T>: does a class have any member of that name, of whatever form? It has where the name is ambiguous in a
// class that inherits from it and from one with such a member. A final class can't be asked: no.
#define STILLPOINT_HAS_NAME(NAME)                                                                   \
  struct Named_##NAME {                                                                             \
    int NAME;                                                                                       \
  };                                                                                                \
  template <class T>                                                                                \
  struct Both_##NAME : T, Named_##NAME {};                                                          \
  template <class T, class = void>                                                                  \
  struct is_ambiguous_##NAME : std::true_type {};                                                   \
  template <class T>                                                                                \
  struct is_ambiguous_##NAME<T, std::void_t<decltype(&Both_##NAME<T>::NAME)>> : std::false_type {}; \
  template <class T, bool = std::is_class_v<T> && !std::is_final_v<T>>                              \
  struct has_##NAME : is_ambiguous_##NAME<T> {};                                                    \
  template <class T>                                                                                \
  struct has_##NAME<T, false> : std::false_type {}

STILLPOINT_HAS_NAME(align);
STILLPOINT_HAS_NAME(contradicts);
STILLPOINT_HAS_NAME(choose_keyframes);
STILLPOINT_HAS_NAME(reproject_into_past);
STILLPOINT_HAS_NAME(refine);
STILLPOINT_HAS_NAME(recall);
STILLPOINT_HAS_NAME(learn);
STILLPOINT_HAS_NAME(expect_dynamic);
STILLPOINT_HAS_NAME(observe);
STILLPOINT_HAS_NAME(survey);
STILLPOINT_HAS_NAME(look_back);
STILLPOINT_HAS_NAME(fill_along_flow);
STILLPOINT_HAS_NAME(undo_along_flow);
STILLPOINT_HAS_NAME(reset);
#undef STILLPOINT_HAS_NAME

}  // namespace detail

// clang-format off

/// One stage needs something of another. Which two it is about stands in the compiler's line before the text.
template <class Stage, class OfStage, class Tag>
struct Need {};

template <class Stage, class DepthLookup>
constexpr bool is_met(Need<Stage, DepthLookup, capability::metric_depth>) {
  static_assert(meets<Stage, DepthLookup, capability::metric_depth>,
      "stillpoint: this Stage needs depths in metres, which this DepthLookup does not give: take RoundedDepth or "
      "GuardedDepth, or for one camera without depth inherit from MonocularPolicies; see docs/extending.md");
  return true;
}

template <class Stage, class Prior>
constexpr bool is_met(Need<Stage, Prior, capability::whole_boxes>) {
  static_assert(meets<Stage, Prior, capability::whole_boxes>,
      "stillpoint: this Stage tests only what lies in boxes, and this Prior cuts them by depth, so that half of a person "
      "would be missed: take BoxPrior, or SurfaceClusters; see docs/extending.md");
  return true;
}

template <class Stage, class Matcher>
constexpr bool is_met(Need<Stage, Matcher, capability::matches>) {
  static_assert(meets<Stage, Matcher, capability::matches>,
      "stillpoint: this Stage needs matches with the reference frame, which this Matcher does not give: take "
      "PatchMatcher, LucasKanade or ProvidedMatches; see docs/extending.md");
  return true;
}

template <class Stage, class Matcher>
constexpr bool is_met(Need<Stage, Matcher, capability::feature_matches>) {
  static_assert(meets<Stage, Matcher, capability::feature_matches>,
      "stillpoint: this Stage needs matches of the host's features with the reference frame, which this Matcher does not "
      "give: take LucasKanade or ProvidedMatches, or a stage of DefaultPolicies; see docs/extending.md");
  return true;
}

template <class Stage, class Matcher>
constexpr bool is_met(Need<Stage, Matcher, capability::past_observations>) {
  static_assert(meets<Stage, Matcher, capability::past_observations>,
      "stillpoint: this Stage needs the features in older frames, where this Matcher does not look: take PatchMatcher or "
      "ProvidedMatches, or a stage that needs two frames (OffsetScore, SampsonScore); see docs/extending.md");
  return true;
}

template <class Stage, class EgoMotion>
constexpr bool is_met(Need<Stage, EgoMotion, capability::metric_motion>) {
  static_assert(meets<Stage, EgoMotion, capability::metric_motion>,
      "stillpoint: this Stage needs a motion in metres, which this EgoMotion does not give: take SupportMotion, "
      "RigidMotion or EpipolarMotion, or SampsonScore; see docs/extending.md");
  return true;
}

template <class Stage, class EgoMotion>
constexpr bool is_met(Need<Stage, EgoMotion, capability::subpixel_motion>) {
  static_assert(meets<Stage, EgoMotion, capability::subpixel_motion>,
      "stillpoint: this Stage compares fractions of a pixel, and this EgoMotion is fitted to points in space, whose noise "
      "hides who walks: take MonocularMotion, EpipolarMotion or SupportMotion, or another score; see docs/extending.md");
  return true;
}

template <class Stage, class Scorer>
constexpr bool is_met(Need<Stage, Scorer, capability::log_likelihoods>) {
  static_assert(meets<Stage, Scorer, capability::log_likelihoods>,
      "stillpoint: this Stage needs scores in nats, which this Scorer does not give: take ReprojectionScore or "
      "SampsonScore, or MeanGate and RegionClusters; see docs/extending.md");
  return true;
}

template <class Stage, class Gate>
constexpr bool is_met(Need<Stage, Gate, capability::tail_threshold>) {
  static_assert(meets<Stage, Gate, capability::tail_threshold>,
      "stillpoint: this Stage needs the level that few static features exceed, which this Gate does not give: take "
      "TailGate, or RegionClusters; see docs/extending.md");
  return true;
}

template <class Stage, class Classifier>
constexpr bool is_met(Need<Stage, Classifier, capability::log_odds>) {
  static_assert(meets<Stage, Classifier, capability::log_odds>,
      "stillpoint: this Stage adds up log-odds, which this Classifier does not give: take SurfaceClusters or "
      "FlowNeighbours, or NoMemory; see docs/extending.md");
  return true;
}

template <class Stage, class Classifier>
constexpr bool is_met(Need<Stage, Classifier, capability::verdicts>) {
  static_assert(meets<Stage, Classifier, capability::verdicts>,
      "stillpoint: this Stage leaves the decision to the classifier, and this Classifier leaves it to the memory: take "
      "EvidenceMemory, or RegionClusters; see docs/extending.md");
  return true;
}

/// A member with the name of an optional one and another form would be ignored: it is an error.
template <class Policies>
struct OptionalMembers {
  using Camera = typename Policies::Camera;
  using Noise = typename Policies::DepthNoise;
  using Matcher = typename Policies::Matcher;
  static_assert(aligns<Matcher, Camera, Noise>::value || !detail::has_align<Matcher>::value,
      "stillpoint: Policies::Matcher has a member align, but not Pose align(const FrameView& reference, const FrameView& "
      "current, const Pose&, const Camera&, const DepthNoise&); see docs/extending.md");
  static_assert(contradicts<Matcher, Camera>::value || !detail::has_contradicts<Matcher>::value,
      "stillpoint: Policies::Matcher has a member contradicts, but not bool contradicts(const Pose&, const Camera&) const; "
      "see docs/extending.md");
  static_assert(reprojects_into_past<Matcher, Camera, Noise>::value ||
      !(detail::has_choose_keyframes<Matcher>::value || detail::has_reproject_into_past<Matcher>::value),
      "stillpoint: Policies::Matcher must offer both or neither of void choose_keyframes(const FrameHistory&, const "
      "FrameView&, const Pose&, const Camera&, const DepthNoise&, Matches&, Workspace&) and void reproject_into_past(const "
      "FrameHistory&, const FrameView&, const Pose&, const Camera&, const DepthNoise&, Observations&); see docs/extending.md");
  static_assert(!detail::has_survey<Matcher>::value && !detail::has_look_back<Matcher>::value,
      "stillpoint: survey and look_back of Policies::Matcher are called choose_keyframes and reproject_into_past now; see "
      "CHANGELOG.md");
  static_assert(learns<Matcher>::value || !detail::has_learn<Matcher>::value,
      "stillpoint: Policies::Matcher has a member learn, but not void learn(const Observations&, span<const Label>); see "
      "docs/extending.md");
  static_assert(learns<typename Policies::Gate>::value || !detail::has_learn<typename Policies::Gate>::value,
      "stillpoint: Policies::Gate has a member learn, but not void learn(const Observations&, span<const Label>); see "
      "docs/extending.md");
  static_assert(resets<typename Policies::Gate>::value || !detail::has_reset<typename Policies::Gate>::value,
      "stillpoint: Policies::Gate has a member reset, but not void reset(); see docs/extending.md");
  static_assert(resets<typename Policies::Prior>::value || !detail::has_reset<typename Policies::Prior>::value,
      "stillpoint: Policies::Prior has a member reset, but not void reset(); see docs/extending.md");
  static_assert(fills_along_flow<HoleFillingOf<Policies>, Noise>::value ||
      !detail::has_fill_along_flow<HoleFillingOf<Policies>>::value,
      "stillpoint: Policies::HoleFilling has a member fill_along_flow, but not DepthView fill_along_flow(const FrameView& "
      "reference, const FrameView& current, const Matches&, const DepthNoise&, Workspace&); see docs/extending.md");
  static_assert(undoes_along_flow<DepthRegistrationOf<Policies>>::value ||
      !detail::has_undo_along_flow<DepthRegistrationOf<Policies>>::value,
      "stillpoint: Policies::DepthRegistration has a member undo_along_flow, but not DepthView undo_along_flow(const FrameView& "
      "as_it_came, const FrameView& current, const Matches&, Workspace&); see docs/extending.md");
  static_assert(refines<typename Policies::EgoMotion, Camera>::value || !detail::has_refine<typename Policies::EgoMotion>::value,
      "stillpoint: Policies::EgoMotion has a member refine, but not void refine(Observations&, const Camera&, const "
      "MotionPrior&, Motion&, Workspace&); see docs/extending.md");
  static_assert(recalls<typename Policies::Memory>::value || !detail::has_recall<typename Policies::Memory>::value,
      "stillpoint: Policies::Memory has a member recall, but not void recall(const Matches&, Remembered&, Workspace&); see "
      "docs/extending.md");
  static_assert(expects_dynamic<typename Policies::Memory>::value || !detail::has_expect_dynamic<typename Policies::Memory>::value,
      "stillpoint: Policies::Memory has a member expect_dynamic, but not void expect_dynamic(span<const std::uint8_t>); see "
      "docs/extending.md");
  static_assert(observes<typename Policies::Prior, Camera>::value || !detail::has_observe<typename Policies::Prior>::value,
      "stillpoint: Policies::Prior has a member observe, but not void observe(const Observations&, const Motion&, const "
      "Camera&); see docs/extending.md");
};

template <class... Needs>
struct NeedList {
  static constexpr bool check() { return (is_met(Needs{}) && ...); }
};

/// What the stages of a set may need of each other.
template <class P>
using NeedsOf = NeedList<
    Need<typename P::Matcher, typename P::DepthLookup, capability::metric_depth>,
    Need<typename P::EgoMotion, typename P::DepthLookup, capability::metric_depth>,
    Need<typename P::Scorer, typename P::DepthLookup, capability::metric_depth>,
    Need<typename P::Classifier, typename P::DepthLookup, capability::metric_depth>,
    Need<MoversOf<P>, typename P::DepthLookup, capability::metric_depth>,
    Need<typename P::Classifier, typename P::Prior, capability::whole_boxes>,
    Need<typename P::EgoMotion, typename P::Matcher, capability::matches>,
    Need<MoversOf<P>, typename P::Matcher, capability::matches>,
    Need<typename P::Scorer, typename P::Matcher, capability::feature_matches>,
    Need<typename P::Scorer, typename P::Matcher, capability::past_observations>,
    Need<typename P::Classifier, typename P::Matcher, capability::feature_matches>,
    Need<typename P::Scorer, typename P::EgoMotion, capability::metric_motion>,
    Need<typename P::Scorer, typename P::EgoMotion, capability::subpixel_motion>,
    Need<MoversOf<P>, typename P::EgoMotion, capability::metric_motion>,
    Need<typename P::Gate, typename P::Scorer, capability::log_likelihoods>,
    Need<typename P::Classifier, typename P::Scorer, capability::log_likelihoods>,
    Need<typename P::Classifier, typename P::Gate, capability::tail_threshold>,
    Need<typename P::Memory, typename P::Classifier, capability::log_odds>,
    Need<typename P::Memory, typename P::Classifier, capability::verdicts>>;

/// Would a filter of this set compile, as far as its stages need each other? Asks without an error.
template <class... Stages, class... OfStages, class... Tags>
constexpr bool fit_together(NeedList<Need<Stages, OfStages, Tags>...>) {
  return (meets<Stages, OfStages, Tags> && ...);
}

// clang-format on

/// Instantiated by `FrameFilter`: one readable error for each pair of stages that does not go together.
template <class Policies>
struct StageFit : private OptionalMembers<Policies> {
  static_assert(NeedsOf<Policies>::check());
};

}  // namespace stillpoint
