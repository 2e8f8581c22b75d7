// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What cameras do to a recording: each degradation changes the images of one frame after the other. Images are 8 bit,
// clipped and rounded after each step.

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/synthetic/noise.hpp"

namespace stillpoint::bench {

/// A frame as it is read from a file.
struct RawFrame {
  cv::Mat colour;  ///< CV_8UC3, BGR
  cv::Mat depth;   ///< CV_16UC1, of the size of `colour`, 0 none
  cv::Mat labels;  ///< CV_8UC1, values of `PixelLabel`; empty where there are none
  double depth_factor = 5000.0;
  std::size_t index = 0;  ///< in the recording
};

/// Changes one frame after the other, in the order of time.
using Degradation = std::function<void(RawFrame&)>;

namespace detail {

inline const synthetic::NormalTable& normal_table() {
  static const synthetic::NormalTable table;
  return table;
}

/// Every channel of every pixel through a table of its 256 values.
inline void map_values(cv::Mat& image, const std::function<double(double)>& function) {
  cv::Mat table(1, 256, CV_8UC1);
  for (int value = 0; value < 256; ++value)
    table.at<std::uint8_t>(value) = cv::saturate_cast<std::uint8_t>(function(value));
  cv::LUT(image, table, image);
}

/// Adds N(0, sigma²) to each channel.
inline void add_noise(cv::Mat& image, double sigma, std::uint64_t seed) {
  synthetic::NormalStream normal(normal_table(), seed);
  for (int v = 0; v < image.rows; ++v) {
    std::uint8_t* const row = image.ptr<std::uint8_t>(v);
    for (int k = 0; k < image.cols * image.channels(); ++k)
      row[k] = cv::saturate_cast<std::uint8_t>(static_cast<float>(row[k]) + static_cast<float>(sigma) * normal.next());
  }
}

/// Quantiles of the Poisson distribution of a mean: its values at 1024 probabilities, in the middle of each slice.
inline std::array<std::uint16_t, 1024> poisson_quantiles(double mean) {
  std::array<std::uint16_t, 1024> values{};
  double probability = std::exp(-mean), cumulative = probability;
  std::uint16_t count = 0;
  for (std::size_t slice = 0; slice < values.size(); ++slice) {
    const double wanted = (static_cast<double>(slice) + 0.5) / static_cast<double>(values.size());
    while (cumulative < wanted && count < 4000) {
      ++count;
      probability *= mean / count;
      cumulative += probability;
    }
    values[slice] = count;
  }
  return values;
}

}  // namespace detail

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

/// Something before the lens: in frames 60 to 69 and 120 to 129 the left half is one colour without depth, and has no
/// label for 12 px beside it.
inline Degradation occlude() {
  return [](RawFrame& frame) {
    const bool covered = (frame.index >= 60 && frame.index < 70) || (frame.index >= 120 && frame.index < 130);
    if (!covered) return;
    const int half = frame.colour.cols / 2, beside = std::min(half + 12, frame.colour.cols);
    frame.colour.colRange(0, half).setTo(cv::Scalar(90, 100, 110));
    frame.depth.colRange(0, half).setTo(0);
    if (!frame.labels.empty()) frame.labels.colRange(0, beside).setTo(static_cast<int>(PixelLabel::ignore));
  };
}

/// Exposure that jumps: the gain goes by e^N(0, 0.15) from frame to frame, within 0.5 and 1.6.
inline Degradation flicker(std::uint64_t seed) {
  return [normal = synthetic::NormalStream(detail::normal_table(), seed), gain = 1.0,
          is_first = true](RawFrame& frame) mutable {
    if (!is_first) gain = std::clamp(gain * std::exp(0.15 * static_cast<double>(normal.next())), 0.5, 1.6);
    is_first = false;
    detail::map_values(frame.colour, [&](double value) { return value * gain; });
  };
}

/// A quarter of the light: shot noise of four photons for each gray value, read noise of two, and twice the gain.
inline Degradation dark(std::uint64_t seed) {
  constexpr double kPhotons = 4.0;
  std::vector<std::array<std::uint16_t, 1024>> quantiles;
  for (int value = 0; value < 256; ++value) quantiles.push_back(detail::poisson_quantiles(kPhotons * value));
  return [quantiles, random = Random(seed)](RawFrame& frame) mutable {
    detail::map_values(frame.colour, [](double value) { return value / 4.0; });
    for (int v = 0; v < frame.colour.rows; ++v) {
      std::uint8_t* const row = frame.colour.ptr<std::uint8_t>(v);
      std::uint64_t bits = 0;
      for (int k = 0; k < 3 * frame.colour.cols; ++k) {
        if (k % 6 == 0) bits = random.bits();
        row[k] = cv::saturate_cast<std::uint8_t>(quantiles[row[k]][bits & 1023u] / kPhotons);
        bits >>= 10;
      }
    }
    detail::add_noise(frame.colour, 2.0, random.bits());
    detail::map_values(frame.colour, [](double value) { return 2.0 * value; });
  };
}

inline Degradation blur() {
  return [](RawFrame& frame) { cv::GaussianBlur(frame.colour, frame.colour, cv::Size(), 2.0); };
}

inline Degradation noise(std::uint64_t seed) {
  return [random = Random(seed)](RawFrame& frame) mutable { detail::add_noise(frame.colour, 12.0, random.bits()); };
}

inline Degradation haze() {
  return [](RawFrame& frame) { detail::map_values(frame.colour, [](double value) { return value / 2.0 + 64.0; }); };
}

/// Half the size: the image by area, depth and labels every second pixel. The camera is `half_sized`.
inline Degradation half() {
  return [](RawFrame& frame) {
    const auto every_second = [](cv::Mat& image) {
      if (!image.empty()) cv::resize(image, image, image.size() / 2, 0, 0, cv::INTER_NEAREST);
    };
    cv::resize(frame.colour, frame.colour, frame.colour.size() / 2, 0, 0, cv::INTER_AREA);
    every_second(frame.depth);
    every_second(frame.labels);
  };
}

/// Twice the size: the image by cubic interpolation, depth and labels each pixel four times. The camera is
/// `double_sized`.
inline Degradation doubled() {
  return [](RawFrame& frame) {
    const auto four_times = [](cv::Mat& image) {
      if (!image.empty()) cv::resize(image, image, image.size() * 2, 0, 0, cv::INTER_NEAREST);
    };
    cv::resize(frame.colour, frame.colour, frame.colour.size() * 2, 0, 0, cv::INTER_CUBIC);
    four_times(frame.depth);
    four_times(frame.labels);
  };
}

/// A robot's own bumper, 0.45 m before the camera, in the lowest fifth of the image: patches of some 4 px, the same in
/// each frame. No labels there and for 8 px above it.
inline Degradation bumper() {
  return [texture = cv::Mat()](RawFrame& frame) mutable {
    const int rows = frame.colour.rows / 5, top = frame.colour.rows - rows;
    if (texture.empty()) {
      cv::RNG random(1);
      texture.create(rows / 4, frame.colour.cols / 4, CV_8UC3);
      random.fill(texture, cv::RNG::UNIFORM, 40, 215);
      cv::resize(texture, texture, cv::Size(frame.colour.cols, rows));
    }
    texture.copyTo(frame.colour.rowRange(top, frame.colour.rows));
    frame.depth.rowRange(top, frame.depth.rows).setTo(0.45 * frame.depth_factor);
    if (!frame.labels.empty())
      frame.labels.rowRange(std::max(top - 8, 0), frame.labels.rows).setTo(static_cast<int>(PixelLabel::ignore));
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

/// The camera of images that were halved by area: a pixel's middle lies between those of two.
inline Camera half_sized(const Camera& camera) {
  return Camera(camera.fx() / 2, camera.fy() / 2, (camera.cx() + 0.5) / 2 - 0.5, (camera.cy() + 0.5) / 2 - 0.5,
                camera.width() / 2, camera.height() / 2, camera.distortion());
}

/// The camera of images of twice the size: a pixel is two by two, whose middle lies between theirs.
inline Camera double_sized(const Camera& camera) {
  return Camera(camera.fx() * 2, camera.fy() * 2, (camera.cx() + 0.5) * 2 - 0.5, (camera.cy() + 0.5) * 2 - 0.5,
                camera.width() * 2, camera.height() * 2, camera.distortion());
}

/// A camera file with a focal length that is 2 % too large.
inline Camera wrong_focal(const Camera& camera) {
  return Camera(1.02 * camera.fx(), 1.02 * camera.fy(), camera.cx(), camera.cy(), camera.width(), camera.height(),
                camera.distortion());
}

}  // namespace stillpoint::bench
