// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A smooth random texture that can be sampled anywhere: its images under any map are exact.

#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::test {

/// A sum of waves of 7 to 105 pixels' length, gray levels 128 ± 50 or so.
class WaveTexture {
 public:
  explicit WaveTexture(std::uint64_t seed) {
    Random random(seed);
    for (auto& wave : waves_) {
      const double length_px = 7.0 * std::pow(15.0, random.uniform()), direction = random.uniform(0.0, 6.2831853);
      const double frequency = 6.2831853 / length_px;
      wave = {frequency * std::cos(direction), frequency * std::sin(direction), random.uniform(0.0, 6.2831853)};
    }
  }

  double at(const Vector2d& p) const {
    double sum = 0;
    for (const auto& [wx, wy, phase] : waves_) sum += std::sin(wx * p.x() + wy * p.y() + phase);
    return 128.0 + 15.0 * sum;
  }

  /// The image whose pixel x shows the texture at map(x).
  template <class Map>
  cv::Mat image(int width, int height, const Map& map) const {
    cv::Mat image(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(at(map({u, v})));
    return image;
  }

  /// What lies at x in the texture appears at x + shift.
  cv::Mat shifted(int width, int height, const Vector2d& shift) const {
    return image(width, height, [&](const Vector2d& x) -> Vector2d { return x - shift; });
  }

 private:
  std::vector<std::array<double, 3>> waves_ = std::vector<std::array<double, 3>>(24);
};

}  // namespace stillpoint::test
