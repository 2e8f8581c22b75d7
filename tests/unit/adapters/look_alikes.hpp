// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One type for each host, with the members that its adapter names and the rules by which the host reads a mask. Ours,
// written from descriptions of the hosts: what the adapters are tested against where no host is installed.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace look_alikes {

/// How often entries were moved or copied. Set to 0 before an operation.
struct Counter {
  static inline std::size_t moves = 0;
  static inline std::size_t comparisons = 0;
};

/// An entry that counts.
template <class T>
struct Counted {
  T value = {};

  Counted() = default;
  explicit Counted(T v) : value(v) {}
  Counted(const Counted& other) : value(other.value) { ++Counter::moves; }
  Counted& operator=(const Counted& other) {
    value = other.value;
    ++Counter::moves;
    return *this;
  }
};

template <class T>
using Plain = T;

/// Rows in the manner of cv::Mat, that count.
struct CountedRows {
  struct Row {
    Counted<int>* entry;
    template <class Target>
    void copyTo(Target& target) const {
      *target.entry = *entry;
    }
  };
  int rows = 0;
  std::vector<Counted<int>> entries;

  Row row(int i) { return {&entries[static_cast<std::size_t>(i)]}; }
  Row rowRange(int begin, int) { return row(begin); }
  void resize(std::size_t size) {
    entries.resize(size);
    rows = static_cast<int>(size);
  }
};

/// cv::Mat for plain hosts, counting rows for counting ones.
template <template <class> class Element>
using Rows = std::conditional_t<std::is_same_v<Element<int>, int>, cv::Mat, CountedRows>;

/// Frame of ORB-SLAM2 and 3. N is set once and sizes all that follows.
template <template <class> class Element = Plain>
struct OrbFrame {
  std::vector<Element<cv::KeyPoint>> mvKeys, mvKeysUn;
  std::vector<Element<float>> mvuRight, mvDepth;
  Rows<Element> mDescriptors;
  int N = -7;  ///< not set before hook B
};

/// frame_observation of stella_vslam.
template <template <class> class Element = Plain>
struct StellaObservation {
  Rows<Element> descriptors_;
  std::vector<Element<cv::KeyPoint>> undist_keypts_;
  std::vector<Element<Eigen::Vector3d>> bearings_;
  std::vector<Element<float>> stereo_x_right_, depths_;
  std::vector<std::vector<std::vector<unsigned int>>> keypt_indices_in_cells_;
};

/// camera::perspective of stella_vslam; its camera::fisheye has k4_ in place of p1_ and p2_.
struct StellaPerspective {
  const unsigned int cols_, rows_;
  const double fx_, fy_, cx_, cy_, k1_, k2_, p1_, p2_, k3_;
};
struct StellaFisheye {
  const unsigned int cols_, rows_;
  const double fx_, fy_, cx_, cy_, k1_, k2_, k3_, k4_;
};

/// What SensorData::setFeatures of RTAB-Map takes.
template <template <class> class Element = Plain>
struct RtabmapFeatures {
  std::vector<Element<cv::KeyPoint>> keypoints;
  std::vector<Element<cv::Point3f>> keypoints3D;
  Rows<Element> descriptors;
};

/// FeatureTracker of VINS-Fusion.
template <template <class> class Element = Plain>
struct VinsTracker {
  std::vector<Element<cv::Point2f>> prev_pts, cur_pts;
  std::vector<Element<int>> ids, track_cnt;
};

/// A comparison of ids that counts.
struct CountedLess {
  bool operator()(int a, int b) const {
    ++Counter::comparisons;
    return a < b;
  }
};

/// What Estimator::inputFeature of VINS-Fusion takes: id to observations by camera.
using VinsFeatureFrame = std::map<int, std::vector<std::pair<int, Eigen::Matrix<double, 7, 1>>>, CountedLess>;

/// CameraData of OpenVINS.
struct OpenVinsMessage {
  double timestamp = 0;
  std::vector<int> sensor_ids;
  std::vector<cv::Mat> images, masks;
};

// How each host reads its mask, or what it takes for one.

inline bool stella_drops(const cv::Mat& mask, int u, int v) { return mask.at<unsigned char>(v, u) == 0; }
inline bool openvins_drops(const cv::Mat& mask, int u, int v) { return mask.at<unsigned char>(v, u) > 127; }
inline bool cuvslam_drops(const cv::Mat& mask, int u, int v) { return mask.at<unsigned char>(v, u) != 0; }
inline bool vins_drops(const cv::Mat& mask, int u, int v) { return mask.at<unsigned char>(v, u) != 255; }
inline bool opencv_drops(const cv::Mat& mask, int u, int v) { return mask.at<unsigned char>(v, u) == 0; }
inline bool rtabmap_drops(const cv::Mat& depth, int u, int v) { return depth.at<std::uint16_t>(v, u) == 0; }

}  // namespace look_alikes
