// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Trackers made of OpenCV alone: keypoints with descriptors, or points followed by Lucas-Kanade.
//
// `Features` is what Backend::extract may return (stillpoint/filtered_tracker.hpp).

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint::opencv_tracker {

/// A frame's features. Descriptors and ids are filled or left empty.
/// @tparam Keypoint cv::KeyPoint or cv::Point2f
template <class Keypoint = cv::KeyPoint>
struct Features {
  std::vector<Keypoint> keypoints;  ///< pixels of the image as it is
  cv::Mat descriptors;              ///< one row a keypoint, or empty
  std::vector<int> ids;             ///< one per keypoint, or empty

  /// @throws Error that names the array if one has another size than `keep`; then nothing was changed. O(n).
  void compact(span<const std::uint8_t> keep) {
    compact_host_arrays("opencv_tracker", keep, host_array("keypoints", keypoints),
                        optional_host_array("descriptors", descriptors), optional_host_array("ids", ids));
  }
};

/// Takes what Lucas-Kanade lost out of the flags, so that one compaction drops both.
/// @param status  of cv::calcOpticalFlowPyrLK: 0 where a point was lost
/// @param keep    one byte a point; becomes 0 where `status` is
/// @throws Error if they are not of one size
inline void drop_lost(span<const std::uint8_t> status, std::vector<std::uint8_t>& keep) {
  if (status.size() != keep.size())
    throw Error("opencv_tracker: status has " + std::to_string(status.size()) +
                " entries, expected one for each of the " + std::to_string(keep.size()) + " keep flags");
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (status[i] == 0) keep[i] = 0;
}

/// Compacts the points of both frames together with what belongs to them, in order.
/// @param keep      one byte a point, 0 drops
/// @param previous  points in the last image
/// @param current   the same points in this one
/// @param more      errors, ids, ages: arrays with one entry a point
/// @return how many are left
/// @throws Error if an array has another size than `keep`; then nothing was changed. O(n).
template <class Points, class... MoreArrays>
std::size_t compact_tracks(span<const std::uint8_t> keep, Points& previous, Points& current, MoreArrays&... more) {
  return compact_host_arrays("opencv_tracker", keep, host_array("previous points", previous),
                             host_array("current points", current), host_array("a further array", more)...);
}

/// The mask of cv::Feature2D::detect and cv::goodFeaturesToTrack: 0 drops, 255 keeps, the filter's own polarity. Holds
/// as long as the mask's pixels do.
/// @param mask  gray8, 255 keeps
/// @throws Error unless the mask is gray8
inline cv::Mat detection_mask_0_drops(const ImageView& mask) {
  require_mask("opencv_tracker", mask);
  return as_mat(mask);
}

}  // namespace stillpoint::opencv_tracker
