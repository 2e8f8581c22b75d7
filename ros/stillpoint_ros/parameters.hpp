// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Options from parameters: the names of the one table (stillpoint/core/options.hpp), with dots between the groups.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"

namespace stillpoint_ros {

/// Visits a table of options and sets each to what `source` says, as in `gate.false_positive_rate`.
/// @tparam Source  `get(name, value)` for a bool, std::int64_t, double or std::string: the parameter of that name, or
///                 `value` where nobody set it
/// Throws stillpoint::Error naming the parameter, its value and what was expected.
template <class Source>
class ParameterReader {
 public:
  /// @param names  each option that there is is appended
  ParameterReader(Source& source, std::vector<std::string>& names, std::string path = "")
      : source_(source), names_(names), path_(std::move(path)) {}

  template <class T>
  void operator()(const char* name, T& value, const stillpoint::OptionRange& range) {
    using Number = std::conditional_t<std::is_integral_v<T>, std::int64_t, double>;
    const Number found = get(name, static_cast<Number>(value));
    if (!range.contains(static_cast<double>(found)))
      fail(name, stillpoint::option_text(found), stillpoint::expected_of<T>(range));
    // What nobody set stays as it is, to the last bit.
    if (found != static_cast<Number>(value)) value = static_cast<T>(found);
  }
  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = get(name, value);
    } else if constexpr (stillpoint::has_options<T, ParameterReader>::value) {
      ParameterReader nested(source_, names_, path_ + name + '.');
      each_option(value, nested);
    }
  }
  template <class T>
  void seed(const char* name, T& value) {
    constexpr std::uint64_t kMost = std::min<std::uint64_t>(std::numeric_limits<T>::max(), INT64_MAX);
    const std::int64_t found = get(name, static_cast<std::int64_t>(value));
    // What nobody set stays: a seed above 2^63 - 1 comes back negative.
    if (found == static_cast<std::int64_t>(value)) return;
    if (found < 0 || static_cast<std::uint64_t>(found) > kMost)
      fail(name, stillpoint::option_text(found), "a whole number from 0 to " + std::to_string(kMost));
    value = static_cast<T>(found);
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const char* const all[] = {words...};
    const std::string found = get(name, std::string(all[static_cast<std::size_t>(value)]));
    for (std::size_t i = 0; i < sizeof...(words); ++i)
      if (found == all[i]) return static_cast<void>(value = static_cast<T>(i));
    fail(name, '\'' + found + '\'', stillpoint::expected_of_choice(words...));
  }

 private:
  template <class Value>
  Value get(const char* name, const Value& value) {
    names_.push_back(path_ + name);
    return source_.get(names_.back(), value);
  }
  [[noreturn]] void fail(const char* name, const std::string& found, const std::string& expected) const {
    throw stillpoint::Error("parameter " + path_ + name + " is " + found + ", expected " + expected);
  }

  Source& source_;
  std::vector<std::string>& names_;
  std::string path_;
};

/// The first parameter that is no option: a misspelled one would change nothing, without a word. Empty where all are.
inline std::string unknown_parameter(const std::vector<std::string>& given, const std::vector<std::string>& known) {
  for (const std::string& name : given) {
    bool is_known = false;
    for (const std::string& option : known) is_known = is_known || option == name;
    if (!is_known) return name;
  }
  return "";
}

}  // namespace stillpoint_ros
