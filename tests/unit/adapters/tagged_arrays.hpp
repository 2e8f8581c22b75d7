// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Parallel arrays whose entries say which feature they belong to, bit for bit.

#include <cstring>
#include <opencv2/core.hpp>
#include <tuple>
#include <vector>

#include "unit/adapters/look_alikes.hpp"

namespace look_alikes {

/// Entry i, with coordinates that lose bits in any arithmetic.
inline void tag(cv::KeyPoint& k, int i) {
  const auto f = static_cast<float>(i);
  k = cv::KeyPoint(cv::Point2f(f / 3.0f, f / 7.0f), 31.0f + f, f / 11.0f, 0.1f * f, i % 8, i);
}
inline void tag(cv::Point2f& p, int i) { p = cv::Point2f(static_cast<float>(i) / 3.0f, static_cast<float>(i) / 7.0f); }
inline void tag(cv::Point3f& p, int i) { p = cv::Point3f(static_cast<float>(i) / 3.0f, 0.1f, static_cast<float>(i)); }
inline void tag(Eigen::Vector3d& v, int i) { v = Eigen::Vector3d(i / 3.0, i / 7.0, 1.0); }
inline void tag(float& f, int i) { f = static_cast<float>(i) / 3.0f; }
inline void tag(int& n, int i) { n = i; }
template <class T>
void tag(Counted<T>& counted, int i) {
  tag(counted.value, i);
}

/// `count` tagged entries.
template <class T>
void fill(std::vector<T>& array, int count) {
  array.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) tag(array[static_cast<std::size_t>(i)], i);
}
inline void fill(cv::Mat& rows, int count) {
  rows.create(count, 32, CV_8UC1);
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < rows.cols; ++c) rows.at<unsigned char>(i, c) = static_cast<unsigned char>(i * 3 + c + i / 256);
}
inline void fill(CountedRows& rows, int count) {
  rows.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) tag(rows.entries[static_cast<std::size_t>(i)], i);
}

inline int size(const cv::Mat& rows) { return rows.rows; }
template <class T>
int size(const std::vector<T>& array) {
  return static_cast<int>(array.size());
}

/// Are the entries those of a full array at the given indices, bit for bit?
template <class T>
bool holds(const std::vector<T>& array, const std::vector<int>& indices) {
  if (array.size() != indices.size()) return false;
  for (std::size_t i = 0; i < array.size(); ++i) {
    T expected;
    tag(expected, indices[i]);
    if (std::memcmp(&array[i], &expected, sizeof(T)) != 0) return false;
  }
  return true;
}
inline bool holds(const cv::Mat& rows, const std::vector<int>& indices) {
  if (rows.rows != static_cast<int>(indices.size()) || rows.cols != 32 || rows.type() != CV_8UC1) return false;
  cv::Mat full;
  fill(full, indices.empty() ? 1 : indices.back() + 1);
  for (int i = 0; i < rows.rows; ++i)
    if (cv::norm(rows.row(i), full.row(indices[static_cast<std::size_t>(i)]), cv::NORM_INF) != 0) return false;
  return true;
}

template <class Arrays>
void fill_all(const Arrays& arrays, int count) {
  std::apply([&](auto&... array) { (fill(array, count), ...); }, arrays);
}
template <class Arrays>
bool all_hold(const Arrays& arrays, const std::vector<int>& indices) {
  return std::apply([&](auto&... array) { return (holds(array, indices) && ...); }, arrays);
}

}  // namespace look_alikes
