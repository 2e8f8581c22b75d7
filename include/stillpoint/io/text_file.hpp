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

namespace stillpoint {

/// Reads a file.
/// @throws Error if it is missing, a folder, a pipe or a device, larger than 1 GB, or unreadable.
inline std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargest_bytes = 1'000'000'000;  // a day of frames at 30 Hz takes a third
  const std::string name = file.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw Error(name + ": no such file");
  if (std::filesystem::is_directory(status)) throw Error(name + ": found a folder, expected a file");
  if (!std::filesystem::is_regular_file(status)) throw Error(name + ": found a pipe or a device, expected a file");
  if (std::filesystem::file_size(file, error) > kLargest_bytes || error)
    throw Error(name + ": " + (error ? "cannot be read" : "is larger than 1 GB, expected a text file"));
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw Error(name + ": cannot be read");
  return text;
}

}  // namespace stillpoint
