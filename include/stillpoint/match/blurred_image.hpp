// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A small, blurred image without its gain and offset.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// Gray values of mean 0 and standard deviation 1, blurred. Pixels are asked for in those of the full-sized image.
class BlurredImage {
 public:
  /// @param gray      8 bit
  /// @param scale     pixels of the full-sized image to one of `gray`
  /// @param blur_px   standard deviation, pixels of `gray`
  void assign(const ImageView& gray, std::size_t scale, float blur_px) {
    width_ = gray.width;
    height_ = gray.height;
    scale_ = static_cast<float>(scale);
    value_.resize(size());
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) value_[index(u, v)] = static_cast<float>(gray.row<std::uint8_t>(v)[u]);
    normalize();
    blur(blur_px);
  }

  /// Means of four of another, blurred once more.
  void assign_half(const BlurredImage& image, float blur_px) {
    width_ = image.width_ / 2;
    height_ = image.height_ / 2;
    scale_ = 2.0f * image.scale_;
    value_.resize(size());
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u)
        value_[index(u, v)] = 0.25f * (image.at(2 * u, 2 * v) + image.at(2 * u + 1, 2 * v) +
                                       image.at(2 * u, 2 * v + 1) + image.at(2 * u + 1, 2 * v + 1));
    blur(blur_px);
  }

  /// Takes the mean around each pixel off, and divides by the standard deviation there: an object in the shade then
  /// says as much as a bright dress before it.
  /// @param reach_px  pixels of this image to each side
  void equalize_contrast(int reach_px) {
    constexpr float kFloor = 0.15f;  // standard deviations of the whole image: a blank wall stays blank
    if (value_.empty()) return;
    squares_.resize(value_.size());
    for (std::size_t i = 0; i < value_.size(); ++i) squares_[i] = value_[i] * value_[i];
    local_mean(value_, reach_px, mean_);
    local_mean(squares_, reach_px, squares_);
    for (std::size_t i = 0; i < value_.size(); ++i) {
      const float variance = std::max(squares_[i] - mean_[i] * mean_[i], 0.0f);
      value_[i] = (value_[i] - mean_[i]) / std::sqrt(variance + kFloor * kFloor);
    }
  }

  void clear() noexcept { width_ = height_ = 0; }
  bool empty() const noexcept { return width_ == 0; }
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  float scale() const noexcept { return scale_; }  ///< pixels of the full-sized image to one of this
  float at(int u, int v) const noexcept { return value_[index(u, v)]; }

  /// A pixel of this image in the full-sized one.
  Vector2f to_full(const Vector2f& pixel) const noexcept {
    return {(pixel.x() + 0.5f) * scale_ - 0.5f, (pixel.y() + 0.5f) * scale_ - 0.5f};
  }

  /// Bilinear value and slope, per pixel of the full-sized image. False outside.
  bool sample(const Vector2f& full_pixel, float& value, Vector2f& slope) const noexcept {
    const float per_px = 1.0f / scale_;
    const Vector2f at_px((full_pixel.x() + 0.5f) * per_px - 0.5f, (full_pixel.y() + 0.5f) * per_px - 0.5f);
    if (!(at_px.x() >= 0 && at_px.y() >= 0 && at_px.x() < static_cast<float>(width_ - 1) &&
          at_px.y() < static_cast<float>(height_ - 1)))
      return false;
    const int u = static_cast<int>(at_px.x()), v = static_cast<int>(at_px.y());
    const float a = at_px.x() - static_cast<float>(u), b = at_px.y() - static_cast<float>(v);
    const float* const above = &value_[index(u, v)];
    const float* const below = above + width_;
    const float left = above[0] + b * (below[0] - above[0]), right = above[1] + b * (below[1] - above[1]);
    value = left + a * (right - left);
    slope = Vector2f(right - left, (1 - a) * (below[0] - above[0]) + a * (below[1] - above[1])) * per_px;
    return true;
  }

 private:
  std::size_t size() const noexcept { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  std::size_t index(int u, int v) const noexcept {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  void normalize() {
    if (value_.empty()) return;
    double sum = 0, squares = 0;
    for (const float value : value_) {
      sum += static_cast<double>(value);
      squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const auto n = static_cast<double>(value_.size());
    const double mean = sum / n;
    constexpr double kLeastVariance = 1.0;  // squared gray values: a blank image stays blank
    const double scale = 1.0 / std::sqrt(std::max(squares / n - mean * mean, kLeastVariance));
    for (float& value : value_) value = static_cast<float>((static_cast<double>(value) - mean) * scale);
  }

  /// Box filters of radius 1, each of variance 2/3, as many as give that of σ.
  void blur(float sigma_px) {
    const int rounds = std::max(1, static_cast<int>(std::lround(sigma_px * sigma_px / (2.0f / 3.0f))));
    buffer_.resize(value_.size());
    for (int round = 0; round < rounds; ++round) {
      for (int v = 0; v < height_; ++v)
        for (int u = 0; u < width_; ++u)
          buffer_[index(u, v)] =
              (at(std::max(u - 1, 0), v) + at(u, v) + at(std::min(u + 1, width_ - 1), v)) * (1.0f / 3.0f);
      for (int v = 0; v < height_; ++v)
        for (int u = 0; u < width_; ++u)
          value_[index(u, v)] = (buffer_[index(u, std::max(v - 1, 0))] + buffer_[index(u, v)] +
                                 buffer_[index(u, std::min(v + 1, height_ - 1))]) *
                                (1.0f / 3.0f);
    }
  }

  /// Means over squares of 2 reach + 1 pixels, of as much as lies within the image. May be in place.
  void local_mean(const std::vector<float>& values, int reach_px, std::vector<float>& means) {
    buffer_.resize(values.size());
    means.resize(values.size());
    const auto width = static_cast<std::size_t>(width_);
    for (int v = 0; v < height_; ++v) running_mean(&values[index(0, v)], width_, 1, reach_px, &buffer_[index(0, v)]);
    for (int u = 0; u < width_; ++u) running_mean(&buffer_[index(u, 0)], height_, width, reach_px, &means[index(u, 0)]);
  }

  /// The same along a line.
  /// @param stride  from one value to the next
  static void running_mean(const float* values, int count, std::size_t stride, int reach_px, float* means) {
    const auto at = [stride](int i) { return static_cast<std::size_t>(i) * stride; };
    float sum = 0;
    for (int i = 0; i < std::min(reach_px, count); ++i) sum += values[at(i)];
    for (int i = 0; i < count; ++i) {
      if (i + reach_px < count) sum += values[at(i + reach_px)];
      if (i - reach_px > 0) sum -= values[at(i - reach_px - 1)];
      const int first = std::max(i - reach_px, 0), last = std::min(i + reach_px, count - 1);
      means[at(i)] = sum / static_cast<float>(last - first + 1);
    }
  }

  int width_ = 0, height_ = 0;
  float scale_ = 1;
  std::vector<float> value_, buffer_, mean_, squares_;
};

}  // namespace stillpoint
