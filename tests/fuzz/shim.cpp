// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The shim as a host in C++11 calls it: images of any type, any settings, boxes and poses, in any order.

#include "shim.hpp"

#include <cstddef>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "bytes.hpp"
#include "frame_images.hpp"
#include "judged_frames.hpp"
#include "stillpoint_shim.hpp"

namespace fuzz {
namespace {

namespace shim = stillpoint_shim;

JudgedFrames frames_of_shim("the shim");

shim::Filter make_shim(Bytes& bytes, int width, int height) {
  shim::Camera camera;
  camera.fx = camera.fy = bytes.number(1, 80);
  camera.cx = bytes.number(0, width);
  camera.cy = bytes.number(0, height);
  camera.width = width;
  camera.height = height;
  camera.lens = static_cast<shim::Lens>(bytes.integer(0, 3));
  if (bytes.flag())
    for (double& coefficient : camera.distortion) coefficient = bytes.number(-0.3, 0.3);
  shim::Settings settings;
  settings.depth_noise = static_cast<shim::DepthNoise>(bytes.integer(0, 3));
  settings.stereo_baseline_m = bytes.number(0, 1);
  settings.false_positive_rate = bytes.number(1e-6, 0.5);
  settings.fewest_features = bytes.integer(-1, 2000);
  settings.depth_factor = settings.fewest_features % 8 == 0 ? bytes.number(-1, 6000) : 5000.0;
  return shim::Filter(camera, settings);
}

/// One that `usual` makes, or any other.
cv::Mat make_image(Bytes& bytes, int width, int height, cv::Mat (*usual)(Bytes&, int, int)) {
  constexpr int kTypes[] = {CV_8UC1, CV_8UC3, CV_16UC1, CV_32FC1, CV_64FC1, CV_8UC4, CV_32SC2};
  const int kind = bytes.integer(0, 40);
  if (kind >= 9 && width > 0 && height > 0) return usual(bytes, width, height);
  if (kind == 0 || kind >= 9) return {};
  if (kind == 1) width = bytes.integer(1, 60);
  cv::Mat image(height, width, kTypes[kind >= 2 ? kind - 2 : 0], cv::Scalar::all(bytes.byte()));
  for (int i = bytes.integer(0, 60); i > 0; --i)
    image.ptr(bytes.byte() % height)[static_cast<std::size_t>(bytes.byte()) % image.step[0]] = bytes.byte();
  return image;
}

}  // namespace

void run_shim(Bytes& bytes) try {
  const int width = bytes.integer(0, 48), height = bytes.integer(0, 48);
  shim::Filter filter = make_shim(bytes, width, height);
  cv::Mat mask;
  double timestamp_s = 1.0;
  for (int frame = 0; frame < 8 && !bytes.empty(); ++frame) {
    timestamp_s = bytes.integer(0, 15) == 0 ? bytes.number(0, 3) : timestamp_s + 0.03125;
    if (bytes.integer(0, 3) == 0) {
      std::vector<shim::Box> boxes(static_cast<std::size_t>(bytes.integer(0, 3)));
      for (shim::Box& box : boxes)
        box = {bytes.single(-5, 40),
               bytes.single(-5, 40),
               bytes.single(-1, 40),
               bytes.single(-1, 40),
               static_cast<shim::Mobility>(bytes.integer(0, 5)),
               bytes.single(0, 1)};
      bytes.flag() ? filter.set_boxes(boxes) : filter.set_boxes(boxes, timestamp_s);
    }
    if (bytes.integer(0, 3) == 0) {
      double pose[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      pose[bytes.byte() % 16] = bytes.number(-1, 1);
      pose[3] = bytes.number(-1, 1);
      filter.feedback(pose);
    }
    if (bytes.integer(0, 7) == 0) {
      shim::Settings settings = filter.settings();
      settings.fewest_features = bytes.integer(-1, 2000);
      settings.depth_factor = bytes.number(-1, 6000);
      filter.change_settings(settings);
    }
    if (bytes.integer(0, 7) == 0) {
      double motion[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      motion[bytes.byte() % 16] = bytes.number(-1, 1);
      filter.expect_motion(motion);
    }
    if (bytes.integer(0, 31) == 0) filter.reset();
    const cv::Mat image = make_image(bytes, width, height, make_gray);
    const cv::Mat depth = make_image(bytes, width, height, make_depth);
    std::vector<cv::Point2f> points;
    for (int v = 0; v < height; v += 5)
      for (int u = 0; u < width; u += 5) points.emplace_back(static_cast<float>(u), static_cast<float>(v));
    for (int i = bytes.integer(0, 9); i > 0; --i) points.emplace_back(bytes.single(-2, 50), bytes.single(-2, 50));
    const shim::Result& result = filter.filter_frame(image, depth, timestamp_s, points);
    frames_of_shim.count(std::strcmp(result.status, "ok") == 0);
    require(result.keep.size() == points.size());
    std::vector<float> weights;
    filter.weights(weights);
    filter.mask(mask, bytes.integer(-3, 60));
    filter.predicted_keep_mask(timestamp_s + 0.03, mask, bytes.integer(-3, 60));
    require(mask.rows == height && mask.cols == width);
  }
} catch (const std::invalid_argument&) {  // settings
}

}  // namespace fuzz
