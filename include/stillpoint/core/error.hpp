// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The library's one exception: thrown by constructors and readers, never by `filter_frame`.

#include <stdexcept>
#include <string>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// What a constructor or reader throws. The message names the file or field, the value found and what was expected.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace stillpoint
