// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The images of a stereo pair, from their files.

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/io/image_file.hpp"

namespace stillpoint {

/// The two images of a moment, by name.
struct StereoFrame {
  double timestamp_s = 0.0;
  std::filesystem::path left_file, right_file;
};

/// The two images of a moment, as they are in their files.
struct StereoImages {
  cv::Mat left, right;  ///< CV_8UC3, BGR; of a gray file all three channels are equal
};

/// Reads the images of a frame.
/// @throws Error naming the file if one cannot be read or is not of its camera's size.
inline StereoImages load_stereo_images(const StereoFrame& frame, const Camera& left, const Camera& right) {
  StereoImages images{read_image(frame.left_file, cv::IMREAD_COLOR), read_image(frame.right_file, cv::IMREAD_COLOR)};
  require_size(frame.left_file, images.left, left);
  require_size(frame.right_file, images.right, right);
  return images;
}

}  // namespace stillpoint
