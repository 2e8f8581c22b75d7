// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// An RGB-D odometry on ORB: features spread over the image are matched by their descriptors with the points of the
// nearest keyframes, near where the expected pose sees them; the pose is solved from the matches.

#include <opencv2/core/hal/hal.hpp>
#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "keyframe_pose.hpp"
#include "orb_features.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// A backend of `FilteredTracker`. Equal frames give equal bytes.
class OrbOdometry {
 public:
  struct Options {
    int features = 1000;
    int candidates = 4;         ///< times as many corners are detected, of which the best of each place are taken
    int fast_threshold = 7;     ///< gray values by which a corner differs from what surrounds it
    int cell_px = 32;           ///< side of a place
    float search_px = 20.0f;    ///< around where a point is expected
    int farthest_bits = 64;     ///< of 256 in which two descriptors of one point may differ
    double second_best = 0.85;  ///< the best differs by less than this share of the second best
  };
  Options options;
  KeyframePose<OrbFeatures> pose;

  explicit OrbOdometry(Camera camera) : OrbOdometry(std::move(camera), Options{}) {}
  OrbOdometry(Camera camera, const Options& settings)
      : options(settings),
        pose(std::move(camera)),
        orb_(cv::ORB::create(settings.features * settings.candidates, 1.2f, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31,
                             settings.fast_threshold)) {}

  OrbFeatures extract(const stillpoint::FrameView& frame) {
    const cv::Mat gray = stillpoint::as_mat(stillpoint::with_gray(frame, gray_).gray);
    OrbFeatures features;
    orb_->detect(gray, features.keypoints);
    spread(features.keypoints);
    orb_->compute(gray, features.keypoints, features.descriptors);
    return features;
  }

  void expect_motion(const Pose& current_from_last) { pose.expect_motion(current_from_last); }

  std::optional<Pose> track(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    OrbFeatures own{features.keypoints, features.descriptors.clone(), features.weights};
    return pose.track(frame, std::move(own), [this](auto&&... arguments) { match(arguments...); });
  }

 private:
  using Frame = KeyframePose<OrbFeatures>::Frame;

  /// The strongest corner of each place first, then the second of each, until there are enough: where the texture is
  /// richest, on a poster or a shirt, there are no more of them than elsewhere.
  void spread(std::vector<cv::KeyPoint>& keypoints) const {
    std::stable_sort(keypoints.begin(), keypoints.end(),
                     [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
    const int columns = pose.camera().width() / options.cell_px + 1,
              rows = pose.camera().height() / options.cell_px + 1;
    std::vector<int> count(static_cast<std::size_t>(columns * rows), 0);
    std::vector<std::pair<int, std::size_t>> rank;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const int column = static_cast<int>(keypoints[i].pt.x) / options.cell_px;
      const int row = static_cast<int>(keypoints[i].pt.y) / options.cell_px;
      rank.emplace_back(count[static_cast<std::size_t>(row * columns + column)]++, i);
    }
    std::sort(rank.begin(), rank.end());
    rank.resize(std::min(rank.size(), static_cast<std::size_t>(options.features)));
    std::vector<cv::KeyPoint> taken;
    for (const auto& entry : rank) taken.push_back(keypoints[entry.second]);
    std::stable_sort(taken.begin(), taken.end(),
                     [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.octave < b.octave; });
    keypoints = std::move(taken);
  }

  /// The points of a keyframe that are found again, each by the feature that is most like it; without an expected pose
  /// they are looked for in the whole image.
  void match(const Frame& keyframe, const Frame& current, const Pose& camera_from_world, bool is_lost,
             std::vector<FoundAgain>& again) {
    const stillpoint::Workspace::Scope scope(workspace_);
    const stillpoint::span<const stillpoint::Vector2f> pixels =
        stillpoint::read_pixels(current.features.keypoints, pixels_);
    const stillpoint::PixelGrid grid(pixels, options.search_px, workspace_, [](std::size_t) { return true; });
    const Pose camera_from_keyframe = camera_from_world * keyframe.world_from_camera;
    const Camera& camera = pose.camera();
    std::vector<int> bits_of(pixels.size(), options.farthest_bits);
    std::vector<std::size_t> found(pixels.size(), keyframe.depth_m.size());
    for (std::size_t k = 0; k < keyframe.depth_m.size(); ++k) {
      if (!(keyframe.depth_m[k] > 0)) continue;
      int best_bits = 256, second_bits = 256;
      std::size_t best = 0;
      const auto compare = [&](std::size_t i, float) {
        const int octave = current.features.keypoints[i].octave;
        if (std::abs(octave - keyframe.features.keypoints[k].octave) > 1) return;
        // Neighbouring octaves hold the same corner: only one of the best's own octave is a rival.
        const int bits = distance_bits(keyframe.features, k, current.features, i);
        if (bits < best_bits) {
          second_bits = current.features.keypoints[best].octave == octave ? best_bits : 256;
          best_bits = bits;
          best = i;
        } else if (bits < second_bits && current.features.keypoints[best].octave == octave) {
          second_bits = bits;
        }
      };
      if (is_lost) {
        for (std::size_t i = 0; i < pixels.size(); ++i) compare(i, 0.0f);
      } else {
        const Vector3d p = camera_from_keyframe * camera.back_project(keyframe.pixel[k], keyframe.depth_m[k]);
        if (p.z() > 0.1) grid.within(camera.distort(camera.project(p)).cast<float>(), options.search_px, compare);
      }
      if (best_bits == 256 || best_bits >= bits_of[best] || best_bits > options.second_best * second_bits) continue;
      bits_of[best] = best_bits;
      found[best] = k;
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i] < keyframe.depth_m.size())
        again.push_back({i, keyframe.pixel[found[i]], keyframe.depth_m[found[i]]});
  }

  static int distance_bits(const OrbFeatures& a, std::size_t i, const OrbFeatures& b, std::size_t j) {
    return cv::hal::normHamming(a.descriptors.ptr(static_cast<int>(i)), b.descriptors.ptr(static_cast<int>(j)),
                                a.descriptors.cols);
  }

  cv::Ptr<cv::ORB> orb_;
  stillpoint::ImageBuffer gray_;
  stillpoint::Workspace workspace_;
  std::vector<stillpoint::Vector2f> pixels_;
};

}  // namespace examples
