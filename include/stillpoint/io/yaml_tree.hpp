// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// YAML as a tree of names and texts, parsed by yaml-cpp, limited in depth.

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint {

/// A value of a YAML file: a word or number, a list, a map or nothing.
struct YamlNode {
  enum class Kind { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  std::string name;               ///< in the map that it is an entry of
  std::string text;               ///< of a scalar
  bool is_quoted = false;         ///< "3" is a word, 3 a number
  int line = 0;                   ///< where it, or its name, begins, from 1 on; 0: of no file
  std::vector<YamlNode> entries;  ///< of a list or map

  /// The entry of a map; null where there is none, also of what is no map.
  const YamlNode* find(std::string_view entry_name) const noexcept {
    if (kind != Kind::map) return nullptr;
    for (const YamlNode& entry : entries)
      if (entry.name == entry_name) return &entry;
    return nullptr;
  }

  /// The number that a scalar is, maybe not finite; nothing where it is none.
  std::optional<double> number() const {
    if (kind != Kind::scalar || is_quoted) return std::nullopt;
    const bool has_sign = !text.empty() && (text[0] == '-' || text[0] == '+');
    const std::string_view word = std::string_view(text).substr(has_sign ? 1 : 0);
    for (const char* name_of_it : {".inf", ".Inf", ".INF"})
      if (word == name_of_it) return std::numeric_limits<double>::infinity() * (text[0] == '-' ? -1 : 1);
    for (const char* name_of_it : {".nan", ".NaN", ".NAN", ".Nan"})  // the last one is OpenCV's
      if (word == name_of_it) return std::numeric_limits<double>::quiet_NaN();
    return parse_number(text);
  }
};

namespace detail {

/// Builds the tree while yaml-cpp parses. What a file of settings has no use for is an error: aliases, names that are
/// lists, one name twice. Too deep a nesting is one before the parser, which is recursive, goes there.
class YamlTreeBuilder : public YAML::EventHandler {
 public:
  explicit YamlTreeBuilder(const std::string& file) : file_(file) {}

  YamlNode root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    require(!expects_name(), mark, "a name is empty");
    add(mark, YamlNode::Kind::nothing);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { require(false, mark, "an alias is not read here"); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    if (expects_name()) {
      name_ = value;
      name_line_ = mark.line + 1;
      has_name_ = true;
      return;
    }
    YamlNode& node = add(mark, YamlNode::Kind::scalar);
    node.text = value;
    node.is_quoted = tag == "!";  // what yaml-cpp says of scalars in quotes
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, YamlNode::Kind::map);
  }
  void OnMapEnd() override {
    require_each_name_once(*open_.back());
    open_.pop_back();
  }

 private:
  static constexpr std::size_t kDeepest = 32;

  void require(bool holds, const YAML::Mark& mark, const std::string& found) const {
    if (!holds) fail(mark.line + 1, found);
  }
  [[noreturn]] void fail(int line, const std::string& found) const {
    throw Error(file_ + ':' + std::to_string(line) + ": " + found + ", expected fields as name: value");
  }

  bool expects_name() const noexcept {
    return !open_.empty() && open_.back()->kind == YamlNode::Kind::map && !has_name_;
  }

  YamlNode& add(const YAML::Mark& mark, YamlNode::Kind kind) {
    YamlNode& node = open_.empty() ? root : open_.back()->entries.emplace_back();
    node.kind = kind;
    node.line = has_name_ ? name_line_ : mark.line + 1;
    if (has_name_) node.name.swap(name_);
    has_name_ = false;
    return node;
  }

  void open(const YAML::Mark& mark, YamlNode::Kind kind) {
    require(!expects_name(), mark, "a name is a list or map");
    require(open_.size() < kDeepest, mark, "nested more than " + std::to_string(kDeepest) + " deep");
    open_.push_back(&add(mark, kind));  // stays where it is: the list around it grows when this one is complete
  }

  void require_each_name_once(const YamlNode& map) const {
    std::vector<const YamlNode*> sorted;
    for (const YamlNode& entry : map.entries) sorted.push_back(&entry);
    std::sort(sorted.begin(), sorted.end(), [](const YamlNode* a, const YamlNode* b) {
      return a->name != b->name ? a->name < b->name : a->line < b->line;
    });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i]->name == sorted[i - 1]->name) fail(sorted[i]->line, sorted[i]->name + " is there twice");
  }

  const std::string& file_;
  std::vector<YamlNode*> open_;
  std::string name_;  // of the entry that comes
  int name_line_ = 0;
  bool has_name_ = false;
};

}  // namespace detail

/// Parses one YAML document. The first line of OpenCV's FileStorage, "%YAML:1.0", is none to other parsers; it is left
/// out.
/// @param file  its name, for messages
/// @return      a map, or nothing where the document is empty
/// @throws Error that names file and line
inline YamlNode parse_yaml(const std::string& file, std::string text) {
  if (text.rfind("%YAML:", 0) == 0) text[0] = '#';
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    detail::YamlTreeBuilder builder(file);
    parser.HandleNextDocument(builder);
    const YamlNode& root = builder.root;
    if (root.kind == YamlNode::Kind::scalar || root.kind == YamlNode::Kind::list)
      throw Error(file + ':' + std::to_string(root.line) + ": is no map, expected fields as name: value");
    detail::YamlTreeBuilder second(file);
    if (parser.HandleNextDocument(second)) throw Error(file + ": has two documents, expected one");
    return std::move(builder.root);
  } catch (const YAML::Exception& error) {
    throw Error(file + ':' + std::to_string(error.mark.line + 1) + ": " + error.msg + ", expected YAML");
  }
}

}  // namespace stillpoint
