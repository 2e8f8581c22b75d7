// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A non-owning view of an image, whoever owns it, and an owning buffer for the frames that the filter remembers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

enum class PixelFormat : std::uint8_t {
  none,         ///< no image
  gray8,        ///< one byte per pixel
  bgr8,         ///< three bytes per pixel, blue first
  depth16,      ///< unsigned 16 bit, scaled by a factor
  depth32f,     ///< float metres
  unsupported,  ///< an image of some other type: the frame gets `Status::unsupported_image`
};

inline std::size_t bytes_per_pixel(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::gray8: return 1;
    case PixelFormat::bgr8: return 3;
    case PixelFormat::depth16: return 2;
    case PixelFormat::depth32f: return 4;
    default: return 0;
  }
}

struct ImageView;

/// How a foreign image type is read: specialise with `static ImageView view(const Image&)`. `cv::Mat` is in opencv.hpp.
template <class Image, class = void>
struct image_traits;

/// Rows of pixels that belong to somebody else. Row `v` begins at `data + v * stride_bytes`.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  std::size_t stride_bytes = 0;
  PixelFormat format = PixelFormat::none;

  ImageView() = default;
  ImageView(const void* pixels, int columns, int rows, std::size_t stride, PixelFormat pixel_format) noexcept
      : data(static_cast<const std::uint8_t*>(pixels)),
        width(columns),
        height(rows),
        stride_bytes(stride),
        format(pixel_format) {}
  template <class Image, class = decltype(image_traits<Image>::view(std::declval<const Image&>()))>
  ImageView(const Image& image) : ImageView(image_traits<Image>::view(image)) {}

  bool empty() const noexcept { return data == nullptr || width <= 0 || height <= 0; }
  /// What grows with the image is a share of it: the same for a camera on its side.
  int longer_side_px() const noexcept { return std::max(width, height); }
  bool contains(int u, int v) const noexcept { return u >= 0 && v >= 0 && u < width && v < height; }
  /// Distance to the nearest border pixel, negative outside, NaN for NaN. Pixels have integer centres.
  float border_distance_px(float u, float v) const noexcept {
    if (std::isnan(u) || std::isnan(v)) return std::numeric_limits<float>::quiet_NaN();
    return std::min(std::min(u, static_cast<float>(width - 1) - u), std::min(v, static_cast<float>(height - 1) - v));
  }

  template <class T>
  const T* row(int v) const noexcept {
    return reinterpret_cast<const T*>(data + static_cast<std::size_t>(v) * stride_bytes);
  }
};

/// Owns a copy of an image, rows without gaps. Its memory is reused when an image of the same size follows.
class ImageBuffer {
 public:
  [[gnu::noinline]] void resize(int width, int height, PixelFormat format) {
    width_ = width;
    height_ = height;
    format_ = format;
    stride_bytes_ = static_cast<std::size_t>(width) * bytes_per_pixel(format);
    pixels_.resize(static_cast<std::size_t>(height) * stride_bytes_);
  }

  void assign(const ImageView& image) {
    if (image.empty()) return resize(0, 0, PixelFormat::none);
    resize(image.width, image.height, image.format);
    for (int v = 0; v < height_; ++v) std::memcpy(row<std::uint8_t>(v), image.row<std::uint8_t>(v), stride_bytes_);
  }

  ImageView view() const noexcept {
    return pixels_.empty() ? ImageView() : ImageView(pixels_.data(), width_, height_, stride_bytes_, format_);
  }

  template <class T>
  T* row(int v) noexcept {
    return reinterpret_cast<T*>(pixels_.data() + static_cast<std::size_t>(v) * stride_bytes_);
  }

 private:
  std::vector<std::uint8_t> pixels_;
  int width_ = 0;
  int height_ = 0;
  std::size_t stride_bytes_ = 0;
  PixelFormat format_ = PixelFormat::none;
};

/// Luma of a BGR image: 0.114 B + 0.587 G + 0.299 R in 15-bit fixed point (ITU-R BT.601; byte for byte what OpenCV
/// gives).
inline void gray_from_bgr(const ImageView& colour, ImageBuffer& gray) {
  gray.resize(colour.width, colour.height, PixelFormat::gray8);
  for (int v = 0; v < colour.height; ++v) {
    const std::uint8_t* bgr = colour.row<std::uint8_t>(v);
    std::uint8_t* const out = gray.row<std::uint8_t>(v);
    for (int u = 0; u < colour.width; ++u, bgr += 3)
      out[u] = static_cast<std::uint8_t>((bgr[0] * 3735 + bgr[1] * 19235 + bgr[2] * 9798 + 16384) >> 15);
  }
}

/// Whether width by height of two images is the same, to a row lost to rounding when one was made smaller.
inline bool have_same_shape(const ImageView& a, const ImageView& b) noexcept {
  constexpr double kTolerance = 0.01;
  const double ratio = static_cast<double>(a.width) * b.height / (static_cast<double>(a.height) * b.width);
  return std::abs(ratio - 1.0) <= kTolerance;
}

}  // namespace stillpoint
