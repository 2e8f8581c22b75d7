// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a test reads of an error.

#include <cstddef>
#include <string>

#include "stillpoint/core/error.hpp"

namespace stillpoint {

/// The message of the `Error` that `action` throws.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A message without the number of its line: "file:12: what" becomes "file: what".
inline std::string without_line(std::string message) {
  const std::size_t end = message.find(": ");
  if (end == std::string::npos) return message;
  std::size_t begin = end;
  while (begin > 0 && message[begin - 1] >= '0' && message[begin - 1] <= '9') --begin;
  return begin < end && begin > 0 && message[begin - 1] == ':' ? message.erase(begin - 1, end - begin + 1) : message;
}

}  // namespace stillpoint
