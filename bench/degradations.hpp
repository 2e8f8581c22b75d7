// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What cameras do to the images of a recording: each degradation changes one frame after the other. Images are 8 bit,
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
/// @param mean  below 700: of more, e^−mean is too small for a double
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

/// Depth and labels take the nearest pixel: nothing lies between two surfaces.
inline void resize(RawFrame& frame, const cv::Size& size, int interpolation) {
  cv::resize(frame.colour, frame.colour, size, 0, 0, interpolation);
  for (cv::Mat* const image : {&frame.depth, &frame.labels})
    if (!image->empty()) cv::resize(*image, *image, size, 0, 0, cv::INTER_NEAREST);
}

/// A pixel is a square, whose middle has whole coordinates.
inline Camera resized(const Camera& camera, double scale) {
  const auto length = [scale](int px) { return static_cast<int>(scale * px); };
  return Camera(camera.fx() * scale, camera.fy() * scale, (camera.cx() + 0.5) * scale - 0.5,
                (camera.cy() + 0.5) * scale - 0.5, length(camera.width()), length(camera.height()),
                camera.distortion());
}

}  // namespace detail

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
  for (int value = 0; value <= 64; ++value) quantiles.push_back(detail::poisson_quantiles(kPhotons * value));
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
  return [](RawFrame& frame) { detail::resize(frame, frame.colour.size() / 2, cv::INTER_AREA); };
}

/// Twice the size: the image by cubic interpolation, depth and labels each pixel four times. The camera is
/// `double_sized`.
inline Degradation doubled() {
  return [](RawFrame& frame) { detail::resize(frame, frame.colour.size() * 2, cv::INTER_CUBIC); };
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

inline Camera half_sized(const Camera& camera) { return detail::resized(camera, 0.5); }
inline Camera double_sized(const Camera& camera) { return detail::resized(camera, 2.0); }

/// A camera file with a focal length that is 2 % too large.
inline Camera wrong_focal(const Camera& camera) {
  return Camera(1.02 * camera.fx(), 1.02 * camera.fy(), camera.cx(), camera.cy(), camera.width(), camera.height(),
                camera.distortion());
}

}  // namespace stillpoint::bench
