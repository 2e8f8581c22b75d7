// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What readers ask of a file first: a pipe or a device may have no end, and reading may wait for ever.

#include <filesystem>
#include <string>
#include <system_error>

#include "stillpoint/core/error.hpp"

namespace stillpoint::detail {

/// @param expected  as in "a model", for the message
/// @throws Error if there is no such file, or it is a folder, a pipe or a device.
inline void require_regular_file(const std::filesystem::path& file, const char* expected) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) throw Error(file.string() + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw Error(file.string() + ": found a " + (std::filesystem::is_directory(status) ? "folder" : "pipe or a device") +
                ", expected " + expected);
}

}  // namespace stillpoint::detail
