// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Numbers as text, the same bytes on every machine: the C locale of the host has no say.

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// A number with a fixed count of decimals ("-0.500000"). NaN and infinity become "nan" and "inf".
inline std::string format_fixed(double value, int decimals) {
  char buffer[512];  // 309 digits of the largest double, sign, point, decimals
  const int most = decimals < 0 ? 0 : decimals > 100 ? 100 : decimals;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, most);
  return {buffer, end.ptr};
}

/// Seconds with at least six decimals, and as many more as it takes to read the same double back: a timestamp that was
/// read from a file is written as it stood there.
inline std::string format_timestamp(double timestamp_s) {
  char buffer[512];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, timestamp_s, std::chars_format::fixed);
  std::string text(buffer, end.ptr);
  const std::size_t point = text.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : text.size() - point - 1;
  return decimals < 6 ? format_fixed(timestamp_s, 6) : text;
}

/// The number that the whole of `text` is, decimal or scientific, with an optional sign; "nan" and "inf" are numbers
/// too. Empty if it is anything else or out of range.
inline std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars takes no plus
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace stillpoint
