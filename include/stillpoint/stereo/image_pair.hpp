// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is asked of the two images of a pair.

#include <opencv2/core.hpp>

#include <string>

#include "stillpoint/core/error.hpp"

namespace stillpoint::detail {

/// @throws Error that names the image which `fits` refuses.
/// @param expected  what would fit, in words
template <class Fits>
void require_pair(const cv::Mat& left, const cv::Mat& right, const std::string& expected, Fits&& fits) {
  for (const cv::Mat* image : {&left, &right})
    if (!fits(*image))
      throw Error(std::string("stereo: found a ") + (image == &left ? "left" : "right") + " image of " +
                  std::to_string(image->cols) + " x " + std::to_string(image->rows) + " pixels and " +
                  std::to_string(image->channels()) + " channel(s), expected " + expected);
}

}  // namespace stillpoint::detail
