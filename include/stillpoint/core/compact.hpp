// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Drops entries from parallel arrays together: stable, in place, one pass.

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

namespace detail {

/// `std::void_t` as a class: clang takes two specialisations over the alias for one and the same (CWG 1980).
template <class...>
struct void_if_valid {
  using type = void;
};

}  // namespace detail

/// How an array is compacted. Anything with `size()`, `operator[]` and `resize()` is; row matrices (one row a feature:
/// `cv::Mat`, Eigen) are recognised by their members.
template <class Array, class = void>
struct compaction_traits {
  static std::size_t size(const Array& array) { return array.size(); }
  static void move(Array& array, std::size_t from, std::size_t to) { array[to] = std::move(array[from]); }
  static void shrink(Array& array, std::size_t size) { array.resize(size); }
};

/// An Eigen matrix, one row a feature.
template <class Matrix>
struct compaction_traits<
    Matrix, typename detail::void_if_valid<decltype(std::declval<Matrix&>().conservativeResize(1, 1))>::type> {
  using Index = decltype(std::declval<const Matrix&>().rows());
  static std::size_t size(const Matrix& m) { return static_cast<std::size_t>(m.rows()); }
  static void move(Matrix& m, std::size_t from, std::size_t to) {
    m.row(static_cast<Index>(to)) = m.row(static_cast<Index>(from)).eval();
  }
  static void shrink(Matrix& m, std::size_t size) { m.conservativeResize(static_cast<Index>(size), m.cols()); }
};

/// A row matrix in the manner of `cv::Mat`: `rows`, `rowRange`, `row(i).copyTo`, `resize`. `resize` makes the header
/// shorter and leaves columns and type as they are. The memory is not freed, and other headers that share it see the
/// moved rows.
template <class Matrix>
struct compaction_traits<Matrix, typename detail::void_if_valid<decltype(std::declval<Matrix&>().rowRange(0, 0)),
                                                                decltype(std::declval<Matrix&>().row(0).copyTo(
                                                                    std::declval<Matrix&>()))>::type> {
  static std::size_t size(const Matrix& m) { return static_cast<std::size_t>(m.rows); }
  static void move(Matrix& m, std::size_t from, std::size_t to) {
    auto target = m.row(static_cast<int>(to));
    m.row(static_cast<int>(from)).copyTo(target);
  }
  static void shrink(Matrix& m, std::size_t size) { m.resize(size); }
};

namespace detail {

template <class Array>
void compact_one(span<const std::uint8_t> keep, Array& array) {
  using Traits = compaction_traits<Array>;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    if (kept != i) Traits::move(array, i, kept);
    ++kept;
  }
  if (kept != keep.size()) Traits::shrink(array, kept);
}

template <class Array>
void require_aligned(std::size_t keep_size, std::size_t position, const Array& array) {
  const std::size_t size = compaction_traits<Array>::size(array);
  if (size != keep_size)
    throw Error("compact: array " + std::to_string(position) + " has " + std::to_string(size) +
                " entries, expected one for each of the " + std::to_string(keep_size) + " keep flags");
}

}  // namespace detail

/// How many flags are not 0.
inline std::size_t kept_count(span<const std::uint8_t> keep) noexcept {
  std::size_t kept = 0;
  for (const std::uint8_t flag : keep) kept += flag != 0;
  return kept;
}

/// Removes every entry whose flag is 0 from all arrays; the others keep their order.
/// @param keep    one byte an entry, 0 drops
/// @param arrays  vectors or row matrices, each with keep.size() entries
/// @return how many are left
/// @throws Error if an array has another size; then none was changed. O(n) for each array.
template <class... Arrays>
std::size_t compact(span<const std::uint8_t> keep, Arrays&... arrays) {
  std::size_t position = 0;
  (detail::require_aligned(keep.size(), ++position, arrays), ...);
  (detail::compact_one(keep, arrays), ...);
  return kept_count(keep);
}

/// Where each entry goes in a compaction: for arrays that hold indices into the compacted ones, and hosts that keep
/// more arrays than `compact` was given.
/// @param keep        one byte an entry, 0 drops
/// @param old_to_new  becomes one index an entry, -1 for a dropped one; its memory is reused
/// @return how many are left. O(n).
inline std::size_t compaction_map(span<const std::uint8_t> keep, std::vector<int>& old_to_new) {
  old_to_new.resize(keep.size());
  int kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) old_to_new[i] = keep[i] != 0 ? kept++ : -1;
  return static_cast<std::size_t>(kept);
}

}  // namespace stillpoint
