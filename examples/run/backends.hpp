// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The trackers that may run behind the filter.

#include <opencv2/features2d.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "../backends/klt_odometry.hpp"
#include "../backends/odometry.hpp"
#include "../backends/orb_odometry.hpp"
#include "map_files.hpp"
#include "options.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/opencv.hpp"
#ifdef STILLPOINT_RUN_WITH_SLAM
#include "../slam/slam.hpp"
#endif

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

template <class Backend, class = void>
struct has_map : std::false_type {};
template <class Backend>
struct has_map<Backend, std::void_t<decltype(std::declval<Backend&>().map_ply())>> : std::true_type {};

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

  /// All poses as a map has them in the end; nothing from a tracker without a map.
  std::optional<stillpoint::Trajectory> trajectory() { return tracker_->trajectory(); }

  std::optional<MapFiles> map_files() { return tracker_->map_files(); }
  /// What a detector has seen in the coming frame.
  void expect_detections(const std::vector<stillpoint::Detection>& detections) {
    tracker_->expect_detections(detections);
  }

  /// What the map calls dynamic; nothing without a map.
  stillpoint::span<const std::uint8_t> dynamic_features() { return tracker_->dynamic_features(); }

  double extract_ms = 0.0;  ///< of the last frame
  double track_ms = 0.0;

 private:
  struct Concept {
    virtual ~Concept() = default;
    virtual Features extract(const stillpoint::FrameView& frame) = 0;
    virtual void expect_motion(const stillpoint::Pose& current_from_last) = 0;
    virtual std::optional<stillpoint::Pose> track(const stillpoint::FrameView& frame, const AnyArrays& arrays) = 0;
    virtual std::optional<stillpoint::Trajectory> trajectory() = 0;
    virtual std::optional<MapFiles> map_files() = 0;
    virtual stillpoint::span<const std::uint8_t> dynamic_features() = 0;
    virtual void expect_detections(const std::vector<stillpoint::Detection>& detections) = 0;
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
    std::optional<stillpoint::Trajectory> trajectory() override {
      if constexpr (has_map<Backend>::value)
        return backend.trajectory();
      else
        return std::nullopt;
    }
    std::optional<MapFiles> map_files() override {
      if constexpr (has_map<Backend>::value) {
        MapFiles files{backend.map_ply(), backend.map_ply_before_loop(), {}, {}};  // behind them the map is at rest
        const auto& map = backend.keeper().map;
        for (const auto& [id, keyframe] : map.keyframes()) files.keyframes.push_back(keyframe.timestamp_s);
        for (const auto& loop : backend.keeper().loops) files.loops.push_back({loop.place_s, loop.keyframe_s});
        return files;
      } else {
        return std::nullopt;
      }
    }
    stillpoint::span<const std::uint8_t> dynamic_features() override {
      if constexpr (stillpoint::has_dynamic_features<Backend>::value)
        return backend.dynamic_features();
      else
        return {};
    }
    void expect_detections(const std::vector<stillpoint::Detection>& detections) override {
      if constexpr (has_map<Backend>::value) backend.expect_detections(detections);
    }

    Backend backend;
  };

  std::unique_ptr<Concept> tracker_;
};

#ifdef STILLPOINT_RUN_WITH_SLAM
inline AnyTracker make_slam(const Options& options, const stillpoint::Camera& camera) {
  examples::slam::SlamOptions slam;
  slam.orb.features = options.features;
  slam.fewest_to_begin = std::min(slam.fewest_to_begin, static_cast<std::size_t>(options.features) / 4);
  slam.maps_in_step = options.maps_in_step;
  slam.uses_multi_view = !options.slam_without("multi-view");
  slam.uses_bundle = !options.slam_without("bundle");
  slam.uses_loops = !options.slam_without("loops");
  slam.uses_objects = !options.slam_without("semantics");
  return AnyTracker(examples::slam::Slam(camera, slam));
}
#endif

/// A new tracker of the kind that the options name.
/// @throws stillpoint::Error for the SLAM where the program was built without it.
inline AnyTracker make_tracker(const Options& options, const stillpoint::Camera& camera) {
  if (options.backend == "none") return AnyTracker(NoTracker(options.features));
  if (options.backend == "slam") {
#ifdef STILLPOINT_RUN_WITH_SLAM
    return make_slam(options, camera);
#else
    throw stillpoint::Error(
        "--backend: found slam, but this stillpoint_run was built without Ceres, which adjusts its map (Debian: "
        "libceres-dev); expected one of odometry, klt, orb, none");
#endif
  }
  if (options.backend == "klt") return AnyTracker(examples::KltOdometry(camera));
  if (options.backend == "orb") {
    examples::OrbOdometry::Options orb;
    orb.orb.features = options.features;
    return AnyTracker(examples::OrbOdometry(camera, orb));
  }
  examples::RgbdOdometry::Options odometry;
  odometry.features = options.features;
  return AnyTracker(examples::RgbdOdometry(camera, odometry));
}

}  // namespace stillpoint_run
