// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The table of docs/tuning.md lists the options that there are, with their ranges and defaults.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "stillpoint/core/options.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint {
namespace {

struct Row {
  std::string range, value;
  bool operator==(const Row& other) const { return range == other.range && value == other.value; }
};
std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.range << ", " << row.value; }
using Rows = std::map<std::string, Row>;

/// What the visitor sees: each option with its range and value in words.
struct Listing {
  Rows rows;
  std::string path;

  template <class T>
  void operator()(const char* name, T& value, const OptionRange& range) {
    rows[path + name] = {option_text(range), in_words(value)};
  }
  template <class T>
  void seed(const char* name, T& value) {
    rows[path + name] = {"any", in_words(value)};
  }
  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (has_options<T, Listing>::value) {
      const std::string outer = path;
      path += std::string(name) + '.';
      each_option(value, *this);
      path = outer;
    }
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const std::vector<std::string> all{words...};
    std::string list;
    for (const std::string& word : all) list += (list.empty() ? "" : ", ") + word;
    rows[path + name] = {list, all[static_cast<std::size_t>(value)]};
  }

  template <class T>
  static std::string in_words(T value) {
    if constexpr (std::is_integral_v<T>) return std::to_string(value);
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
  }
};

/// The parameters of every noise model stand in the table.
Rows all_options() {
  Listing listing;
  const KinectNoise kinect;
  for (const AnyDepthNoise& noise : {AnyDepthNoise(StereoNoise{}), AnyDepthNoise(TimeOfFlightNoise{}),
                                     AnyDepthNoise(kinect)}) {  // the default comes last
    FrameFilter<> filter(Camera(500, 500, 319.5, 239.5, 640, 480));
    filter.depth_noise = noise;
    each_option(filter, listing);
  }
  return listing.rows;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

TEST(TuningDocument, ListsEachOptionWithItsRangeAndDefault) {
  std::ifstream document(STILLPOINT_DOCUMENTS "/tuning.md");
  ASSERT_TRUE(document.is_open());
  Rows found;
  bool in_table = false;
  for (std::string line; std::getline(document, line);) {
    if (line.rfind("## ", 0) == 0) in_table = line.find("All options of") != std::string::npos;
    if (!in_table || line.rfind("| `", 0) != 0) continue;
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_EQ(cells.size(), 5u) << line;
    EXPECT_FALSE(cells[1].empty()) << "the unit: " << line;
    EXPECT_FALSE(cells[4].empty()) << "the source: " << line;
    const std::string name = cells[0].substr(1, cells[0].size() - 2);
    EXPECT_TRUE(found.emplace(name, Row{cells[2], cells[3]}).second) << "twice: " << name;
  }
  const Rows expected = all_options();
  for (const auto& [name, row] : expected) {
    ASSERT_EQ(found.count(name), 1u) << name << " is not in the table";
    EXPECT_EQ(found[name], row) << name;
  }
  for (const auto& [name, row] : found) EXPECT_EQ(expected.count(name), 1u) << name << " is no option";
}

}  // namespace
}  // namespace stillpoint
