// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of a filter's stages from and to YAML, so that a run can be repeated and a camera's own noise be kept.

#include <opencv2/core/persistence.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/yaml_file.hpp"
#include "stillpoint/options/replaced_options.hpp"
#include "stillpoint/options/stage_options.hpp"

namespace stillpoint {

namespace detail {

/// Writes every option of a stage into the map that is open.
class OptionWriter : public LooksAtOptions<OptionWriter> {
 public:
  explicit OptionWriter(cv::FileStorage& storage) : storage_(storage) {}

  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      cv::write(storage_, name, static_cast<int>(value));
    } else if constexpr (std::is_integral_v<T>) {
      // FileStorage holds 32 bits; what is longer goes as text.
      if (value <= static_cast<T>(std::numeric_limits<int>::max()))
        cv::write(storage_, name, static_cast<int>(value));
      else
        cv::write(storage_, name, std::to_string(value));
    } else if constexpr (std::is_floating_point_v<T>) {
      cv::write(storage_, name, value);
    } else if constexpr (has_options<T, OptionWriter>::value) {
      storage_.startWriteStruct(name, cv::FileNode::MAP);
      each_option(value, *this);
      storage_.endWriteStruct();
    }
  }
  void word(const char* name, const char* text) { cv::write(storage_, name, std::string(text)); }

 private:
  cv::FileStorage& storage_;
};

/// Reads the options of a map. Options that are not there keep their values; one that no stage has is an error.
class OptionReader {
 public:
  /// @param assigns   false: the map is checked and nothing is changed
  /// @param replaced  options of the map that earlier versions had are appended, a line each
  OptionReader(const YamlFile& file, const cv::FileNode& node, std::string path, bool assigns,
               std::vector<std::string>& replaced)
      : file_(file), node_(node), path_(std::move(path)), assigns_(assigns), replaced_(replaced) {}

  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_arithmetic_v<T>)
      read(name, value, "a number that is not negative", [](double number) { return number >= 0; });
    else
      read_group(name, value);
  }
  template <class T>
  void positive(const char* name, T& value) {
    read(name, value, "a number above 0", [](double number) { return number > 0; });
  }
  template <class T>
  void any(const char* name, T& value) {
    read(name, value, "a number", [](double) { return true; });
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const cv::FileNode entry = find(name);
    if (entry.empty()) return;
    const std::array<const char*, sizeof...(Words)> all{words...};
    std::string list;
    for (const char* word : all) list += (list.empty() ? "" : " or ") + std::string(word);
    const std::string found = entry.isString() ? entry.string() : std::string();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (found != all[i]) continue;
      if (assigns_) value = static_cast<T>(i);
      return;
    }
    file_.fail(path_ + name, entry.isString() ? "is '" + found + "'" : "is not a word", list);
  }

  /// @throws Error if the map holds what was not asked for and no earlier version had.
  void require_all_known() {
    for (const cv::FileNode entry : node_) {
      std::string list;
      bool is_known = false;
      for (const std::string& name : known_) {
        is_known = is_known || name == entry.name();
        list += (list.empty() ? "" : ", ") + name;
      }
      if (!is_known && !collect_replaced(path_ + entry.name(), entry))
        file_.fail(path_ + entry.name(), "is unknown", list.empty() ? "nothing there" : "one of " + list);
    }
  }

 private:
  /// @return false if an option in there was never one
  bool collect_replaced(const std::string& name, const cv::FileNode& entry) {
    if (entry.isMap()) {
      bool all = entry.size() > 0;
      for (const cv::FileNode nested : entry) all = collect_replaced(name + '.' + nested.name(), nested) && all;
      return all;
    }
    const std::optional<std::string_view> replacement = replacement_of(name);
    if (replacement) replaced_.push_back(name + ": " + std::string(*replacement));
    return replacement.has_value();
  }

  cv::FileNode find(const char* name) {
    known_.emplace_back(name);
    return node_[name];
  }

  template <class T, class InRange>
  void read(const char* name, T& value, const char* expected, const InRange& in_range) {
    const cv::FileNode entry = find(name);
    if (entry.empty()) return;
    if constexpr (std::is_same_v<T, bool>) {
      if (!entry.isInt() || (static_cast<int>(entry) & ~1) != 0) file_.fail(path_ + name, "is no flag", "0 or 1");
      if (assigns_) value = static_cast<int>(entry) != 0;
    } else if constexpr (std::is_integral_v<T>) {
      const T found = whole_number<T>(name, entry);
      if (!in_range(static_cast<double>(found))) file_.fail(path_ + name, "is " + std::to_string(found), expected);
      if (assigns_) value = found;
    } else {
      if (!entry.isReal() && !entry.isInt()) file_.fail(path_ + name, "is not a number", expected);
      const double found = entry.real();
      if (!std::isfinite(static_cast<T>(found))) file_.fail(path_ + name, "is not finite", expected);
      if (!in_range(found)) file_.fail(path_ + name, "is " + std::to_string(found), expected);
      if (assigns_) value = static_cast<T>(found);
    }
  }

  template <class T>
  T whole_number(const char* name, const cv::FileNode& entry) const {
    const std::string text = entry.isInt()      ? std::to_string(static_cast<int>(entry))
                             : entry.isString() ? entry.string()
                                                : std::string();
    T value{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
      file_.fail(path_ + name, text.empty() ? "is no whole number" : "is " + text,
                 "a whole number from " + std::to_string(std::is_signed_v<T> ? 0 : std::numeric_limits<T>::min()) +
                     " to " + std::to_string(std::numeric_limits<T>::max()));
    return value;
  }

  template <class T>
  void read_group(const char* name, T& group) {
    if constexpr (has_options<T, OptionReader>::value) {
      const cv::FileNode entry = find(name);
      if (entry.empty()) return;
      if (!entry.isMap()) file_.fail(path_ + name, "is no map", "options as name: value, one a line and indented");
      if constexpr (std::is_same_v<T, AnyDepthNoise>) {  // its options depend on its model: a copy is always assigned
        AnyDepthNoise copy = group;
        read_into(name, entry, copy, true);
        if (assigns_) group = copy;
      } else {
        read_into(name, entry, group, assigns_);
      }
    }
  }

  template <class T>
  void read_into(const char* name, const cv::FileNode& entry, T& group, bool assigns) {
    OptionReader nested(file_, entry, path_ + name + ".", assigns, replaced_);
    each_option(group, nested);
    nested.require_all_known();
  }

  const YamlFile& file_;
  cv::FileNode node_;
  std::string path_;
  bool assigns_;
  std::vector<std::string>& replaced_;
  std::vector<std::string> known_;
};

}  // namespace detail

/// All options of a filter's stages as YAML (OpenCV's FileStorage), one map a stage.
template <class Policies>
std::string options_as_yaml(FrameFilter<Policies>& filter) {
  cv::FileStorage storage("options.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  detail::OptionWriter writer(storage);
  each_option(filter, writer);
  return storage.releaseAndGetString();
}

/// Writes `options_as_yaml` to a file, all of it or none.
/// @throws Error if it can't be written.
template <class Policies>
void write_options(const std::filesystem::path& file, FrameFilter<Policies>& filter) {
  AtomicFile output(file);
  output.write(options_as_yaml(filter));
  output.commit();
}

/// Sets the options that a file names; the others stay. Call it before the first frame.
/// @throws Error naming file and option, what was found and what was expected: an option that no stage of this filter
///         has, a value of the wrong kind or out of range. Where the file holds options that earlier versions had, what
///         replaced each of them, a line each. Then no option was changed.
template <class Policies>
void read_options(const std::filesystem::path& file, FrameFilter<Policies>& filter) {
  const YamlFile yaml(file);
  for (const bool assigns : {false, true}) {
    std::vector<std::string> replaced;
    detail::OptionReader reader(yaml, yaml.root(), "", assigns, replaced);
    each_option(filter, reader);
    reader.require_all_known();
    if (replaced.empty()) continue;
    std::string list;
    for (const std::string& line : replaced) list += "\n  " + line;
    throw Error(file.string() + ": " + std::to_string(replaced.size()) +
                (replaced.size() == 1 ? " option is" : " options are") + " gone; delete or rename" + list);
  }
}

}  // namespace stillpoint
