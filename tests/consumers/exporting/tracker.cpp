// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What the host compiles of its own: a filter of the compiled pipeline, and one behind the shim.

#include <opencv2/core.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint_shim.hpp>
#include <vector>

std::size_t count_kept() {
  const cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(100)), depth_m(48, 64, CV_32FC1, cv::Scalar(2.0));
  const std::vector<cv::KeyPoint> keypoints = {{20, 20, 7}, {40, 20, 7}};
  stillpoint::FrameFilter<> filter(stillpoint::Camera(60, 60, 32, 24, 64, 48));
  stillpoint_shim::Camera camera;
  camera.fx = camera.fy = 60, camera.cx = 32, camera.cy = 24, camera.width = 64, camera.height = 48;
  stillpoint_shim::Filter behind_shim(camera);
  return filter.filter_frame({gray, depth_m, 0.0}, keypoints).kept_count() +
         behind_shim.filter_frame(gray, depth_m, 0.0, keypoints).kept_count;
}
