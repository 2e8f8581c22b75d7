// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of a filter's stages from and to YAML, so that a run can be repeated and a camera's own noise be kept.

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/yaml_file.hpp"
#include "stillpoint/options/replaced_options.hpp"
#include "stillpoint/policies/default_policies.hpp"

namespace stillpoint {

namespace detail {

/// Writes every option, one a line, those of a group indented.
class OptionWriter : public LooksAtOptions<OptionWriter> {
 public:
  explicit OptionWriter(std::string& yaml, std::string indent = "") : yaml_(yaml), indent_(std::move(indent)) {}

  template <class T>
  void number(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>)
      word(name, value ? "true" : "false");
    else
      word(name, option_text(value).c_str());
  }
  void word(const char* name, const char* text) { yaml_ += indent_ + name + ": " + text + '\n'; }
  template <class T>
  void group(const char* name, T& value) {
    yaml_ += indent_ + name + ":\n";
    OptionWriter nested(yaml_, indent_ + "  ");
    each_option(value, nested);
  }

 private:
  std::string& yaml_;
  std::string indent_;
};

/// Reads the options of a map. Options that are not there keep their values; one that no stage has is an error.
class OptionReader {
 public:
  /// @param assigns   false: the map is checked and nothing is changed
  /// @param replaced  options of the map that earlier versions had are appended, a line each
  OptionReader(const YamlFile& file, const YamlNode& node, std::string path, bool assigns,
               std::vector<std::string>& replaced)
      : file_(file), node_(node), path_(std::move(path)), assigns_(assigns), replaced_(replaced) {}

  template <class T>
  void operator()(const char* name, T& value, const OptionRange& range) {
    const YamlNode* const entry = find(name);
    if (entry == nullptr) return;
    const std::string expected = expected_of<T>(range);
    if constexpr (std::is_integral_v<T>) {
      set(value, whole_number<T>(*entry, name, range, expected));
    } else {
      const double found = file_.finite(*entry, path_ + name, expected);
      if (!range.contains(found)) file_.fail(*entry, path_ + name, "is " + option_text(found), expected);
      set(value, static_cast<T>(found));
    }
  }
  template <class T>
  void seed(const char* name, T& value) {
    constexpr OptionRange kAny{0, static_cast<double>(std::numeric_limits<T>::max())};
    const YamlNode* const entry = find(name);
    if (entry == nullptr) return;
    set(value, whole_number<T>(*entry, name, kAny,
                               "a whole number from 0 to " + std::to_string(std::numeric_limits<T>::max())));
  }
  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      const YamlNode* const entry = find(name);
      if (entry == nullptr) return;
      const bool is_true = entry->text == "true" || entry->text == "1";
      if (!is_true && entry->text != "false" && entry->text != "0")
        file_.fail(*entry, path_ + name, "is no flag", "true or false");
      set(value, is_true);
    } else if constexpr (has_options<T, OptionReader>::value) {
      read_group(name, value);
    }
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const YamlNode* const entry = find(name);
    if (entry == nullptr) return;
    std::size_t index = 0;
    for (const std::string_view word : {words...}) {
      if (entry->text == word) return set(value, static_cast<T>(index));
      ++index;
    }
    const bool is_word = entry->kind == YamlNode::Kind::scalar;
    file_.fail(*entry, path_ + name, is_word ? "is '" + entry->text + "'" : "is not a word",
               expected_of_choice(words...));
  }

  /// @param skipped  may be there, too, though nobody asked for it
  /// @throws Error if the map holds what was not asked for and no earlier version had.
  void require_all_known(std::string_view skipped = "") {
    for (const YamlNode& entry : node_.entries) {
      bool is_known = !skipped.empty() && entry.name == skipped;
      for (const std::string_view name : known_) is_known = is_known || name == entry.name;
      if (is_known || collect_replaced(path_ + entry.name, entry)) continue;
      std::string list;
      for (const char* const name : known_) list += (list.empty() ? "one of " : ", ") + std::string(name);
      file_.fail(entry, path_ + entry.name, "is unknown", list.empty() ? "nothing there" : list);
    }
  }

 private:
  /// @return false if an option in there was never one
  bool collect_replaced(const std::string& name, const YamlNode& entry) {
    if (entry.kind == YamlNode::Kind::map) {
      bool all = !entry.entries.empty();
      for (const YamlNode& nested : entry.entries) all = collect_replaced(name + '.' + nested.name, nested) && all;
      return all;
    }
    const std::optional<std::string_view> replacement = replacement_of(name);
    if (replacement) replaced_.push_back(name + ": " + std::string(*replacement));
    return replacement.has_value();
  }

  const YamlNode* find(const char* name) {
    known_.push_back(name);
    return node_.find(name);
  }

  template <class T>
  void set(T& value, T found) const {
    if (assigns_) value = found;
  }

  template <class T>
  T whole_number(const YamlNode& entry, const char* name, const OptionRange& range, const std::string& expected) const {
    const std::string& text = entry.text;
    T value{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
    if (!is_whole || !range.contains(static_cast<double>(value)))
      file_.fail(entry, path_ + name, text.empty() ? "is no whole number" : "is " + text, expected);
    return value;
  }

  template <class T>
  void read_group(const char* name, T& group) {
    const YamlNode* const entry = find(name);
    if (entry == nullptr || entry->kind == YamlNode::Kind::nothing) return;
    if (entry->kind != YamlNode::Kind::map)
      file_.fail(*entry, path_ + name, "is no map", "options as name: value, one a line and indented");
    if constexpr (std::is_same_v<T, AnyDepthNoise>) {  // its options depend on its model: a copy is always assigned
      AnyDepthNoise copy = group;
      read_into(name, *entry, copy, true);
      set(group, copy);
    } else {
      read_into(name, *entry, group, assigns_);
    }
  }

  template <class T>
  void read_into(const char* name, const YamlNode& entry, T& group, bool assigns) {
    OptionReader nested(file_, entry, path_ + name + ".", assigns, replaced_);
    each_option(group, nested);
    nested.require_all_known();
  }

  const YamlFile& file_;
  const YamlNode& node_;
  std::string path_;
  bool assigns_;
  std::vector<std::string>& replaced_;
  std::vector<const char*> known_;
};

}  // namespace detail

/// A file holds options that earlier versions had. What it says is a line, and one for each of them.
class ReplacedOptionsError : public Error {
 public:
  using Error::Error;
};

/// All options of a filter's stages as YAML, one map a stage.
template <class Policies>
std::string options_as_yaml(FrameFilter<Policies>& filter) {
  std::string yaml;
  detail::OptionWriter writer(yaml);
  each_option(filter, writer);
  return yaml;
}

/// Writes `options_as_yaml` to a file, all of it or none.
/// @throws Error if it can't be written.
template <class Policies>
void write_options(const std::filesystem::path& file, FrameFilter<Policies>& filter) {
  AtomicFile output(file);
  output.write(options_as_yaml(filter));
  output.commit();
}

/// Sets the options that a file names; the others stay. Call it before the first frame. A filter without movers skips
/// the group `movers`, so that one file serves sets with and without them.
/// @throws Error naming file, line and option, what was found and what was expected: an option that no stage of this
/// filter
///         has, a value of the wrong kind or out of its range. `ReplacedOptionsError` naming what replaced each, where
///         it holds options that earlier versions had. Then no option was changed.
template <class Policies>
void read_options(const std::filesystem::path& file, FrameFilter<Policies>& filter) {
  const YamlFile yaml(file);
  for (const bool assigns : {false, true}) {
    std::vector<std::string> replaced;
    detail::OptionReader reader(yaml, yaml.root(), "", assigns, replaced);
    each_option(filter, reader);
    reader.require_all_known("movers");
    if (replaced.empty()) continue;
    std::string list;
    for (const std::string& line : replaced) list += "\n  " + line;
    throw ReplacedOptionsError(file.string() + ": " + std::to_string(replaced.size()) +
                               (replaced.size() == 1 ? " option is" : " options are") + " gone; delete or rename" +
                               list);
  }
}

}  // namespace stillpoint
