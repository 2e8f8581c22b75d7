// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace look_alikes {

/// Frame of ORB-SLAM3 when its constructor is done: a grid of 8 x 6 cells of 80 pixels, no landmarks yet. Entry i has
/// the tag i in each array.
struct FinishedOrbFrame {
  static constexpr int kColumns = 8, kRows = 6;
  std::vector<cv::KeyPoint> mvKeys, mvKeysUn;
  std::vector<float> mvuRight, mvDepth;
  cv::Mat mDescriptors;
  std::vector<int*> mvpMapPoints;
  std::vector<bool> mvbOutlier;
  std::vector<std::size_t> mGrid[kColumns][kRows];
  int N;

  explicit FinishedOrbFrame(int count) : mDescriptors(count, 32, CV_8UC1), N(count) {
    for (int i = 0; i < count; ++i) {
      mvKeys.emplace_back(static_cast<float>(i * 37 % 640), static_cast<float>(i * 53 % 480), 31.0f, -1.0f, 0.0f, 0, i);
      mvuRight.push_back(static_cast<float>(i));
      mvDepth.push_back(static_cast<float>(i));
      mDescriptors.row(i).setTo(i);
      cell_of(mvKeys.back()).push_back(static_cast<std::size_t>(i));
    }
    mvKeysUn = mvKeys;
    mvpMapPoints.assign(mvKeys.size(), nullptr);
    mvbOutlier.assign(mvKeys.size(), false);
  }

  std::vector<std::size_t>& cell_of(const cv::KeyPoint& keypoint) {
    return mGrid[static_cast<int>(keypoint.pt.x) / 80][static_cast<int>(keypoint.pt.y) / 80];
  }

  /// Do all arrays have N entries with the same tags, and is the grid that of a Frame made of them?
  bool is_consistent() {
    const auto count = static_cast<std::size_t>(N);
    if (mvKeys.size() != count || mvKeysUn.size() != count || mvuRight.size() != count || mvDepth.size() != count ||
        mDescriptors.rows != N || mvpMapPoints.size() != count || mvbOutlier.size() != count)
      return false;
    FinishedOrbFrame again(0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto tag = static_cast<float>(mvKeys[i].class_id);
      const auto row = static_cast<int>(i);
      if (mvKeysUn[i].class_id != mvKeys[i].class_id || mvuRight[i] != tag || mvDepth[i] != tag ||
          mDescriptors.at<unsigned char>(row, 31) != cv::saturate_cast<unsigned char>(tag) || mvpMapPoints[i])
        return false;
      again.cell_of(mvKeys[i]).push_back(i);
    }
    return has_grid_of(again);
  }

  bool has_grid_of(const FinishedOrbFrame& other) const {
    for (int u = 0; u < kColumns; ++u)
      for (int v = 0; v < kRows; ++v)
        if (mGrid[u][v] != other.mGrid[u][v]) return false;
    return true;
  }

  friend bool operator==(const FinishedOrbFrame& a, const FinishedOrbFrame& b) {
    return a.N == b.N && a.mvuRight == b.mvuRight && a.has_grid_of(b);
  }
};

}  // namespace look_alikes
