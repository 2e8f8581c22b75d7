// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// 01_minimal: which features of each frame are static? The frames are rendered: a hand-held RGB-D camera looks at a
// person who walks and at a box that is pushed.

#include <cstdio>
#include <opencv2/features2d.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/synthetic/renderer.hpp>
#include <stillpoint/synthetic/scenes.hpp>
#include <vector>

int main() {
  stillpoint::synthetic::Scene scene = stillpoint::synthetic::demo();
  scene.sensor.depth_factor = 1000.0;  // as RealSense, Azure Kinect and ROS: 16-bit depth in millimetres
  stillpoint::SyntheticSequence sequence(scene);
  stillpoint::SyntheticFrame frame;
  const auto orb = cv::ORB::create(500);
  const stillpoint::Camera& camera = sequence.camera();
  // [filter]
  stillpoint::FrameFilter<> filter(camera);  // DefaultPolicies
  // [filter]
  for (int i = 0; i < sequence.size(); ++i) {
    sequence.render(i, frame);
    const cv::Mat gray = stillpoint::as_mat(frame.gray.view()), depth = stillpoint::as_mat(frame.depth.view());
    const double time = frame.timestamp_s;  // seconds
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    orb->detectAndCompute(gray, cv::noArray(), keypoints, descriptors);
    const std::size_t found = keypoints.size();
    // [filter]
    const auto& result = filter.filter_frame({gray, stillpoint::DepthView::millimetres(depth), time}, keypoints);
    stillpoint::compact(result.keep(), keypoints, descriptors);  // parallel arrays stay aligned
    // [filter]
    std::printf("frame %d: %zu of %zu features are static (%s) %s\n", i, keypoints.size(), found,
                to_string(result.status()), result.hint());
  }
}
