// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Options by parameters: every kind of option, and what is out of its range.

#include "stillpoint_ros/parameters.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "unit/error_of.hpp"

namespace stillpoint_ros::parameters_test {

struct Group {
  float share = 0.1f;
  bool is_on = false;
};
template <class Visit>
void each_option(Group& group, Visit& visit) {
  visit("share", group.share, stillpoint::OptionRange{0, 1});
  visit("is_on", group.is_on);
}
struct Table {
  int count = 3;
  Group group;
  std::uint64_t seed = 7;
  enum Colour { red, green } colour = red;
};
template <class Visit>
void each_option(Table& table, Visit& visit) {
  visit("count", table.count, stillpoint::OptionRange{1, 10});
  visit("group", table.group);
  visit.seed("seed", table.seed);
  visit.choice("colour", table.colour, "red", "green");
}

struct Given {
  std::map<std::string, std::variant<bool, std::int64_t, double, std::string>> values;

  template <class Value>
  Value get(const std::string& name, const Value& value) const {
    const auto found = values.find(name);
    return found == values.end() ? value : std::get<Value>(found->second);
  }
};

/// As NodeCore::start does it. Returns the names of all options.
template <class Options>
std::vector<std::string> read_parameters(Options& options, Given& given) {
  std::vector<std::string> names;
  ParameterReader<Given> reader(given, names);
  each_option(options, reader);
  return names;
}

TEST(Parameters, NothingGivenChangesNothing) {
  Table table;
  Given nothing;
  EXPECT_EQ(read_parameters(table, nothing),
            (std::vector<std::string>{"count", "group.share", "group.is_on", "seed", "colour"}));
  EXPECT_EQ(table.count, 3);
  EXPECT_EQ(table.group.share, 0.1f);
  EXPECT_FALSE(table.group.is_on);
  EXPECT_EQ(table.seed, 7u);
  EXPECT_EQ(table.colour, Table::red);
}

TEST(Parameters, EachKindIsSet) {
  Table table;
  Given given{{{"count", std::int64_t{5}},
               {"group.share", 0.25},
               {"group.is_on", true},
               {"seed", std::int64_t{11}},
               {"colour", std::string("green")}}};
  read_parameters(table, given);
  EXPECT_EQ(table.count, 5);
  EXPECT_EQ(table.group.share, 0.25f);
  EXPECT_TRUE(table.group.is_on);
  EXPECT_EQ(table.seed, 11u);
  EXPECT_EQ(table.colour, Table::green);
}

TEST(Parameters, WhatIsOutOfItsRangeIsNamed) {
  const auto error = [](const char* name, auto value) {
    Table table;
    Given given{{{name, value}}};
    return stillpoint::error_of([&] { read_parameters(table, given); });
  };
  EXPECT_EQ(error("count", std::int64_t{11}), "parameter count is 11, expected a whole number from 1 to 10");
  EXPECT_EQ(error("group.share", -0.5), "parameter group.share is -0.5, expected a number from 0 to 1");
  EXPECT_EQ(error("colour", std::string("blue")), "parameter colour is 'blue', expected red or green");
}

struct Seeds {
  std::uint64_t large = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t small = 7;
};
template <class Visit>
void each_option(Seeds& seeds, Visit& visit) {
  visit.seed("large", seeds.large);
  visit.seed("small", seeds.small);
}

TEST(Parameters, ASeedThatItsTypeCannotHoldIsNamed) {
  const auto error = [](const char* name, std::int64_t value) {
    Seeds seeds;
    Given given{{{name, value}}};
    return stillpoint::error_of([&] { read_parameters(seeds, given); });
  };
  EXPECT_EQ(error("large", -2), "parameter large is -2, expected a whole number from 0 to 9223372036854775807");
  EXPECT_EQ(error("small", -1), "parameter small is -1, expected a whole number from 0 to 4294967295");
  EXPECT_EQ(error("small", 4294967296), "parameter small is 4294967296, expected a whole number from 0 to 4294967295");
}

TEST(Parameters, ASeedAboveWhatAParameterHoldsStaysWhereNothingIsGiven) {
  Seeds seeds;
  Given nothing;
  read_parameters(seeds, nothing);
  EXPECT_EQ(seeds.large, std::numeric_limits<std::uint64_t>::max());
  Given largest{{{"large", std::numeric_limits<std::int64_t>::max()}, {"small", std::int64_t{4294967295}}}};
  read_parameters(seeds, largest);
  EXPECT_EQ(seeds.large, std::uint64_t{9223372036854775807});
  EXPECT_EQ(seeds.small, 4294967295u);
}

TEST(Parameters, AMisspelledOneIsFound) {
  EXPECT_EQ(unknown_parameter({"count", "group.shares"}, {"count", "group.share"}), "group.shares");
  EXPECT_EQ(unknown_parameter({"count"}, {"count", "group.share"}), "");
}

}  // namespace stillpoint_ros::parameters_test
