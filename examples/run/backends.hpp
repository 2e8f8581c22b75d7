// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The trackers that may run behind the filter.

#include <opencv2/features2d.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "../backends/klt_odometry.hpp"
#include "../backends/odometry.hpp"
#include "../backends/orb_odometry.hpp"
#include "options.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint_run {

/// Features, and no pose of any frame.
class NoTracker {
 public:
  struct Features {
    std::vector<cv::KeyPoint> keypoints;
    void compact(stillpoint::span<const std::uint8_t> keep) { stillpoint::compact(keep, keypoints); }
  };

  explicit NoTracker(int features) : orb_(cv::ORB::create(features)) {}

  Features extract(const stillpoint::FrameView& frame) {
    Features features;
    orb_->detect(stillpoint::as_mat(frame.gray), features.keypoints);
    return features;
  }
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView&, const Features&) { return std::nullopt; }

 private:
  cv::Ptr<cv::ORB> orb_;
};

/// Any of the trackers, with a clock beside it. One type for all of them, so that the run is compiled once for each
/// filter and not for each pair.
class AnyTracker {
  struct AnyArrays {
    virtual ~AnyArrays() = default;
    virtual void compact(stillpoint::span<const std::uint8_t> keep) = 0;
    virtual void weigh(stillpoint::span<const float> weights) = 0;
  };

  template <class Function>
  static auto run(double& elapsed_ms, Function&& function) {
    const auto start = std::chrono::steady_clock::now();
    auto result = function();
    elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 public:
  struct Features {
    std::vector<cv::KeyPoint> keypoints;  ///< a copy of the tracker's
    std::unique_ptr<AnyArrays> arrays;    ///< the tracker's own features
    void compact(stillpoint::span<const std::uint8_t> keep) {
      stillpoint::compact(keep, keypoints);
      arrays->compact(keep);
    }
    void weigh(stillpoint::span<const float> weights) { arrays->weigh(weights); }
  };

  template <class Backend>
  explicit AnyTracker(Backend backend) : tracker_(std::make_unique<Model<Backend>>(std::move(backend))) {}

  Features extract(const stillpoint::FrameView& frame) {
    return run(extract_ms, [&] { return tracker_->extract(frame); });
  }
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView& frame, const Features& features) {
    return run(track_ms, [&] { return tracker_->track(frame, *features.arrays); });
  }

  void expect_motion(const stillpoint::Pose& current_from_last) { tracker_->expect_motion(current_from_last); }

  double extract_ms = 0.0;  ///< of the last frame
  double track_ms = 0.0;

 private:
  struct Concept {
    virtual ~Concept() = default;
    virtual Features extract(const stillpoint::FrameView& frame) = 0;
    virtual void expect_motion(const stillpoint::Pose& current_from_last) = 0;
    virtual std::optional<stillpoint::Pose> track(const stillpoint::FrameView& frame, const AnyArrays& arrays) = 0;
  };

  template <class Backend>
  struct Model : Concept {
    using BackendFeatures = decltype(std::declval<Backend&>().extract(std::declval<const stillpoint::FrameView&>()));
    struct Arrays : AnyArrays {
      explicit Arrays(BackendFeatures some) : features(std::move(some)) {}
      void compact(stillpoint::span<const std::uint8_t> keep) override { features.compact(keep); }
      void weigh(stillpoint::span<const float> weights) override {
        if constexpr (stillpoint::has_weigh<BackendFeatures>::value) features.weigh(weights);
      }
      BackendFeatures features;
    };

    explicit Model(Backend a_backend) : backend(std::move(a_backend)) {}

    Features extract(const stillpoint::FrameView& frame) override {
      auto arrays = std::make_unique<Arrays>(backend.extract(frame));
      Features features;
      features.keypoints = arrays->features.keypoints;
      features.arrays = std::move(arrays);
      return features;
    }
    void expect_motion(const stillpoint::Pose& current_from_last) override {
      if constexpr (stillpoint::has_expect_motion<Backend>::value) backend.expect_motion(current_from_last);
    }
    std::optional<stillpoint::Pose> track(const stillpoint::FrameView& frame, const AnyArrays& arrays) override {
      return backend.track(frame, static_cast<const Arrays&>(arrays).features);
    }

    Backend backend;
  };

  std::unique_ptr<Concept> tracker_;
};

/// A new tracker of the kind that the options name.
inline AnyTracker make_tracker(const Options& options, const stillpoint::Camera& camera) {
  if (options.backend == "none") return AnyTracker(NoTracker(options.features));
  if (options.backend == "klt") return AnyTracker(examples::KltOdometry(camera));
  if (options.backend == "orb") {
    examples::OrbOdometry::Options orb;
    orb.features = options.features;
    return AnyTracker(examples::OrbOdometry(camera, orb));
  }
  examples::RgbdOdometry::Options odometry;
  odometry.features = options.features;
  return AnyTracker(examples::RgbdOdometry(camera, odometry));
}

}  // namespace stillpoint_run
