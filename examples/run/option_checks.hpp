// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What an option's value must be: each check says what was found and what was expected.

#include <CLI/CLI.hpp>

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/detectors/layout.hpp"

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

/// A word that names a prior, or a file that is there; what is in it shows when it is read.
inline CLI::Validator prior() {
  return CLI::Validator(
      [](std::string& text) {
        std::error_code ignored;
        for (const char* word : {"none", "boxes", "labels"})
          if (text == word) return std::string();
        if (std::filesystem::exists(text, ignored)) return std::string();
        return "found '" + text + "', and no such file; expected one of none, boxes, labels, or the file of a network";
      },
      "");
}

inline CLI::Validator layout() {
  return CLI::Validator(
      [](std::string& text) {
        try {
          stillpoint::layout_from_name(text);
          return std::string();
        } catch (const stillpoint::Error&) {
          return "found '" + text + "', expected automatic or one of " + stillpoint::layout_names();
        }
      },
      "");
}

/// The ending says which codec.
inline CLI::Validator video_name() {
  return CLI::Validator(
      [](std::string& text) {
        const std::string ending = std::filesystem::path(text).extension().string();
        if (ending == ".mp4" || ending == ".avi") return std::string();
        return "found '" + text + "', expected a name that ends in .mp4 or .avi";
      },
      "");
}

}  // namespace stillpoint_run::detail
