// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Files of rows and columns: columns between blanks, as the TUM benchmark writes them, or between commas, as EuRoC
// does; comments after '#'.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/text_file.hpp"

namespace stillpoint {

/// Reads such a file row by row. What is wrong with a row becomes an `Error` "FILE:LINE: found X, expected Y".
class TableReader {
 public:
  enum class Columns {
    between_blanks,
    between_commas,  ///< blanks around them do not count; a column may be empty
  };

  /// @throws Error as `read_text`.
  explicit TableReader(const std::filesystem::path& file, Columns columns = Columns::between_blanks)
      : file_(file.string()), separates_by_commas_(columns == Columns::between_commas) {
    text_ = read_text(file);
    if (text_.compare(0, 3, "\xef\xbb\xbf") == 0) next_ = 3;  // the byte order mark that some editors write
  }
  TableReader(const TableReader&) = delete;  // the columns point into the text
  TableReader& operator=(const TableReader&) = delete;

  /// Goes to the next row that is neither empty nor a comment. False at the end.
  bool next_row() {
    while (next_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', next_), text_.size());
      split(std::string_view(text_).substr(next_, end - next_));
      next_ = end + 1;
      ++line_;
      if (!columns_.empty() && columns_[0].substr(0, 1) != "#") return true;
    }
    return false;
  }

  /// Columns of the current row; valid while the reader lives.
  std::string_view operator[](std::size_t column) const { return columns_[column]; }

  std::size_t column_count() const { return columns_.size(); }

  /// @param names  what the columns are, separated by blanks, as a header names them.
  /// @throws Error unless the row has one column for each name.
  void require_columns(std::size_t count, const char* names) const {
    if (columns_.size() != count)
      fail(std::to_string(columns_.size()) + " columns", std::to_string(count) + ": " + names);
  }

  /// @throws Error unless the column is a finite number.
  double number(std::size_t column, const char* name) const {
    const auto value = parse_number(columns_[column]);
    if (!value || !std::isfinite(*value)) fail_at(column, name, "a finite number");
    return *value;
  }

  /// The time in a column that must not descend from row to row (or must rise, if `strictly`).
  /// @param previous_s  the time in the row before; takes the new one. Start with `kBeforeAllTime`.
  /// @throws Error unless it is a finite number not before `previous_s`.
  double time(std::size_t column, double& previous_s, bool strictly = false) const {
    const double time_s = number(column, "timestamp");
    if (strictly ? !(time_s > previous_s) : !(time_s >= previous_s))
      fail_at(column, "timestamp",
              std::string(strictly ? "later than " : "not before ") + format_timestamp(previous_s) +
                  ", the time of the row before");
    return previous_s = time_s;
  }
  static constexpr double kBeforeAllTime = -std::numeric_limits<double>::infinity();

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw Error(position() + ": found " + found + ", expected " + expected);
  }
  [[noreturn]] void fail_at(std::size_t column, const char* name, const std::string& expected) const {
    throw Error(found_at(column, name) + ", expected " + expected);
  }
  /// "FILE:LINE: found NAME 'COLUMN'".
  std::string found_at(std::size_t column, const char* name) const {
    return position() + ": found " + name + " " + printable(columns_[column]);
  }

  /// "FILE:LINE" of the current row.
  std::string position() const { return file_ + ":" + std::to_string(line_); }

 private:
  static constexpr std::string_view kBlanks = " \t\r";

  static std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin == text.npos ? std::string_view() : text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
  }

  void split(std::string_view line) {
    columns_.clear();
    if (separates_by_commas_) {
      if (trimmed(line).empty()) return;
      for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        columns_.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
      }
      return;
    }
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
      columns_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kBlanks, end);
    }
  }

  /// Quoted, cut short, and without bytes that would upset a terminal: the file may be anything.
  static std::string printable(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string quoted = "'";
    for (const char c : text.substr(0, kLongest)) quoted += c >= ' ' && c <= '~' ? c : '?';
    return quoted + (text.size() > kLongest ? "...'" : "'");
  }

  std::string file_;
  bool separates_by_commas_;
  std::string text_;
  std::size_t next_ = 0;
  int line_ = 0;
  std::vector<std::string_view> columns_;
};

}  // namespace stillpoint
