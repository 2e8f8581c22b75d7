// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// An RGB-D odometry on ORB: features spread over the image are matched by their descriptors with the points of the
// nearest keyframes, near where the expected pose sees them; the pose is solved from the matches.

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "descriptor_match.hpp"
#include "keyframe_pose.hpp"
#include "orb_features.hpp"
#include "spread_orb.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// A backend of `FilteredTracker`. Equal frames give equal bytes.
class OrbOdometry {
 public:
  struct Options {
    SpreadOrb::Options orb;
    float search_px = 20.0f;    ///< around where a point is expected
    int farthest_bits = 64;     ///< of 256 in which two descriptors of one point may differ
    double second_best = 0.85;  ///< the best differs by less than this share of the second best
  };
  Options options;
  KeyframePose<OrbFeatures> pose;

  explicit OrbOdometry(Camera camera) : OrbOdometry(std::move(camera), Options{}) {}
  OrbOdometry(Camera camera, const Options& settings)
      : options(settings), pose(std::move(camera)), orb_(settings.orb) {}

  OrbFeatures extract(const stillpoint::FrameView& frame) { return orb_.extract(frame); }

  void expect_motion(const Pose& current_from_last) { pose.expect_motion(current_from_last); }

  std::optional<Pose> track(const stillpoint::FrameView& frame, const OrbFeatures& features) {
    OrbFeatures own{features.keypoints, features.descriptors.clone(), features.weights};
    return pose.track(frame, std::move(own), [this](auto&&... arguments) { match(arguments...); });
  }

 private:
  using Frame = KeyframePose<OrbFeatures>::Frame;

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
      DescriptorMatch most_alike;
      const auto compare = [&](std::size_t i, float) {
        const int octave = current.features.keypoints[i].octave;
        if (std::abs(octave - keyframe.features.keypoints[k].octave) > 1) return;
        const int feature = static_cast<int>(i);
        most_alike.compare(feature, octave,
                           distance_bits(keyframe.features.descriptors.ptr(static_cast<int>(k)),
                                         current.features.descriptors.ptr(feature)));
      };
      if (is_lost) {
        for (std::size_t i = 0; i < pixels.size(); ++i) compare(i, 0.0f);
      } else {
        const Vector3d p = camera_from_keyframe * camera.back_project(keyframe.pixel[k], keyframe.depth_m[k]);
        if (p.z() > 0.1) grid.within(camera.distort(camera.project(p)).cast<float>(), options.search_px, compare);
      }
      if (most_alike.feature < 0 || most_alike.bits > options.second_best * most_alike.second_bits()) continue;
      const auto best = static_cast<std::size_t>(most_alike.feature);
      if (most_alike.bits >= bits_of[best]) continue;
      bits_of[best] = most_alike.bits;
      found[best] = k;
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i] < keyframe.depth_m.size())
        again.push_back({i, keyframe.pixel[found[i]], keyframe.depth_m[found[i]]});
  }

  SpreadOrb orb_;
  stillpoint::Workspace workspace_;
  std::vector<stillpoint::Vector2f> pixels_;
};

}  // namespace examples
