// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which image, depth and camera_info belong together?   Three streams → frames, in the order of time.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "stillpoint_ros/camera_info.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_ros {

/// One moment, whole.
struct PairedFrame {
  RawImage image, depth;
  CameraInfo camera;
};

/// Pairs an image with the depth that is nearest in time, and with the camera_info of its size that is nearest in time.
/// A pair is made as soon as both are there: a tolerance of less than half of the time between frames makes no wrong
/// pairs and costs no latency. What is older than a pair that was made is left out.
class FramePairing {
 public:
  struct Options {
    double tolerance_s = 0.01;       ///< most between image and depth
    std::size_t longest_queue = 30;  ///< of each stream; the oldest is left out
  };
  Options options;

  void add_image(RawImage image) { unpaired_images_ += images_.add(std::move(image), options.longest_queue); }
  void add_depth(RawImage depth) { depths_.add(std::move(depth), options.longest_queue); }
  void add_camera_info(CameraInfo info) {
    // The same camera again only tells the time.
    for (CameraInfo& known : cameras_) {
      if (!is_same_camera(known, info)) continue;
      known.stamp_s = info.stamp_s;
      return;
    }
    cameras_.push_back(std::move(info));
    if (cameras_.size() > kMostCameras) cameras_.pop_front();
  }

  /// The next frame; empty while a part of it is missing.
  std::optional<PairedFrame> take() {
    for (auto image = images_.queue.begin(); image != images_.queue.end(); ++image) {
      const auto depth = nearest(depths_.queue, image->stamp_s);
      if (depth == depths_.queue.end() || !(difference_s(*depth, *image) <= options.tolerance_s)) continue;
      const CameraInfo* const camera = camera_for(*image);
      if (camera == nullptr) continue;
      PairedFrame frame{std::move(*image), std::move(*depth), *camera};
      unpaired_images_ += static_cast<std::size_t>(image - images_.queue.begin());
      images_.forget_until(image, frame.image.stamp_s);
      depths_.forget_until(depth, frame.depth.stamp_s);
      return frame;
    }
    return std::nullopt;
  }

  /// Images that were left out because no depth came for them: a later one was paired, the queue was full, or a
  /// recording began anew.
  std::size_t unpaired_images() const noexcept { return unpaired_images_; }
  /// Images whose depth may still come.
  std::size_t waiting_images() const noexcept { return images_.queue.size(); }

  /// Between the newest image and the depth nearest to it; infinite where one is missing.
  double nearest_difference_s() {
    if (images_.queue.empty()) return std::numeric_limits<double>::infinity();
    const auto depth = nearest(depths_.queue, images_.queue.back().stamp_s);
    return depth == depths_.queue.end() ? std::numeric_limits<double>::infinity()
                                        : difference_s(*depth, images_.queue.back());
  }

  /// The stamp of the newest image where it was left out, because it is not later than the last frame's.
  std::optional<double> image_not_later_s() const noexcept { return images_.not_later_s; }
  std::optional<double> depth_not_later_s() const noexcept { return depths_.not_later_s; }

  /// The newest image whose size no camera_info has; empty where there is none.
  const RawImage* image_without_camera() const {
    if (images_.queue.empty() || camera_for(images_.queue.back()) != nullptr) return nullptr;
    return &images_.queue.back();
  }

 private:
  using Queue = std::deque<RawImage>;
  static constexpr std::size_t kMostCameras = 4;  // a camera changes its resolution now and then
  static constexpr double kJumpBack_s = 1.0;      // a recording begins anew

  /// What waits of one stream, by time.
  struct Stream {
    Queue queue;
    double newest_s = -std::numeric_limits<double>::infinity();
    double paired_s = -std::numeric_limits<double>::infinity();
    std::optional<double> not_later_s;  ///< stamp of the newest message, if that was left out

    /// @return  how many messages were left out, which waited for their partners
    std::size_t add(RawImage message, std::size_t longest_queue) {
      std::size_t left_out = 0;
      if (message.stamp_s < newest_s - kJumpBack_s) {
        left_out = queue.size();
        *this = Stream();
      }
      newest_s = std::max(newest_s, message.stamp_s);
      if (message.stamp_s <= paired_s) {
        not_later_s = message.stamp_s;
        return left_out;
      }
      not_later_s.reset();
      const auto after =
          std::upper_bound(queue.begin(), queue.end(), message.stamp_s,
                           [](double stamp_s, const RawImage& other) { return stamp_s < other.stamp_s; });
      queue.insert(after, std::move(message));
      if (queue.size() > std::max<std::size_t>(longest_queue, 1)) {
        queue.pop_front();
        ++left_out;
      }
      return left_out;
    }
    void forget_until(Queue::iterator last, double stamp_s) {
      queue.erase(queue.begin(), last + 1);
      paired_s = stamp_s;
    }
  };

  static double difference_s(const RawImage& a, const RawImage& b) { return std::abs(a.stamp_s - b.stamp_s); }

  static Queue::iterator nearest(Queue& queue, double stamp_s) {
    return std::min_element(queue.begin(), queue.end(), [stamp_s](const RawImage& a, const RawImage& b) {
      return std::abs(a.stamp_s - stamp_s) < std::abs(b.stamp_s - stamp_s);
    });
  }

  const CameraInfo* camera_for(const RawImage& image) const {
    const CameraInfo* best = nullptr;
    for (const CameraInfo& info : cameras_) {
      if (info.width != image.width || info.height != image.height) continue;
      if (best == nullptr || std::abs(info.stamp_s - image.stamp_s) < std::abs(best->stamp_s - image.stamp_s))
        best = &info;
    }
    return best;
  }

  Stream images_, depths_;
  std::deque<CameraInfo> cameras_;
  std::size_t unpaired_images_ = 0;
};

}  // namespace stillpoint_ros
