// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is the filter used as it is meant?   What is improbable in one frame and wrong in many.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/status.hpp"
#include "stillpoint/core/warnings.hpp"
#include "stillpoint/depth/depth_orientation.hpp"
#include "stillpoint/pipeline/frame_check.hpp"

namespace stillpoint {

/// Counts frames that look like wrong use. It changes no verdict. docs/statuses.md lists what it sees.
class UseCheck {
 public:
  /// A frame was filtered.
  /// @param pixels   its keypoints
  /// @param depth_m  theirs, 0 for none; of a frame that was judged
  template <class Camera>
  void observe(Status status, const FrameView& frame, const Camera& camera, span<const Vector2f> pixels,
               span<const double> depth_m, const Motion& motion) {
    const bool is_time_wrong =
        status == Status::time_gap || status == Status::out_of_order || status == Status::duplicate_frame;
    if (status == Status::first_frame || (FrameCheck::rejects(status) && !is_time_wrong)) return;
    times_far_apart_.count(is_time_wrong);
    if (is_time_wrong) return;
    nothing_fits_.count(!judged(status) && status != Status::no_keypoints);
    principal_point_aside_.count(is_aside(camera.cx(), camera.width()) && is_aside(camera.cy(), camera.height()));
    count_places(frame.image().width, frame.image().height, pixels);
    depth_shape_differs_.count(!frame.depth.empty() && !have_same_shape(frame.depth.image, frame.image()));
    if (frames_++ % kLookEvery == 0) {
      const DepthOrientation orientation = DepthOrientation::of(frame);
      if (orientation.tells()) depth_turned_over_.count(orientation.is_wrong());
    }
    if (!judged(status)) return;
    count_depths(depth_m);
    const bool is_metric = motion.metric && !frame.depth.empty();
    motion_too_fast_.count(is_metric && translation_of(motion.current_from_reference).norm() > kFast_m);
  }

  /// The host says how the camera moved to the frame that was observed last.
  /// @param host_motion  current_from_reference
  /// @param motion       of the filter, to that frame
  void compare(const Pose& host_motion, const Motion& motion) {
    if (!motion.usable() || !motion.metric) return;
    const double host_m = translation_of(host_motion).norm();
    const double filter_m = translation_of(motion.current_from_reference).norm();
    if (!(std::max(host_m, filter_m) > kLeastStep_m)) return;
    scale_differs_.count(host_m > kOtherScale * filter_m || filter_m > kOtherScale * host_m);
  }

  Warnings warnings() const noexcept {
    Warnings found;
    const auto add = [&found](const Doubt& doubt, Warning warning) {
      if (doubt.is_strong()) found.add(warning);
    };
    add(depth_shape_differs_, Warning::depth_shape_differs);
    add(depth_turned_over_, Warning::depth_turned_over);
    add(depth_too_near_, Warning::depth_too_near);
    add(motion_too_fast_, Warning::motion_too_fast);
    add(scale_differs_, Warning::scale_differs);
    add(in_one_quarter_, Warning::keypoints_in_one_quarter);
    add(outside_, Warning::keypoints_outside);
    add(principal_point_aside_, Warning::principal_point_aside);
    add(times_far_apart_, Warning::times_far_apart);
    add(nothing_fits_, Warning::nothing_fits);
    return found;
  }

  /// One sentence on what is probably wrong, the most telling first; empty where nothing is.
  static const char* hint(Status status, Warnings warnings) noexcept {
    switch (status) {
      case Status::no_image: return "The image is empty: nothing was filtered.";
      case Status::unsupported_image:
        return "The image must be 8-bit gray or BGR, the depth 16 bit or float: convert them first.";
      case Status::depth_unit_missing:
        return "16-bit depth needs its units per metre: write DepthView::millimetres(depth) for ROS, RealSense and "
               "Azure Kinect, DepthView::tum(depth) for the TUM benchmark.";
      case Status::implausible_depth:
        return "Half of the depths are beyond a kilometre: float depth is in metres, and 16-bit depth needs its units "
               "per metre, 1000 for millimetres.";
      case Status::size_changed:
        return "The image is not of the camera's size: give the intrinsics of this resolution.";
      case Status::invalid_options: return "An option is out of its range: options_error() names it.";
      case Status::invalid_time: return "Time is in seconds: divide nanoseconds by 1e9.";
      case Status::no_depth:
        return "No feature has a depth: pass the depth image of this image, or use MonocularPolicies without depth.";
      default: break;
    }
    if (warnings.has(Warning::times_far_apart))
      return "Hardly a frame has a time that fits the last one's: is it in seconds, a double with its fraction, and "
             "does it grow?";
    if (warnings.has(Warning::keypoints_outside))
      return "Half of the keypoints are outside of the image: are they of another resolution?";
    if (warnings.has(Warning::keypoints_in_one_quarter))
      return "All keypoints are in one quarter of the image: are they of a smaller one?";
    if (warnings.has(Warning::principal_point_aside))
      return "The principal point is far from the middle of the image: are the intrinsics those of this resolution?";
    if (warnings.has(Warning::depth_shape_differs))
      return "The depth image has another shape than the image: is it aligned to the image?";
    if (warnings.has(Warning::depth_turned_over))
      return "The depth image fits better when it is mirrored or turned over: is it that of this image?";
    if (warnings.has(Warning::scale_differs))
      return "The host moves more than twice or less than half as far as the depth says: is the depth's unit right? If "
             "so, host or filter follow something that moves.";
    if (warnings.has(Warning::motion_too_fast))
      return "The camera moves by metres from frame to frame: is the depth's unit right, and time in seconds?";
    if (warnings.has(Warning::depth_too_near))
      return "Hardly a depth is beyond 1 m: is the depth in millimetres, and declared as TUM's unit?";
    if (warnings.has(Warning::depth_unsynchronised))
      return "Depth images are older or newer than their images, by half the time between frames or more: pair them by "
             "time, or let the sensor synchronise them.";
    if (warnings.has(Warning::depth_shifted))
      return "Depth images lie some pixels beside their images: are the calibration between the two cameras and the "
             "alignment to the image right?";
    if (warnings.has(Warning::nothing_fits))
      return "Hardly a frame can be judged: are depth and image aligned, of one moment, not mirrored, the focal "
             "lengths right, and has reference_pixels, if it is used, one entry per keypoint?";
    return "";
  }

 private:
  static constexpr double kNear_m = 1.0;        // a room is larger, also where people stand before the camera
  static constexpr double kFast_m = 2.0;        // 60 m/s at 30 Hz, 20 m/s at 10 Hz
  static constexpr double kOtherScale = 2.0;    // 5000 for 1000 is 5
  static constexpr double kLeastStep_m = 0.01;  // smaller ones are noise
  static constexpr double kAside = 0.15;        // of the size; 1280 x 720 for 848 x 480 is 0.25 in x and y, a lens 0.05
  static constexpr int kMany = 20;              // frames in a row that look wrong
  static constexpr int kLookEvery = 4;          // frame, at the depth image as a whole
  static constexpr std::size_t kFewest = 30;    // keypoints that say something

  /// Rises by one with each frame that looks wrong and falls by two with each that does not.
  class Doubt {
   public:
    explicit Doubt(int many) noexcept : many_(many) {}
    void count(bool looks_wrong) noexcept { frames_ = std::clamp(frames_ + (looks_wrong ? 1 : -2), 0, 2 * many_); }
    bool is_strong() const noexcept { return frames_ >= many_; }

   private:
    int many_, frames_ = 0;
  };

  /// Intrinsics of another resolution are off in x and in y, a cropped image mostly in one of them.
  static bool is_aside(double principal_px, int size_px) noexcept {
    return std::abs(principal_px / size_px - 0.5) > kAside;
  }

  void count_places(int width, int height, span<const Vector2f> pixels) noexcept {
    if (pixels.size() < kFewest) return;
    std::size_t outside = 0, quarter[4] = {};
    for (const Vector2f& pixel : pixels) {
      const bool is_inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < static_cast<float>(width) &&
                             pixel.y() < static_cast<float>(height);
      if (is_inside)
        ++quarter[(2 * pixel.x() < static_cast<float>(width) ? 0 : 1) +
                  (2 * pixel.y() < static_cast<float>(height) ? 0 : 2)];
      else
        ++outside;
    }
    outside_.count(2 * outside > pixels.size());
    in_one_quarter_.count(std::find(quarter, quarter + 4, pixels.size()) != quarter + 4);
  }

  void count_depths(span<const double> depth_m) noexcept {
    std::size_t known = 0, far = 0;
    for (const double depth : depth_m) {
      known += depth > 0;
      far += depth > kNear_m;
    }
    if (known >= kFewest) depth_too_near_.count(20 * far < known);
  }

  Doubt depth_too_near_{kMany}, motion_too_fast_{kMany}, scale_differs_{kMany}, in_one_quarter_{kMany}, outside_{kMany},
      times_far_apart_{kMany}, nothing_fits_{kMany}, depth_shape_differs_{kMany}, principal_point_aside_{kMany};
  Doubt depth_turned_over_{kMany / kLookEvery};
  unsigned frames_ = 0;
};

}  // namespace stillpoint
