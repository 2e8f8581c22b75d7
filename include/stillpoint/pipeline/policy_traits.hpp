// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The contract of every stage, checked where a policy set is plugged in. docs/extending.md tells it in prose.
//
// Each trait asks for the form of one member; the static_asserts in `PolicyContract` say in one line which stage lacks
// it, quote the signature and name the header to read.

#include <type_traits>
#include <utility>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

namespace detail {

template <class Expected, class Found>
inline constexpr bool returns = std::is_convertible_v<Found, Expected>;

}  // namespace detail

// clang-format off

template <class P, class = void> struct is_prior : std::false_type {};
template <class P> struct is_prior<P, std::void_t<decltype(std::declval<P&>().regions(
    std::declval<const FrameView&>(), std::declval<Regions&>()))>> : std::true_type {};

template <class P, class = void> struct is_matcher : std::false_type {};
template <class P> struct is_matcher<P, std::void_t<decltype(std::declval<P&>().match(
    std::declval<const FrameView&>(), std::declval<const FrameView&>(), std::declval<Matches&>())),
    decltype(std::declval<P&>().reset())>> : std::true_type {};

template <class P, class = void> struct is_depth_lookup : std::false_type {};
template <class P> struct is_depth_lookup<P, std::enable_if_t<detail::returns<double, decltype(std::declval<const P&>().at(
    std::declval<const DepthView&>(), std::declval<const Vector2f&>()))>>> : std::true_type {};

template <class P, class Camera, class = void> struct is_depth_registration : std::false_type {};
template <class P, class Camera> struct is_depth_registration<P, Camera, std::void_t<
    std::enable_if_t<detail::returns<DepthView, decltype(std::declval<P&>().undo(std::declval<const FrameView&>(),
    std::declval<const FrameView&>(), std::declval<const Pose&>(), std::declval<const Camera&>()))>>,
    decltype(std::declval<P&>().observe(std::declval<const FrameView&>(), std::declval<const Matches&>(),
    std::declval<span<const Label>>(), std::declval<const Motion&>(), std::declval<const Camera&>())),
    std::enable_if_t<detail::returns<Warnings, decltype(std::declval<const P&>().warnings())>>,
    decltype(std::declval<P&>().reset())>> : std::true_type {};

template <class P, class Camera, class Noise, class = void> struct is_hole_filling : std::false_type {};
template <class P, class Camera, class Noise> struct is_hole_filling<P, Camera, Noise, std::void_t<
    std::enable_if_t<detail::returns<DepthView, decltype(std::declval<P&>().fill(std::declval<const FrameView&>(),
    std::declval<const FrameView&>(), std::declval<const Pose&>(), std::declval<const Camera&>(),
    std::declval<const Noise&>()))>>, decltype(std::declval<P&>().reset())>> : std::true_type {};

template <class P, class Camera, class = void> struct is_ego_motion : std::false_type {};
template <class P, class Camera> struct is_ego_motion<P, Camera, std::enable_if_t<detail::returns<Motion,
    decltype(std::declval<P&>().estimate(std::declval<const Observations&>(), std::declval<const Camera&>(),
    std::declval<const MotionPrior&>(), std::declval<Workspace&>()))>>> : std::true_type {};

template <class P, class Camera, class = void> struct is_scorer : std::false_type {};
template <class P, class Camera> struct is_scorer<P, Camera, std::void_t<decltype(std::declval<P&>().score(
    std::declval<const Observations&>(), std::declval<const Motion&>(), std::declval<const Camera&>(),
    std::declval<span<FeatureScore>>()))>> : std::true_type {};

template <class P, class = void> struct is_gate : std::false_type {};
template <class P> struct is_gate<P, std::enable_if_t<detail::returns<Threshold, decltype(std::declval<P&>().threshold(
    std::declval<span<const FeatureScore>>(), std::declval<const Regions&>(), std::declval<Workspace&>()))>>> : std::true_type {};

template <class P, class = void> struct is_classifier : std::false_type {};
template <class P> struct is_classifier<P, std::void_t<decltype(std::declval<P&>().classify(
    std::declval<const Observations&>(), std::declval<const Evidence&>(), std::declval<span<Label>>(),
    std::declval<Workspace&>()))>> : std::true_type {};

template <class P, class = void> struct is_memory : std::false_type {};
template <class P> struct is_memory<P, std::void_t<decltype(std::declval<P&>().update(
    std::declval<const Observations&>(), std::declval<const Motion&>(), std::declval<const Evidence&>(),
    std::declval<span<Label>>(), std::declval<Workspace&>())), decltype(std::declval<P&>().reset())>> : std::true_type {};

template <class P, class = void> struct is_keep_floor : std::false_type {};
template <class P> struct is_keep_floor<P, std::enable_if_t<detail::returns<std::size_t, decltype(std::declval<P&>().apply(
    std::declval<span<const Vector2f>>(), std::declval<const ImageView&>(), std::declval<span<Label>>(),
    std::declval<Workspace&>()))>>> : std::true_type {};

template <class P, class Camera, class = void> struct is_movers : std::false_type {};
template <class P, class Camera> struct is_movers<P, Camera, std::void_t<decltype(std::declval<P&>().track(
    std::declval<const FrameView&>(), std::declval<const Observations&>(), std::declval<const Motion&>(),
    std::declval<const Camera&>(), std::declval<span<Label>>(), std::declval<Movers&>(),
    std::declval<Workspace&>())), decltype(std::declval<P&>().reset())>> : std::true_type {};

template <class P, class = void> struct is_depth_noise : std::false_type {};
template <class P> struct is_depth_noise<P, std::enable_if_t<detail::returns<double, decltype(
    std::declval<const P&>().sigma(1.0))>>> : std::true_type {};

template <class P, class = void> struct is_camera : std::false_type {};
template <class P> struct is_camera<P, std::enable_if_t<
    detail::returns<Vector2d, decltype(std::declval<const P&>().project(std::declval<const Vector3d&>()))> &&
    detail::returns<Vector3d, decltype(std::declval<const P&>().back_project(std::declval<const Vector2d&>(), 1.0))> &&
    detail::returns<Vector2d, decltype(std::declval<const P&>().distort(std::declval<const Vector2d&>()))> &&
    detail::returns<Vector2d, decltype(std::declval<const P&>().undistort(std::declval<const Vector2d&>()))> &&
    detail::returns<int, decltype(std::declval<const P&>().width())> &&
    detail::returns<int, decltype(std::declval<const P&>().height())>>> : std::true_type {};

template <class P, class = void> struct is_defined : std::false_type {};
template <class P> struct is_defined<P, std::void_t<decltype(sizeof(P))>> : std::true_type {};

template <class P, class = void> struct names_all_stages : std::false_type {};
template <class P> struct names_all_stages<P, std::void_t<typename P::Camera, typename P::DepthNoise,
    typename P::DepthLookup, typename P::Prior, typename P::Matcher, typename P::EgoMotion, typename P::Scorer,
    typename P::Gate, typename P::Classifier, typename P::Memory, typename P::KeepFloor>> : std::true_type {};

template <class Policies, class = void> struct has_history_length : std::false_type {};
template <class Policies> struct has_history_length<Policies, std::enable_if_t<
    std::is_integral_v<decltype(Policies::kHistoryLength)> && (Policies::kHistoryLength > 0)>> : std::true_type {};

// clang-format on

struct NoMovers;             // movers/no_movers.hpp
struct NoDepthRegistration;  // depth/no_depth_registration.hpp
struct NoHoleFilling;        // depth/no_hole_filling.hpp

namespace detail {

template <class Policies>
using named_depth_registration = typename Policies::DepthRegistration;
template <class Policies>
using named_hole_filling = typename Policies::HoleFilling;
template <class Policies>
using named_movers = typename Policies::Movers;

/// The stage that a set names, or the null stage where it names none.
template <template <class> class Named, class Policies, class Null, class = void>
struct named_or {
  using type = Null;
};
template <template <class> class Named, class Policies, class Null>
struct named_or<Named, Policies, Null, std::void_t<Named<Policies>>> {
  using type = Named<Policies>;
};

}  // namespace detail

/// The stage that a set has for depth of another time: `NoDepthRegistration` where it names none.
template <class Policies>
using DepthRegistrationOf =
    typename detail::named_or<detail::named_depth_registration, Policies, NoDepthRegistration>::type;

/// The stage that a set has for holes of the depth image: `NoHoleFilling` where it names none.
template <class Policies>
using HoleFillingOf = typename detail::named_or<detail::named_hole_filling, Policies, NoHoleFilling>::type;

/// The stage that a set has for movers: `NoMovers` where it names none.
template <class Policies>
using MoversOf = typename detail::named_or<detail::named_movers, Policies, NoMovers>::type;

/// Does a set follow movers? What depends on it is not even compiled where it does not.
template <class Policies>
inline constexpr bool kHasMovers = !std::is_same_v<MoversOf<Policies>, NoMovers>;

/// Instantiated by `FrameFilter`: one readable error for each stage that does not keep its contract.
template <class Policies>
struct PolicyContract {
  static_assert(is_defined<Policies>::value,
                "stillpoint: these Policies are declared, but not defined: include their header, as policies.hpp for "
                "PaperPolicies and MonocularPolicies, policies/with_movers.hpp for WithMovers");
  static_assert(
      !is_defined<Policies>::value || names_all_stages<Policies>::value,
      "stillpoint: Policies must name a type for each of Camera, DepthNoise, DepthLookup, Prior, Matcher, "
      "EgoMotion, Scorer, Gate, Classifier, Memory and KeepFloor; inherit from DefaultPolicies and name what is "
      "yours; see policies.hpp");
  using Camera = typename Policies::Camera;
  static_assert(
      is_camera<Camera>::value,
      "stillpoint: Policies::Camera must offer Vector2d project(const Vector3d&) const, Vector3d back_project(const "
      "Vector2d&, double) const, Vector2d distort(const Vector2d&) const, Vector2d undistort(const Vector2d&) const, "
      "int width() const and int height() const; see core/camera.hpp");
  static_assert(
      is_depth_noise<typename Policies::DepthNoise>::value,
      "stillpoint: Policies::DepthNoise must offer double sigma(double depth_m) const; see depth/depth_noise.hpp");
  static_assert(is_depth_lookup<typename Policies::DepthLookup>::value,
                "stillpoint: Policies::DepthLookup must offer double at(const DepthView&, const Vector2f& depth_pixel) "
                "const; see depth/depth_lookup.hpp");
  static_assert(is_depth_registration<DepthRegistrationOf<Policies>, Camera>::value,
                "stillpoint: Policies::DepthRegistration must offer DepthView undo(const FrameView& reference, const "
                "FrameView& current, const Pose& current_from_reference, const Camera&), void observe(const "
                "FrameView&, const Matches&, span<const Label>, const Motion&, const "
                "Camera&), Warnings warnings() const and void reset(); see depth/no_depth_registration.hpp");
  static_assert(is_hole_filling<HoleFillingOf<Policies>, Camera, typename Policies::DepthNoise>::value,
                "stillpoint: Policies::HoleFilling must offer DepthView fill(const FrameView& reference, const "
                "FrameView& current, const Pose& current_from_reference, const Camera&, const DepthNoise&) and void "
                "reset(); see depth/no_hole_filling.hpp");
  static_assert(
      is_prior<typename Policies::Prior>::value,
      "stillpoint: Policies::Prior must offer void regions(const FrameView&, Regions&); see prior/box_prior.hpp");
  static_assert(
      is_matcher<typename Policies::Matcher>::value,
      "stillpoint: Policies::Matcher must offer void match(const FrameView& reference, const FrameView& current, "
      "Matches&) and void reset(); see match/provided_matches.hpp");
  static_assert(is_ego_motion<typename Policies::EgoMotion, Camera>::value,
                "stillpoint: Policies::EgoMotion must offer Motion estimate(const Observations&, const Camera&, const "
                "MotionPrior&, "
                "Workspace&); see motion/rigid/rigid_motion.hpp");
  static_assert(is_scorer<typename Policies::Scorer, Camera>::value,
                "stillpoint: Policies::Scorer must offer void score(const Observations&, const Motion&, const Camera&, "
                "span<FeatureScore>); see score/offset_score.hpp");
  static_assert(is_gate<typename Policies::Gate>::value,
                "stillpoint: Policies::Gate must offer Threshold threshold(span<const FeatureScore>, const Regions&, "
                "Workspace&); see gate/mean_gate.hpp");
  static_assert(
      is_classifier<typename Policies::Classifier>::value,
      "stillpoint: Policies::Classifier must offer void classify(const Observations&, const Evidence&, span<Label>, "
      "Workspace&); see cluster/region_clusters.hpp");
  static_assert(is_memory<typename Policies::Memory>::value,
                "stillpoint: Policies::Memory must offer void update(const Observations&, const Motion&, const "
                "Evidence&, span<Label>, Workspace&) and void reset(); see memory/no_memory.hpp");
  static_assert(
      is_keep_floor<typename Policies::KeepFloor>::value,
      "stillpoint: Policies::KeepFloor must offer std::size_t apply(span<const Vector2f> pixels, const ImageView&, "
      "span<Label>, Workspace&); see verdict/keep_floor.hpp");
  static_assert(is_movers<MoversOf<Policies>, Camera>::value,
                "stillpoint: Policies::Movers must offer void track(const FrameView&, const Observations&, const "
                "Motion&, const Camera&, span<Label>, Movers&, Workspace&) and void reset(); see "
                "movers/no_movers.hpp");
  static_assert(has_history_length<Policies>::value,
                "stillpoint: Policies must have static constexpr std::size_t kHistoryLength, 1 or more; see "
                "policies.hpp");
  static constexpr bool holds = true;
};

}  // namespace stillpoint
