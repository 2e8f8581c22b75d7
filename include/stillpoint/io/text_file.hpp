// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Text from files, whole; never from a pipe or a device, which may have no end.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/regular_file.hpp"

namespace stillpoint {

/// Reads a file.
/// @throws Error if it is missing, a folder, a pipe or a device, larger than 1 GB, or unreadable.
inline std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargest_bytes = 1'000'000'000;  // a day of frames at 30 Hz takes a third
  const std::string name = file.string();
  detail::require_regular_file(file, "a file");
  std::error_code error;
  if (std::filesystem::file_size(file, error) > kLargest_bytes || error)
    throw Error(name + ": " + (error ? "cannot be read" : "is larger than 1 GB, expected a text file"));
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw Error(name + ": cannot be read");
  return text;
}

}  // namespace stillpoint
