// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the adapters share: a host's parallel arrays under the names that the host gives them.

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Does a host's type have a member? Asked as `offers<Frame>([](auto& frame) -> decltype(void(frame.mvDepth)) {})`.
template <class Host, class Access>
constexpr bool offers(Access) {
  return std::is_invocable_v<Access, Host&>;
}

/// One of a host's parallel arrays and its name, for errors.
template <class Array>
struct HostArray {
  const char* name;
  Array& array;
  bool is_optional = false;  ///< a host leaves it empty where it does not use it

  std::size_t size() const { return compaction_traits<Array>::size(array); }
  bool is_unused() const { return is_optional && size() == 0; }
};

/// An array that has one entry per feature.
template <class Array>
HostArray<Array> host_array(const char* name, Array& array) {
  return {name, array};
}

/// An array that has one entry per feature, or none at all.
template <class Array>
HostArray<Array> optional_host_array(const char* name, Array& array) {
  return {name, array, true};
}

/// @param host    begins the message
/// @param keep    one byte per feature
/// @param arrays  an optional one may be empty
/// @throws Error that names the first array with another size than `keep`
template <class... Arrays>
void require_aligned_host_arrays(const char* host, span<const std::uint8_t> keep, const HostArray<Arrays>&... arrays) {
  const auto require_aligned = [&](const auto& named) {
    if (named.is_unused() || named.size() == keep.size()) return;
    throw Error(std::string(host) + ": " + named.name + " has " + std::to_string(named.size()) +
                " entries, expected one for each of the " + std::to_string(keep.size()) + " keep flags");
  };
  (require_aligned(arrays), ...);
}

/// As `compact`, with an error that names the array.
/// @param host    begins the message
/// @param keep    one byte per feature, 0 drops
/// @param arrays  an optional one may be empty
/// @return how many are left
/// @throws Error as `require_aligned_host_arrays`; then none was changed. O(n) for each array.
template <class... Arrays>
std::size_t compact_host_arrays(const char* host, span<const std::uint8_t> keep, const HostArray<Arrays>&... arrays) {
  require_aligned_host_arrays(host, keep, arrays...);
  const auto compact_used = [&](const auto& named) {
    if (!named.is_unused()) compact(keep, named.array);
  };
  (compact_used(arrays), ...);
  return kept_count(keep);
}

/// Gives the indices of features in a host's grid (columns of cells) their new values; those of dropped ones go.
/// @param old_to_new  of `compaction_map`
template <class Grid>
void reindex_grid(Grid& columns, span<const int> old_to_new) {
  for (auto& column : columns) {
    for (auto& cell : column) {
      std::size_t left = 0;
      for (const auto index : cell)
        if (old_to_new[index] >= 0) cell[left++] = static_cast<std::decay_t<decltype(index)>>(old_to_new[index]);
      cell.resize(left);
    }
  }
}

}  // namespace stillpoint
