// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Images from files, whole or not at all.

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint {

namespace detail {

/// Whether a JPEG reaches its end (ITU-T T.81, B.1). What lies behind it, such as a phone's video, is not looked at.
inline bool is_whole_jpeg(std::string_view bytes) {
  const auto byte = [bytes](std::size_t i) -> std::size_t { return static_cast<unsigned char>(bytes[i]); };
  std::size_t at = 2;
  while ((at = bytes.find('\xff', at)) != bytes.npos && at + 1 < bytes.size()) {
    const std::size_t marker = byte(at + 1);
    const bool stands_alone = marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd7);  // 0, in a scan, is no marker
    if (marker == 0xd9) return true;
    if (marker == 0xff)  // fills up
      at += 1;
    else if (stands_alone || at + 3 >= bytes.size())
      at += 2;
    else
      at += 2 + (byte(at + 2) << 8) + byte(at + 3);
  }
  return false;
}

/// False for a PNG or JPEG that breaks off. Decoders fill up what is missing of a JPEG with gray and say nothing.
inline bool is_whole_image(std::string_view bytes) {
  if (bytes.substr(0, 4) == "\x89PNG") return bytes.rfind("IEND") != bytes.npos;
  if (bytes.substr(0, 2) == "\xff\xd8") return is_whole_jpeg(bytes);
  return true;  // some other format: its decoder decides
}

}  // namespace detail

/// Reads an image as it is in the file: not turned by what a camera noted in it.
/// @param flags  `cv::IMREAD_COLOR`, `cv::IMREAD_UNCHANGED`, ...
/// @return        never empty.
/// @throws Error if the file is missing, breaks off, or is no image; unless all of it was asked for, if it has more
/// than
///         8 bit: of 10 in 16, OpenCV would keep the upper 8, almost black.
inline cv::Mat read_image(const std::filesystem::path& file, int flags) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) throw Error(file.string() + ": no such file");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  cv::Mat image;
  std::string reason;
  if (!bytes.empty() && detail::is_whole_image(bytes)) {
    try {
      if (flags != cv::IMREAD_UNCHANGED)  // (-1) implies both
        flags |= cv::IMREAD_IGNORE_ORIENTATION | cv::IMREAD_ANYDEPTH;
      image = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data()), flags);
    } catch (const cv::Exception& error) {
      reason = " (" + error.err + ")";
    }
  }
  if (image.empty()) throw Error(file.string() + ": cannot be read, expected a whole PNG or JPEG image" + reason);
  if (flags != cv::IMREAD_UNCHANGED && image.depth() != CV_8U)
    throw Error(file.string() + ": found an image of more than 8 bit, expected 8");
  return image;
}

/// @throws Error naming the file unless the image has the camera's size.
inline void require_size(const std::filesystem::path& file, const cv::Mat& image, const Camera& camera) {
  if (image.cols == camera.width() && image.rows == camera.height()) return;
  const auto size = [](int width, int height) { return std::to_string(width) + " x " + std::to_string(height); };
  throw Error(file.string() + ": found " + size(image.cols, image.rows) + " pixels, expected the camera's " +
              size(camera.width(), camera.height()));
}

}  // namespace stillpoint
