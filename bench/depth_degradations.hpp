// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What sensors, their drivers and a wrong set-up do to the depth images of a recording.

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "degradations.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/synthetic/noise.hpp"

namespace stillpoint::bench {

/// Depth 0 in blobs of some 30 px, half of the image: where a smooth field of Gaussian noise, new in each frame, is
/// positive.
inline Degradation holes(std::uint64_t seed) {
  return [random = Random(seed)](RawFrame& frame) mutable {
    constexpr int kCell_px = 4;
    cv::Mat field((frame.depth.rows + kCell_px - 1) / kCell_px, (frame.depth.cols + kCell_px - 1) / kCell_px, CV_32FC1);
    synthetic::NormalStream normal(detail::normal_table(), random.bits());
    for (int v = 0; v < field.rows; ++v)
      for (int u = 0; u < field.cols; ++u) field.at<float>(v, u) = normal.next();
    constexpr double kSmooth_cells = 3.0;
    cv::GaussianBlur(field, field, cv::Size(), kSmooth_cells);
    for (int v = 0; v < frame.depth.rows; ++v)
      for (int u = 0; u < frame.depth.cols; ++u)
        if (field.at<float>(v / kCell_px, u / kCell_px) > 0) frame.depth.at<std::uint16_t>(v, u) = 0;
  };
}

/// Holes filled with the depth on their left, as cameras' hole filling does.
inline Degradation filled() {
  return [](RawFrame& frame) {
    for (int v = 0; v < frame.depth.rows; ++v) {
      std::uint16_t* const row = frame.depth.ptr<std::uint16_t>(v);
      for (int u = 1; u < frame.depth.cols; ++u)
        if (row[u] == 0) row[u] = row[u - 1];
    }
  };
}

/// A temporal filter as cameras have: depth that changes by less than 2 % goes on from six tenths of what it was, and a
/// hole keeps what was there for three frames.
inline Degradation smoothed() {
  constexpr int kKept = 3;
  return [last = cv::Mat(), kept = cv::Mat()](RawFrame& frame) mutable {
    if (last.empty()) {
      last = frame.depth.clone();
      kept = cv::Mat::zeros(frame.depth.size(), CV_8UC1);
      return;
    }
    for (int v = 0; v < frame.depth.rows; ++v)
      for (int u = 0; u < frame.depth.cols; ++u) {
        std::uint16_t& now = frame.depth.at<std::uint16_t>(v, u);
        std::uint16_t& before = last.at<std::uint16_t>(v, u);
        std::uint8_t& age = kept.at<std::uint8_t>(v, u);
        if (now != 0)
          age = 0;
        else if (before != 0 && age++ < kKept)
          now = before;
        else
          before = 0;
        if (now == 0) continue;
        if (before != 0 && age == 0 && std::abs(int{now} - int{before}) < 0.02 * now)
          now = cv::saturate_cast<std::uint16_t>(0.4 * now + 0.6 * before);
        before = now;
      }
  };
}

/// Near surfaces grow by half a window of 9 × 9 px, as in depth from stereo that compares blocks: what is beside them
/// gets their depth.
inline Degradation fattened() {
  return [](RawFrame& frame) {
    constexpr int kWindow_px = 9;
    constexpr std::uint16_t kFarthest = 65535;
    frame.depth.setTo(kFarthest, frame.depth == 0);
    cv::erode(frame.depth, frame.depth, cv::Mat::ones(kWindow_px, kWindow_px, CV_8UC1));
    frame.depth.setTo(0, frame.depth == kFarthest);
  };
}

/// Each frame has the depth image of the frame before.
inline Degradation late_depth() {
  return [last = cv::Mat()](RawFrame& frame) mutable {
    cv::Mat now = frame.depth.clone();
    if (!last.empty()) frame.depth = last;
    last = now;
  };
}

/// Depth moved to the right, as where it is not aligned with the colour image.
inline Degradation shifted_depth() {
  return [](RawFrame& frame) {
    constexpr int kShift_px = 5;
    cv::Mat shifted = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
    frame.depth.colRange(0, frame.depth.cols - kShift_px).copyTo(shifted.colRange(kShift_px, shifted.cols));
    frame.depth = shifted;
  };
}

/// No depth where a projector beside the camera, 75 mm to the right, does not see the point: what is farther to the
/// right in the camera's row, but not in the projector's, hides it.
inline Degradation shadow(double focal_px) {
  return [focal_px](RawFrame& frame) {
    constexpr double kBaseline_m = 0.075;
    for (int v = 0; v < frame.depth.rows; ++v) {
      std::uint16_t* const row = frame.depth.ptr<std::uint16_t>(v);
      double leftmost = 1e9;  // column minus disparity of what lies to the right
      for (int u = frame.depth.cols - 1; u >= 0; --u) {
        if (row[u] == 0) continue;
        const double seen_at = u - focal_px * kBaseline_m * frame.depth_factor / row[u];
        if (seen_at > leftmost)
          row[u] = 0;
        else
          leftmost = seen_at;
      }
    }
  };
}

/// Flying pixels: within 2 px of a depth edge of more than 10 σ half of the depths are a mean of both sides.
inline Degradation flying(std::uint64_t seed) {
  return [random = Random(seed)](RawFrame& frame) mutable {
    const cv::Mat depth = frame.depth.clone();
    cv::Mat edge = cv::Mat::zeros(depth.size(), CV_8UC1);
    const KinectNoise sensor;
    const auto differ = [&](std::uint16_t a, std::uint16_t b) {
      if (a == 0 || b == 0) return false;
      const double nearer_m = std::min(a, b) / frame.depth_factor;
      return std::abs(int{a} - int{b}) / frame.depth_factor > 10.0 * sensor.sigma(nearer_m);
    };
    for (int v = 0; v + 1 < depth.rows; ++v)
      for (int u = 0; u + 1 < depth.cols; ++u) {
        const std::uint16_t here = depth.at<std::uint16_t>(v, u);
        if (differ(here, depth.at<std::uint16_t>(v, u + 1)))
          edge.at<std::uint8_t>(v, u) = edge.at<std::uint8_t>(v, u + 1) = 1;
        if (differ(here, depth.at<std::uint16_t>(v + 1, u)))
          edge.at<std::uint8_t>(v, u) = edge.at<std::uint8_t>(v + 1, u) = 1;
      }
    constexpr int kReach_px = 2;
    cv::dilate(edge, edge, cv::Mat::ones(2 * kReach_px - 1, 2 * kReach_px - 1, CV_8UC1));
    for (int v = kReach_px; v < depth.rows - kReach_px; ++v)
      for (int u = kReach_px; u < depth.cols - kReach_px; ++u) {
        if (edge.at<std::uint8_t>(v, u) == 0 || depth.at<std::uint16_t>(v, u) == 0 || random.uniform() < 0.5) continue;
        double nearest = 1e9, farthest = 0;
        for (int j = -kReach_px; j <= kReach_px; ++j)
          for (int i = -kReach_px; i <= kReach_px; ++i) {
            const double there = depth.at<std::uint16_t>(v + j, u + i);
            if (!(there > 0)) continue;
            nearest = std::min(nearest, there);
            farthest = std::max(farthest, there);
          }
        const double weight = random.uniform();
        frame.depth.at<std::uint16_t>(v, u) =
            cv::saturate_cast<std::uint16_t>(weight * nearest + (1.0 - weight) * farthest);
      }
  };
}

}  // namespace stillpoint::bench
