// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What an option's value must be: each check says what was found and what was expected.

#include <CLI/CLI.hpp>

#include <charconv>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace stillpoint_run::detail {

/// One of a few words; `list` names them.
inline CLI::Validator one_of(std::vector<std::string> words, const std::string& list) {
  return CLI::Validator(
      [words = std::move(words), list](std::string& value) {
        for (const std::string& word : words)
          if (word == value) return std::string();
        return "found '" + value + "', expected " + (words.size() > 1 ? "one of " : "") + list;
      },
      "");
}

/// An option that takes one of a few words.
inline CLI::Option* add_choice(CLI::App& app, const char* name, std::string& value, std::vector<std::string> words,
                               const char* help) {
  std::string types, list;
  for (const std::string& word : words) {
    types += (types.empty() ? "" : "|") + word;
    list += (list.empty() ? "" : ", ") + word;
  }
  return app.add_option(name, value, help)->type_name(types)->check(one_of(std::move(words), list));
}

/// A whole number in a range, with nothing behind it.
template <class Integer>
CLI::Validator whole_number(Integer least, Integer most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        Integer value{};
        const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_number = result.ec == std::errc() && result.ptr == text.data() + text.size();
        if (is_number && value >= least && value <= most) return std::string();
        return "found '" + text + "', expected a whole number from " + std::to_string(least) + " to " +
               std::to_string(most);
      },
      "");
}

/// A number in a range, with nothing behind it.
inline CLI::Validator number(double least, double most, const char* range) {
  return CLI::Validator(
      [least, most, range](std::string& text) {
        double value = 0;
        const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_number = result.ec == std::errc() && result.ptr == text.data() + text.size();
        if (is_number && value >= least && value <= most) return std::string();
        return "found '" + text + "', expected a number from " + range;
      },
      "");
}

inline CLI::Validator not_empty() {
  return CLI::Validator(
      [](std::string& text) { return text.empty() ? std::string("found nothing, expected a path") : std::string(); },
      "");
}

}  // namespace stillpoint_run::detail
