// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A folder for the files that a reader is to read, removed when the fuzzer ends.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "bytes.hpp"
#include "stillpoint/core/error.hpp"

namespace fuzz {

class InputFolder {
 public:
  InputFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "stillpoint_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Lets the reader that the first byte chooses read the others as text. A file that it refuses is no finding.
template <class Read>
void read_chosen(const std::uint8_t* data, std::size_t size, const Read& read) {
  Bytes bytes(data, size);
  const int reader = bytes.byte();
  try {
    read(reader, bytes.rest());
  } catch (const stillpoint::Error&) {
  }
}

}  // namespace fuzz
