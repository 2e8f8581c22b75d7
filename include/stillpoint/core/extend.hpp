// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// std::vector's resize(count, value) and assign(count, value): compilers take those for insertions anywhere, a kilobyte
// of code for each type.

#include <cstddef>
#include <vector>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// Makes it `count` long; what is new has the value.
template <class T>
void extend(std::vector<T>& values, std::size_t count, const typename std::vector<T>::value_type& value) {
  const std::size_t known = values.size();
  values.resize(count);
  for (std::size_t i = known; i < count; ++i) values[i] = value;
}

/// Makes it `count` long, and all have the value.
template <class T>
void refill(std::vector<T>& values, std::size_t count, const typename std::vector<T>::value_type& value) {
  values.resize(count);
  for (auto& each : values) each = value;
}

}  // namespace stillpoint
