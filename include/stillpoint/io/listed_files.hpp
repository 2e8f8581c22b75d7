// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Images that a list names and that are not there: a few are left out, as all public recordings miss some.

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/table_reader.hpp"

namespace stillpoint::detail {

/// Counts what one list names and what of it is missing.
class ListedFiles {
 public:
  /// Whether the file that a column of the current row names is there.
  /// @param file  the column below the list's folder
  bool is_there(const TableReader& rows, std::size_t column, const std::filesystem::path& file) {
    ++named_;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return true;
    if (missing_++ == 0)
      first_missing_ =
          rows.found_at(column, "file name") + ", expected an image that is there; " + file.string() + " is not";
    return false;
  }

  /// @return        how many are missing.
  /// @throws Error naming the first one, if more than a tenth of all are missing: then it is the wrong folder, or the
  ///         copy broke off.
  std::size_t missing() const {
    if (10 * missing_ <= named_) return missing_;
    throw Error(first_missing_ + (missing_ > 1 ? ", and " + std::to_string(missing_ - 1) + " more of the " +
                                                     std::to_string(named_) + " that the list names are not"
                                               : ""));
  }

 private:
  std::size_t named_ = 0, missing_ = 0;
  std::string first_missing_;
};

}  // namespace stillpoint::detail
