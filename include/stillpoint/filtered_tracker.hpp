// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The loop of a tracker with a filter in front: extract, filter, compact, track, feed the pose back.
//
// What the two sides must offer:
//
// clang-format off
// | who      | member                                                 | meaning                                       |
// |----------|--------------------------------------------------------|-----------------------------------------------|
// | Backend  | Features extract(const FrameView&)                     | a frame's keypoints and their arrays         |
// | Features | keypoints                                              | contiguous, with keypoint_traits              |
// | Features | void compact(span<const std::uint8_t> keep)            | drops entry i of every array where keep[i]    |
// |          |                                                        | is 0; core/compact.hpp does it                |
// |          | void weigh(span<const float> weights)                  | optional: what each may say, before `compact` |
// | Backend  | std::optional<Pose> track(const FrameView&,            | world_from_camera of that frame, or nothing:  |
// |          |                           const Features&)             | the next frame is tried anew                  |
// | Backend  | void expect_motion(const Pose& current_from_reference) | optional, before `track`: the filter's own    |
// |          |                                                        | motion since the last frame, in metres        |
// | Backend  | void feedback(const Pose& world_from_camera)           | optional: the pose it returned                |
// | Backend  | Flags dynamic_features()                               | optional, after `track`: one byte per keypoint|
// |          |                                                        | of `extract`, 1: moves, by the backend's map; |
// |          |                                                        | converts to span<const std::uint8_t>          |
// | Filter   | Result filter_frame(const FrameView&,                  | judges them; may return a reference           |
// |          |                     const Keypoints&)                  |                                               |
// | Result   | keep(), converts to span<const std::uint8_t>           | one byte per keypoint, 0 drops                 |
// | Result   | const Motion& motion()                                 | optional: what `expect_motion` is told        |
// | Filter   | void feedback(const Pose& world_from_camera)           | optional: helps to predict                    |
// | Filter   | void expect_dynamic(span<const std::uint8_t>)          | optional: what `dynamic_features` returned    |
// clang-format on
//
// Each is called once per frame, in the order of `track` below, `feedback` and `dynamic_features` only where there is a
// pose, `expect_motion` only where the filter knows the motion and its length.

#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/verdict/weights.hpp"

namespace stillpoint {

// clang-format off

template <class B, class = void> struct has_extract : std::false_type {};
template <class B> struct has_extract<B, std::enable_if_t<!std::is_void_v<decltype(
    std::declval<B&>().extract(std::declval<const FrameView&>()))>>> : std::true_type {};

template <class F, class = void> struct has_keypoints : std::false_type {};
template <class F> struct has_keypoints<F, std::enable_if_t<detail::has_keypoint_traits<
    typename decltype(span(std::declval<const F&>().keypoints))::value_type>::value>> : std::true_type {};

template <class F, class = void> struct has_compact : std::false_type {};
template <class F> struct has_compact<F, std::void_t<decltype(
    std::declval<F&>().compact(std::declval<span<const std::uint8_t>>()))>> : std::true_type {};

template <class F, class = void> struct has_weigh : std::false_type {};
template <class F> struct has_weigh<F, std::void_t<decltype(
    std::declval<F&>().weigh(std::declval<span<const float>>()))>> : std::true_type {};

template <class R, class = void> struct has_weights : std::false_type {};
template <class R> struct has_weights<R, std::void_t<decltype(
    weights(std::declval<const R&>(), std::declval<std::vector<float>&>()))>> : std::true_type {};

template <class B, class Features, class = void> struct has_track : std::false_type {};
template <class B, class Features> struct has_track<B, Features, std::enable_if_t<std::is_convertible_v<decltype(
    std::declval<B&>().track(std::declval<const FrameView&>(), std::declval<const Features&>())),
    std::optional<Pose>>>> : std::true_type {};

template <class F, class Features, class = void> struct has_filter_frame : std::false_type {};
template <class F, class Features> struct has_filter_frame<F, Features, std::enable_if_t<std::is_convertible_v<decltype(
    std::declval<F&>().filter_frame(std::declval<const FrameView&>(), std::declval<const Features&>().keypoints).keep()),
    span<const std::uint8_t>>>> : std::true_type {};

template <class B, class = void> struct has_expect_motion : std::false_type {};
template <class B> struct has_expect_motion<B, std::void_t<decltype(
    std::declval<B&>().expect_motion(std::declval<const Pose&>()))>> : std::true_type {};

template <class R, class = void> struct has_motion : std::false_type {};
template <class R> struct has_motion<R, std::enable_if_t<std::is_convertible_v<decltype(
    std::declval<const R&>().motion()), const Motion&>>> : std::true_type {};

template <class B, class = void> struct has_dynamic_features : std::false_type {};
template <class B> struct has_dynamic_features<B, std::enable_if_t<std::is_convertible_v<decltype(
    std::declval<B&>().dynamic_features()), span<const std::uint8_t>>>> : std::true_type {};

template <class F, class = void> struct has_expect_dynamic : std::false_type {};
template <class F> struct has_expect_dynamic<F, std::void_t<decltype(
    std::declval<F&>().expect_dynamic(std::declval<span<const std::uint8_t>>()))>> : std::true_type {};

template <class T, class = void> struct has_feedback : std::false_type {};
template <class T> struct has_feedback<T, std::void_t<decltype(
    std::declval<T&>().feedback(std::declval<const Pose&>()))>> : std::true_type {};

// clang-format on

/// Instantiated by `FilteredTracker`: one readable error for the first member that is missing.
template <class Filter, class Backend>
class TrackerContract {
  template <class B, class = void>
  struct FeaturesOf {
    struct type {};
  };
  template <class B>
  struct FeaturesOf<B, std::enable_if_t<has_extract<B>::value>> {
    using type = std::decay_t<decltype(std::declval<B&>().extract(std::declval<const FrameView&>()))>;
  };

 public:
  using Features = typename FeaturesOf<Backend>::type;

 private:
  static constexpr bool kExtracts = has_extract<Backend>::value;
  static constexpr bool kHasKeypoints = has_keypoints<Features>::value;
  static_assert(
      kExtracts,
      "stillpoint: Backend must offer Features extract(const FrameView&); see stillpoint/filtered_tracker.hpp");
  static_assert(!kExtracts || kHasKeypoints,
                "stillpoint: Backend::extract must return features with a public, contiguous `keypoints` whose element "
                "has stillpoint::keypoint_traits; see core/keypoint.hpp");
  static_assert(!kExtracts || has_compact<Features>::value,
                "stillpoint: Backend::extract must return features with void compact(span<const std::uint8_t> keep); "
                "see core/compact.hpp");
  static_assert(!kExtracts || has_track<Backend, Features>::value,
                "stillpoint: Backend must offer std::optional<Pose> track(const FrameView&, const Features&); see "
                "stillpoint/filtered_tracker.hpp");
  static_assert(!kHasKeypoints || has_filter_frame<Filter, Features>::value,
                "stillpoint: Filter must offer filter_frame(const FrameView&, const Keypoints&), whose result has "
                "keep() -> span<const std::uint8_t>; see stillpoint/null_filter.hpp");

 public:
  static constexpr bool holds = kExtracts && kHasKeypoints && has_compact<Features>::value &&
                                has_track<Backend, Features>::value && has_filter_frame<Filter, Features>::value;
};

/// A tracker that sees only what its filter keeps.
/// @tparam Filter  `FrameFilter<...>`, `NullFilter` for the unfiltered run, or a type of your own
/// @tparam Backend any tracker that takes features
template <class Filter, class Backend>
class FilteredTracker : private TrackerContract<Filter, Backend> {
  using Contract = TrackerContract<Filter, Backend>;

 public:
  using Features = typename Contract::Features;

  FilteredTracker(Filter a_filter, Backend a_backend) : filter(std::move(a_filter)), backend(std::move(a_backend)) {}

  Filter filter;    ///< which features stand still?
  Backend backend;  ///< where is the camera?
  /// Is the filter told the backend's poses? They predict its next motion, better than its own do where the backend is
  /// a full SLAM. An odometry that is led astray leads the filter astray as well, which then keeps what led it.
  bool tells_filter = true;

  /// Tracks one frame. Frames come in the order of time.
  /// @return world_from_camera, or nothing where the backend has no pose for this frame.
  /// @throws what the backend throws, and Error where the filter's answer is not one flag per keypoint (by `compact`).
  std::optional<Pose> track(const FrameView& frame) {
    return track(frame, [](const auto&, const auto&) {});
  }

  /// The same, and shows what was decided: for a record of every feature, dropped ones too.
  /// @param observe called as observe(keypoints, result) with all keypoints and the filter's result, before compaction
  template <class Observer>
  std::optional<Pose> track(const FrameView& frame, Observer&& observe) {
    if constexpr (Contract::holds) {
      Features features = backend.extract(frame);
      const auto& result = filter.filter_frame(frame, features.keypoints);
      observe(std::as_const(features.keypoints), result);
      weigh(result, features);
      features.compact(result.keep());
      tell_motion(result);
      last_timestamp_s_ = frame.timestamp_s;
      const std::optional<Pose> world_from_camera = backend.track(frame, features);
      if (world_from_camera) feed_back(*world_from_camera);
      return world_from_camera;
    } else {
      return std::nullopt;  // the contract has said what is missing: no second error
    }
  }

 private:
  template <class Result>
  void weigh(const Result& result, Features& features) {
    if constexpr (has_weigh<Features>::value && has_weights<Result>::value) {
      weights(result, weights_);
      features.weigh(span<const float>(weights_));
    }
  }

  template <class Result>
  void tell_motion(const Result& result) {
    if constexpr (has_expect_motion<Backend>::value && has_motion<Result>::value) {
      const Motion& motion = result.motion();
      // Over a frame that the filter refused, and the backend saw, a motion is no step from the last frame.
      const bool reaches_back = motion.reference_timestamp_s < last_timestamp_s_;
      if (motion.usable() && motion.metric && !reaches_back) backend.expect_motion(motion.current_from_reference);
    }
  }

  void feed_back(const Pose& world_from_camera) {
    if constexpr (has_feedback<Filter>::value) {
      if (tells_filter) filter.feedback(world_from_camera);
    }
    if constexpr (has_feedback<Backend>::value) backend.feedback(world_from_camera);
    if constexpr (has_dynamic_features<Backend>::value && has_expect_dynamic<Filter>::value)
      filter.expect_dynamic(backend.dynamic_features());
  }

  std::vector<float> weights_;
  double last_timestamp_s_ = std::numeric_limits<double>::quiet_NaN();  ///< of the frame that the backend saw last
};

}  // namespace stillpoint
