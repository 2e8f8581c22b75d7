// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where an output file is written: at the end of its links, and first to a temporary file beside it.

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "stillpoint/core/error.hpp"

namespace stillpoint::detail {

/// Link by link: std::filesystem's functions do not resolve one whose file is not there yet.
/// @return  `target`, or what its symbolic links lead to, which may be missing
/// @throws Error where they lead in a circle
inline std::filesystem::path follow_links(const std::filesystem::path& target) {
  constexpr int kMostLinks = 40;  // as Linux has it
  std::filesystem::path file = target;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(file, error)); ++links) {
    const std::filesystem::path named = std::filesystem::read_symlink(file, error);
    if (error || links == kMostLinks)
      throw Error(target.string() + ": found a symbolic link that leads to no file, expected a file to write");
    file = file.parent_path() / named;
  }
  return file;
}

/// A file that was not there before, open for writing.
struct NewFile {
  std::filesystem::path path;
  std::FILE* file = nullptr;  ///< null: it can't be made
  int error = 0;              ///< why, as errno says it
};

/// Numbers from 0 on are tried: a file that exists may belong to another process, so it is never opened.
/// @param name  `std::filesystem::path name(std::size_t number)`
template <class Name>
NewFile make_new_file(const Name& name) {
  for (std::size_t number = 0;; ++number) {
    std::filesystem::path path = name(number);
    errno = 0;
    std::FILE* const file = std::fopen(path.string().c_str(), "wbx");
    if (file != nullptr || errno != EEXIST) return {std::move(path), file, errno};
  }
}

}  // namespace stillpoint::detail
