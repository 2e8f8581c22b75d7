// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small moving picture with a mover in it, for tests that compare runs of the pipeline with each other.

#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/prior/box_prior.hpp"

namespace stillpoint::mock {

/// Three textured walls at 2, 1.5 and 1 m, one below the other (a single plane would not determine F), before a camera
/// that moves sideways by 2 cm; within a box something nearer moves the other way.
/// Every frame has the same number of keypoints.
struct Clip {
  struct Frame {
    cv::Mat gray, depth;
    double time_s = 0;
    std::vector<Vector2f> keypoints, reference_pixels;

    FrameView view() const { return FrameView(gray, DepthView::tum(depth), time_s); }
  };
  static constexpr int kWidth = 160, kHeight = 120;
  static constexpr double kCameraStep_m = 0.02, kFocal_px = 150, kMoverStep_px = -2.0, kMoverDepth_m = 0.9;

  std::vector<Frame> frames;
  std::vector<Detection> detections = {{{60, 30, 40, 60}, Mobility::dynamic, 1.0f}};

  static stillpoint::Camera camera() { return {kFocal_px, kFocal_px, 79.5, 59.5, kWidth, kHeight}; }

  Clip(std::uint64_t seed, int frame_count) {
    Random random(seed);
    std::array<std::array<double, 3>, 24> waves{};
    for (auto& wave : waves) wave = {random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), random.uniform(0, 6.28)};
    for (int f = 0; f < frame_count; ++f) {
      Frame frame;
      frame.time_s = 0.1 * f;
      frame.gray.create(kHeight, kWidth, CV_8UC1);
      frame.depth.create(kHeight, kWidth, CV_16UC1);
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < kWidth; ++u) {
          double sum = 0;
          for (const auto& [wu, wv, phase] : waves) sum += std::sin(wu * (u - f * step_px(u, v)) + wv * v + phase);
          frame.gray.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(128 + 18 * sum);
          const double noise = std::round(20.0 * random.gaussian());
          frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(5000.0 * depth_m(u, v) + noise);
        }
      }
      for (float v = 4; v < kHeight - 4; v += 7.3f) {
        for (float u = 4; u < kWidth - 4; u += 6.9f) {
          frame.keypoints.emplace_back(u + static_cast<float>(random.uniform()), v);
          const double step = step_px(static_cast<int>(u), static_cast<int>(v));
          frame.reference_pixels.emplace_back(frame.keypoints.back().x() - static_cast<float>(step), v);
        }
      }
      frames.push_back(frame);
    }
  }

 private:
  static bool is_mover(int u, int v) { return u > 65 && u < 95 && v > 35 && v < 85; }
  static double depth_m(int u, int v) { return is_mover(u, v) ? kMoverDepth_m : v < 40 ? 2.0 : v < 80 ? 1.5 : 1.0; }
  static double step_px(int u, int v) {
    return is_mover(u, v) ? kMoverStep_px : kFocal_px * kCameraStep_m / depth_m(u, v);
  }
};

/// Every byte of an answer that a host can see, times aside.
struct Answer {
  std::vector<std::uint8_t> bytes;

  bool operator==(const Answer& other) const { return bytes == other.bytes; }

  void add(const FrameResult& result) {
    append(result.status());
    append_matrix(result.motion().current_from_reference.matrix());
    append_matrix(result.motion().covariance);
    for (std::size_t i = 0; i < result.size(); ++i) {
      append(result.keep()[i]);
      append(result.label(i).verdict);
      append(result.label(i).reason);
      append(result.label(i).cluster);
      append(result.label(i).probability);
      append(result.score(i).value);
      append(result.depth_m(i));
    }
  }

 private:
  template <class Value>
  void append(const Value& value) {
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
  }
  template <class Matrix>
  void append_matrix(const Matrix& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) append(matrix.data()[i]);
  }
};

}  // namespace stillpoint::mock
