// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a test reads of an error.

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

}  // namespace stillpoint
