// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of every stage, by name and with their ranges: one table for code, files and the shim.
//
// Beside each stage stands its `each_option(stage, visit)`, which calls, in the order of the stage's options,
//
//   visit(name, value, OptionRange{least, most})   a number; both ends are allowed
//   visit(name, value)                             a bool, or a group with an `each_option` of its own
//   visit.seed(name, value)                        any whole number
//   visit.choice(name, value, words...)            an enumerator or index; words name its values from 0 on
//
// What is set in code alone, and stands in no file, is visited where `sees_code_only<Visit>::value`.
//
// A stage of your own takes part when its namespace has an `each_option` for it, in the header of the stage.

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// What a number may be, both ends included: a stage neither fails nor takes minutes within.
struct OptionRange {
  double least, most;

  /// Not for NaN.
  constexpr bool contains(double value) const noexcept { return value >= least && value <= most; }
};

/// True for a visitor that also sees members which are set in code alone, and so have a range but stand in no file: it
/// has a member type `SeesCodeOnly`.
template <class Visit, class = void>
struct sees_code_only : std::false_type {};
template <class Visit>
struct sees_code_only<Visit, std::void_t<typename Visit::SeesCodeOnly>> : std::true_type {};

/// True for a stage or group whose options have names.
template <class Group, class Visit, class = void>
struct has_options : std::false_type {};
template <class Group, class Visit>
struct has_options<Group, Visit, std::void_t<decltype(each_option(std::declval<Group&>(), std::declval<Visit&>()))>>
    : std::true_type {};

/// The shortest decimal that reads back as the same number; with an exponent where it is long without.
template <class Number>
std::string option_text(Number value) {
  char text[64];
  if constexpr (std::is_floating_point_v<Number>) {
    const auto fixed = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
    if (fixed.ec == std::errc() && fixed.ptr <= text + 9) return {text, fixed.ptr};
  }
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// As in "0.01 to 100".
inline std::string option_text(const OptionRange& range) {
  std::string text = option_text(range.least);
  text += " to ";
  text += option_text(range.most);
  return text;
}

/// What an option of this type may be, in words.
template <class Number>
std::string expected_of(const OptionRange& range) {
  std::string text = std::is_integral_v<Number> ? "a whole number from " : "a number from ";
  text += option_text(range);
  return text;
}
template <class... Words>
std::string expected_of_choice(Words... words) {
  std::string list;
  for (const char* word : {words...}) {
    if (!list.empty()) list += " or ";
    list += word;
  }
  return list;
}

/// What a visitor that only looks at options needs besides `(name, value)`: the range is nothing to it, and a choice is
/// the word for its value, by `word(name, text)`.
/// @tparam Visitor  the class that derives from this one
template <class Visitor>
class LooksAtOptions {
 public:
  template <class T>
  void operator()(const char* name, T& value, const OptionRange&) {
    static_cast<Visitor&>(*this).number(name, value);
  }
  template <class T>
  void seed(const char* name, T& value) {
    static_cast<Visitor&>(*this).number(name, value);
  }
  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>)
      static_cast<Visitor&>(*this).number(name, value);
    else if constexpr (has_options<T, Visitor>::value)
      static_cast<Visitor&>(*this).group(name, value);
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const std::array<const char*, sizeof...(Words)> all{words...};
    const auto index = static_cast<std::size_t>(value);
    static_cast<Visitor&>(*this).word(name, index < all.size() ? all[index] : "?");
  }
};

/// Finds the first option that is out of its range.
class OptionCheck {
 public:
  using SeesCodeOnly = void;

  OptionCheck() = default;

  /// As in "gate.false_positive_rate is 5, expected a number from 0.000001 to 0.5"; empty where all are in range.
  const std::string& error() const noexcept { return error_; }

  /// Apart from the callers, and small: inlined for each of the options it would be a twentieth of the whole filter's
  /// code.
  template <class T>
  [[gnu::noinline, gnu::cold]] void operator()(const char* name, T value, const OptionRange& range) {
    if (error_.empty() && !range.contains(static_cast<double>(value)))
      report(name, option_text(value), expected_of<T>(range));
  }
  template <class T>
  void operator()(const char* name, T& value) {
    static_assert(
        std::is_same_v<T, bool> || !std::is_arithmetic_v<T>,
        "stillpoint: each_option must say the range of a number: visit(name, value, OptionRange{least, most})");
    if constexpr (has_options<T, OptionCheck>::value) {
      const Group group{name, innermost_};
      innermost_ = &group;
      each_option(value, *this);
      innermost_ = group.outer;
    }
  }
  template <class T>
  void seed(const char*, const T&) noexcept {}
  template <class T, class... Words>
  void choice(const char* name, const T& value, Words... words) {
    const auto index = static_cast<std::size_t>(value);
    if (error_.empty() && index >= sizeof...(Words)) report(name, option_text(index), expected_of_choice(words...));
  }

 private:
  struct Group {
    const char* name;
    const Group* outer;
  };

  /// With the names of the groups that it is in, as in `matcher.corners.`.
  [[gnu::cold]] void report(const char* name, const std::string& found, const std::string& expected) {
    append_path(innermost_);
    for (const char* text : {name, " is ", found.c_str(), ", expected ", expected.c_str()}) error_ += text;
  }

  [[gnu::cold]] void append_path(const Group* group) {
    if (group == nullptr) return;
    append_path(group->outer);
    error_ += group->name;
    error_ += '.';
  }

  const Group* innermost_ = nullptr;
  std::string error_;
};

}  // namespace stillpoint
