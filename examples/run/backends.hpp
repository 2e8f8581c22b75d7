// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The trackers that may run behind the filter.

#include <opencv2/features2d.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "../backends/klt_odometry.hpp"
#include "../backends/odometry.hpp"
#include "../backends/orb_odometry.hpp"
#include "options.hpp"
#include "stillpoint/adapters/filtered_tracker.hpp"
#include "stillpoint/core/compact.hpp"
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

/// A backend with a clock beside it.
template <class Backend>
class Timed {
 public:
  explicit Timed(Backend backend) : backend_(std::move(backend)) {}

  auto extract(const stillpoint::FrameView& frame) {
    return run(extract_ms, [&] { return backend_.extract(frame); });
  }
  template <class Features>
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView& frame, const Features& features) {
    return run(track_ms, [&] { return backend_.track(frame, features); });
  }
  template <class B = Backend>
  auto feedback(const stillpoint::Pose& world_from_camera) -> decltype(std::declval<B&>().feedback(world_from_camera)) {
    return static_cast<B&>(backend_).feedback(world_from_camera);
  }

  double extract_ms = 0.0;  ///< of the last frame
  double track_ms = 0.0;

 private:
  template <class Function>
  static auto run(double& elapsed_ms, Function&& function) {
    const auto start = std::chrono::steady_clock::now();
    auto result = function();
    elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

  Backend backend_;
};

/// Calls `use(make)`, where `make()` gives a new tracker of the kind that the options name.
template <class Use>
decltype(auto) with_backend(const Options& options, const stillpoint::Camera& camera, Use&& use) {
  if (options.backend == "none") return use([&] { return Timed(NoTracker(options.features)); });
  if (options.backend == "klt") return use([&] { return Timed(examples::KltOdometry(camera)); });
  if (options.backend == "orb")
    return use([&] {
      examples::OrbOdometry::Options orb;
      orb.features = options.features;
      return Timed(examples::OrbOdometry(camera, orb));
    });
  return use([&camera, &options] {
    examples::RgbdOdometry::Options odometry;
    odometry.features = options.features;
    return Timed(examples::RgbdOdometry(camera, odometry));
  });
}

}  // namespace stillpoint_run
