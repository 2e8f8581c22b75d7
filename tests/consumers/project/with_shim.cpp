// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host in C++11, compiled for its own machine (-march=native) and with Eigen: before a wall two metres away a square
// moves to the right. It must get rid of the square's features and of no others, in every run the same.

#include <Eigen/Core>
#include <cstdio>
#include <stillpoint_shim.hpp>
#include <vector>

static_assert(__cplusplus == 201103L, "a host in C++11");

const cv::Rect kStart(40, 60, 80, 80);  // of the square
const int kFrames = 8, kStepPx = 6;     // 4.5 cm from frame to frame at 1.5 m

cv::Rect square_in(int frame) { return kStart + cv::Point(kStepPx * frame, 0); }

unsigned char texture(int u, int v) {
  return static_cast<unsigned char>((u / 4 * 73856093 ^ v / 4 * 19349663) >> 7 & 255);
}

/// The keypoints that are left in the last frame.
std::vector<cv::KeyPoint> run() {
  stillpoint_shim::Camera camera;
  camera.fx = camera.fy = 200, camera.cx = 159.5, camera.cy = 119.5, camera.width = 320, camera.height = 240;
  stillpoint_shim::Filter filter(camera);
  std::vector<cv::KeyPoint> keypoints;
  std::vector<Eigen::MatrixXd> of_the_host;  // aligned as the host's instruction set asks for
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Rect square = square_in(frame);
    cv::Mat gray(240, 320, CV_8UC1), depth_m(240, 320, CV_32FC1, cv::Scalar(2.0));
    depth_m(square).setTo(1.5);
    for (int v = 0; v < gray.rows; ++v)
      for (int u = 0; u < gray.cols; ++u)
        gray.at<unsigned char>(v, u) =
            square.contains(cv::Point(u, v)) ? texture(u - square.x + 4000, v - square.y) : texture(u, v);
    keypoints.clear();
    for (int v = 20; v < 220; v += 10)
      for (int u = 20; u < 300; u += 10)
        keypoints.push_back(cv::KeyPoint(static_cast<float>(u), static_cast<float>(v), 7));
    cv::Mat descriptors(static_cast<int>(keypoints.size()), 32, CV_8UC1, cv::Scalar(frame));

    of_the_host.push_back(Eigen::MatrixXd::Constant(33, 33, 1.0));
    const stillpoint_shim::Result& result = filter.filter_frame(gray, depth_m, 1.0 + frame / 30.0, keypoints);
    of_the_host.back() += of_the_host.front();
    std::printf("%s, kept %zu of %zu\n", result.status, result.kept_count, keypoints.size());
    stillpoint_shim::compact(result.keep, keypoints, descriptors);
  }
  return keypoints;
}

int main() {
  const std::vector<cv::KeyPoint> left = run(), left_again = run();
  const cv::Rect square = square_in(kFrames - 1), around(square.x - 15, square.y - 15, 110, 110);
  int on_square = 0, on_wall = 0;  // of 8 × 8 and of 20 × 28 - 11 × 11, 11 × 11 being those on and at the square
  bool same = left.size() == left_again.size();
  for (std::size_t i = 0; i < left.size(); ++i) {
    on_square += square.contains(left[i].pt);
    on_wall += !around.contains(left[i].pt);
    same = same && left[i].pt == left_again[i].pt;
  }
  std::printf("on the square %d of 64, on the wall %d of 439, %s\n", on_square, on_wall,
              same ? "same" : "not the same");
  return on_square < 16 && on_wall == 439 && same ? 0 : 1;
}
