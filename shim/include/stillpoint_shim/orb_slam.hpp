// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// ORB-SLAM2, ORB-SLAM3 and forks: what stillpoint/adapters/orb_slam.hpp has, for a host in C++11. No header of the host
// is included: members are meant by name.   docs/hosts/orb_slam3_shim.diff is the whole change of a host.

#include <algorithm>
#include <cmath>
#include <opencv2/core/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "stillpoint_shim/compact.hpp"
#include "stillpoint_shim/filter.hpp"

namespace stillpoint_shim {
namespace orb_slam {

/// The filter's camera, of Tracking's mK and mDistCoef.
/// @param K           3 x 3, CV_32F
/// @param distortion  k1 k2 p1 p2 and perhaps k3, CV_32F; empty: none
/// @param width       pixels of the image
/// @param height      pixels of the image
/// @throws std::invalid_argument if they have another size or type
inline Camera camera(const cv::Mat& K, const cv::Mat& distortion, int width, int height) {
  if (K.type() != CV_32FC1 || K.rows != 3 || K.cols != 3)
    throw std::invalid_argument("orb_slam: K has another size or type, expected 3x3 float");
  const std::size_t count = distortion.total();
  if (count != 0 && (distortion.type() != CV_32FC1 || (count != 4 && count != 5)))
    throw std::invalid_argument("orb_slam: mDistCoef has " + std::to_string(count) + " values of type " +
                                std::to_string(distortion.type()) + ", expected 4 or 5 floats");
  Camera camera;
  camera.fx = K.at<float>(0, 0);
  camera.fy = K.at<float>(1, 1);
  camera.cx = K.at<float>(0, 2);
  camera.cy = K.at<float>(1, 2);
  camera.width = width;
  camera.height = height;
  if (count != 0) camera.lens = Lens::brown_conrady;
  for (std::size_t i = 0; i < count; ++i) camera.distortion[i] = distortion.at<float>(static_cast<int>(i));
  return camera;
}

/// Settings::fewest_features for the host. Tracking::StereoInitialization wants more than 500 features; later
/// TrackLocalMap wants 30 inliers, and 50 soon after a relocalisation.
/// @param is_initialised  does a map exist already?
inline int fewest_features(bool is_initialised) { return is_initialised ? 50 : 501; }

/// Erases the candidates under a mask before DistributeOctTree shares out the budget of features among them. Stable.
/// @param mask        CV_8UC1 of the image's size, 0 drops; an empty one drops nothing, nor does what is outside of it
/// @param candidates  vToDistributeKeys of one pyramid level: keypoints counted from that level's border
/// @param border_px   minBorderX and minBorderY, pixels of the level
/// @param scale       mvScaleFactor[level]
/// @throws std::invalid_argument if the mask is neither empty nor CV_8UC1
template <class Candidate>
void erase_masked_candidates(const cv::Mat& mask, std::vector<Candidate>& candidates, int border_px, float scale) {
  if (mask.empty()) return;
  if (mask.type() != CV_8UC1) throw std::invalid_argument("orb_slam: the mask is no CV_8UC1 image");
  const float border = static_cast<float>(border_px);
  const auto is_dropped = [&](const Candidate& candidate) {
    const float u = std::round((candidate.pt.x + border) * scale), v = std::round((candidate.pt.y + border) * scale);
    return u >= 0 && v >= 0 && u < static_cast<float>(mask.cols) && v < static_cast<float>(mask.rows) &&  // NaN: no
           mask.at<unsigned char>(static_cast<int>(v), static_cast<int>(u)) == 0;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_dropped), candidates.end());
}

/// Compacts a finished RGB-D Frame, before Track() sees it: mvKeys, mvKeysUn, mvuRight, mvDepth, mDescriptors,
/// mvpMapPoints and mvbOutlier together, in order; mGrid gets the new indices, N the new number.
/// @param keep   Result::keep, one byte per keypoint; all 0 drops none, since a Frame without features is
/// half-initialised
/// @param frame  the host's Frame
/// @return the new N
/// @throws std::invalid_argument if an array has another size than `keep`; then nothing was changed. O(N).
template <class Frame>
std::size_t compact_frame(const std::vector<unsigned char>& keep, Frame& frame) {
  if (std::find_if(keep.begin(), keep.end(), [](unsigned char flag) { return flag != 0; }) == keep.end())
    return keep.size();
  const std::size_t kept = compact(keep, frame.mvKeys, frame.mvKeysUn, frame.mvuRight, frame.mvDepth,
                                   frame.mDescriptors, frame.mvpMapPoints, frame.mvbOutlier);
  frame.N = static_cast<int>(kept);
  const std::vector<int> indices = new_indices(keep);
  for (auto& column : frame.mGrid) {
    for (auto& cell : column) {
      std::size_t left = 0;
      for (std::size_t i = 0; i < cell.size(); ++i)
        if (indices[cell[i]] >= 0) cell[left++] = static_cast<std::size_t>(indices[cell[i]]);
      cell.resize(left);
    }
  }
  return kept;
}

/// Filter::feedback with the host's pose, which is the inverse of what it takes.
/// @param filter             Filter, or what has its member `feedback`
/// @param camera_from_world  Tcw, 4 x 4 with operator()(row, column): mCurrentFrame.GetPose().matrix()
template <class Filter, class Matrix>
bool feedback(Filter& filter, const Matrix& camera_from_world) {
  double world_from_camera[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double rotation = static_cast<double>(camera_from_world(column, row));  // transposed
      world_from_camera[4 * row + column] = rotation;
      world_from_camera[4 * row + 3] -= rotation * static_cast<double>(camera_from_world(column, 3));
    }
  }
  return filter.feedback(world_from_camera);
}

}  // namespace orb_slam
}  // namespace stillpoint_shim
