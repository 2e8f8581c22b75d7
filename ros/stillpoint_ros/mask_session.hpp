// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One camera's frames through the filter: the masks and the depth that a node publishes.   frame → masks

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/options.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/verdict/masked_depth.hpp"
#include "stillpoint_ros/camera_info.hpp"
#include "stillpoint_ros/frame_pairing.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_ros {

/// What comes, how masks are made of verdicts, and whether movers are followed.
struct MaskOptions {
  int features = 1000;                    ///< ORB keypoints per frame, which the filter judges
  int margin_px = 8;                      ///< more is dropped around moving objects
  double depth_units_per_metre = 1000.0;  ///< of 16-bit depth; ROS (REP 118) says millimetres
  bool follow_movers = false;             ///< answers have movers
  bool rectified = false;                 ///< the images are: the camera is P of camera_info, not K and D
};

template <class Visit>
void each_option(MaskOptions& options, Visit& visit) {
  visit("features", options.features, stillpoint::OptionRange{1, 100000});
  visit("margin_px", options.margin_px, stillpoint::OptionRange{0, 1000});
  visit("depth_units_per_metre", options.depth_units_per_metre,
        stillpoint::OptionRange{stillpoint::DepthView::kLeastFactor, stillpoint::DepthView::kMostFactor});
  visit("follow_movers", options.follow_movers);
  visit("rectified", options.rectified);
}

/// What is said of one frame. The images belong to the session and hold until its next frame.
struct FrameAnswer {
  stillpoint::Status status = stillpoint::Status::first_frame;
  const char* hint = "";  ///< what is probably wrong with the input; empty where nothing is
  std::size_t features = 0, kept = 0;
  std::size_t objects = 0;  ///< of a detector, that are known in this frame
  double filter_ms = 0.0;
  stillpoint::ImageView mask;          ///< gray8 of the image's size: 255 keeps, 0 drops
  stillpoint::ImageView mask_inverse;  ///< 0 keeps, 255 drops
  stillpoint::ImageView depth;         ///< the frame's depth, 0 where the mask drops
  stillpoint::span<const stillpoint::Mover> movers;
};

/// The filter and its memory of one camera. Not for two threads.
class MaskSession {
 public:
  MaskOptions options;
  /// Its camera comes with the first frame.
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter{stillpoint::Camera(1, 1, 0, 0, 1, 1)};

  /// Judges a frame and paints its masks: everything is kept where the frame can't be judged.
  /// @throws stillpoint::Error where a message can't be read; the session is as before
  const FrameAnswer& process(const PairedFrame& frame) {
    const cv::Mat image = read("image", [&] { return image_of(frame.image); });
    const cv::Mat depth = read("depth", [&] { return depth_of(frame.depth); });
    const bool is_other_camera = use_camera(frame.camera);
    filter.movers.is_enabled = options.follow_movers;
    cv::Mat gray = image;
    if (image.channels() == 3) cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
    find_keypoints(gray);

    stillpoint::FrameView view(gray, stillpoint::DepthView(depth, options.depth_units_per_metre), frame.image.stamp_s);
    if (image.channels() == 3) view.colour = image;
    const stillpoint::FrameResult& result = filter.filter_frame(view, keypoints_);
    answer_.status = result.status();
    answer_.hint =
        is_other_camera ? "camera_info is of another camera than before: the filter began anew." : result.hint();
    answer_.features = result.size();
    answer_.kept = result.kept_count();
    answer_.movers = result.movers();
    answer_.objects = filter.prior.objects().size();
    answer_.filter_ms = result.timings().total_ms();
    paint(view);
    return answer_;
  }

 private:
  /// The mask of the moment after this frame is that of the frame: no feature goes a tenth of a pixel until then.
  static constexpr double kMomentAfter_s = 1e-4;

  template <class Read>
  static cv::Mat read(const char* what, Read&& pixels) {
    try {
      return pixels();
    } catch (const stillpoint::Error& error) {
      throw stillpoint::Error(std::string(what) + ": " + error.what());
    }
  }

  /// @return whether it is another camera than the last frame's: the filter begins anew
  bool use_camera(const CameraInfo& info) {
    const stillpoint::Camera camera = camera_of(info, options.rectified);
    const bool had_camera = std::exchange(has_camera_, true);
    if (had_camera && show_alike(filter.camera, camera)) return false;
    filter.camera = camera;
    filter.reset();
    return had_camera;
  }

  void find_keypoints(const cv::Mat& gray) {
    if (!orb_ || orb_->getMaxFeatures() != options.features) orb_ = cv::ORB::create(options.features);
    orb_->detect(gray, keypoints_);
  }

  /// Surfaces, not discs around keypoints: a coat without texture has no keypoint.
  void paint(const stillpoint::FrameView& frame) {
    if (stillpoint::judged(answer_.status))
      filter.predicted_keep_mask(frame.timestamp_s + kMomentAfter_s, options.margin_px, mask_);
    else
      stillpoint::keep_everywhere(frame.image().width, frame.image().height, mask_);
    answer_.mask = mask_.view();
    inverse_.assign(answer_.mask);
    for (int v = 0; v < answer_.mask.height; ++v) {
      std::uint8_t* const row = inverse_.row<std::uint8_t>(v);
      for (int u = 0; u < answer_.mask.width; ++u) row[u] = static_cast<std::uint8_t>(255 - row[u]);
    }
    answer_.mask_inverse = inverse_.view();
    stillpoint::masked_depth(frame.depth, answer_.mask, depth_);
    answer_.depth = depth_.view();
  }

  bool has_camera_ = false;
  cv::Ptr<cv::ORB> orb_;
  std::vector<cv::KeyPoint> keypoints_;
  stillpoint::ImageBuffer mask_, inverse_, depth_;
  FrameAnswer answer_;
};

}  // namespace stillpoint_ros
