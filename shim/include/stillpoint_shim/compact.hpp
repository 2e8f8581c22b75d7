// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Drops entries from parallel arrays together: stable, in place, one pass. stillpoint::compact for C++11; nothing of it
// is compiled into the library.

#include <opencv2/core/core.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint_shim {

namespace detail {

template <class T, class Allocator>
std::size_t size_of(const std::vector<T, Allocator>& array) {
  return array.size();
}
inline std::size_t size_of(const cv::Mat& rows) { return static_cast<std::size_t>(rows.rows); }

template <class T, class Allocator>
void move_entry(std::vector<T, Allocator>& array, std::size_t from, std::size_t to) {
  array[to] = std::move(array[from]);
}
inline void move_entry(cv::Mat& rows, std::size_t from, std::size_t to) {
  cv::Mat target = rows.row(static_cast<int>(to));
  rows.row(static_cast<int>(from)).copyTo(target);
}

template <class T, class Allocator>
void shrink(std::vector<T, Allocator>& array, std::size_t size) {
  array.erase(array.begin() + static_cast<std::ptrdiff_t>(size), array.end());
}
inline void shrink(cv::Mat& rows, std::size_t size) { rows.resize(size); }

template <class Array>
int require_aligned(std::size_t keep_size, std::size_t position, const Array& array) {
  if (size_of(array) != keep_size)
    throw std::invalid_argument("compact: array " + std::to_string(position) + " has " +
                                std::to_string(size_of(array)) + " entries, expected one for each of the " +
                                std::to_string(keep_size) + " keep flags");
  return 0;
}

template <class Array>
int compact_one(const std::vector<unsigned char>& keep, Array& array) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    if (kept != i) move_entry(array, i, kept);
    ++kept;
  }
  if (kept != keep.size()) shrink(array, kept);
  return 0;
}

}  // namespace detail

/// Removes every entry whose flag is 0 from all arrays; the others keep their order.
/// @param keep    one byte an entry, 0 drops
/// @param arrays  std::vector, or cv::Mat with one row an entry, each with keep.size() entries. A matrix keeps its
///                memory, and other headers that share it see its rows moved.
/// @return how many are left: what a host stores as its number of features
/// @throws std::invalid_argument if an array has another size; then none was changed. O(n) for each array.
template <class... Arrays>
std::size_t compact(const std::vector<unsigned char>& keep, Arrays&... arrays) {
  std::size_t position = 0;
  const int aligned[] = {0, detail::require_aligned(keep.size(), ++position, arrays)...};  // C++11 has no folds
  const int compacted[] = {0, detail::compact_one(keep, arrays)...};
  static_cast<void>(position), static_cast<void>(aligned), static_cast<void>(compacted);
  std::size_t kept = 0;
  for (const unsigned char flag : keep) kept += flag != 0;
  return kept;
}

/// Where each entry is after `compact`, for a host that keeps indices; -1 where it was dropped.
inline std::vector<int> new_indices(const std::vector<unsigned char>& keep) {
  std::vector<int> indices(keep.size(), -1);
  int kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i] != 0) indices[i] = kept++;
  return indices;
}

}  // namespace stillpoint_shim
