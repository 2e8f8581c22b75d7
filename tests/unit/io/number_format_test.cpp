// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/number_format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <string>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

TEST(FormatFixed, HasTheDecimalsThatWereAskedFor) {
  EXPECT_EQ(format_fixed(1.0, 0), "1");
  EXPECT_EQ(format_fixed(-0.5, 3), "-0.500");
  EXPECT_EQ(format_fixed(2.0 / 3.0, 4), "0.6667");
  EXPECT_EQ(format_fixed(1e20, 1), "100000000000000000000.0");
  EXPECT_EQ(format_fixed(1.0, -3), "1");
}

TEST(FormatFixed, HasRoomForTheLargestAndNamesForTheRest) {
  EXPECT_EQ(format_fixed(-std::numeric_limits<double>::max(), 100).size(), 1u + 309u + 1u + 100u);
  EXPECT_EQ(format_fixed(std::numeric_limits<double>::infinity(), 3), "inf");
  EXPECT_EQ(format_fixed(std::numeric_limits<double>::quiet_NaN(), 3), "nan");
}

TEST(FormatTimestamp, IsWhatStoodInTheFile) {
  for (const char* text : {"1.033333", "1305031102.160407", "0.000000", "1403636579.763556", "12.123456789"})
    EXPECT_EQ(format_timestamp(parse_number(text).value()), text);
  EXPECT_EQ(format_timestamp(1.5), "1.500000");
  EXPECT_EQ(format_timestamp(1.03125), "1.031250");
  EXPECT_EQ(format_timestamp(std::numeric_limits<double>::infinity()), "inf");
}

TEST(FormatTimestamp, ReadsBackAsTheSameNumber) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const double value = random.uniform(-2e9, 2e9) * std::pow(10.0, random.uniform(-12.0, 0.0));
    EXPECT_EQ(parse_number(format_timestamp(value)).value(), value);
  }
}

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(parse_number("-1.5e3").value(), -1500.0);
  EXPECT_EQ(parse_number("+2").value(), 2.0);
  EXPECT_EQ(parse_number(".5").value(), 0.5);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_TRUE(std::isinf(parse_number("-inf").value()));
  for (const char* text : {"", "+", "-", "+-1", "1.5x", "1,5", "0x10", " 1", "1 ", "1e999", "one"})
    EXPECT_FALSE(parse_number(text)) << text;
}

/// Writes 1.234,5 where C writes 1234.5.
struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Numbers, DoNotDependOnTheHostsLocale) {
  const std::locale old = std::locale::global(std::locale(std::locale(), new CommaNumbers));
  EXPECT_EQ(format_fixed(1234.5, 2), "1234.50");
  EXPECT_EQ(format_timestamp(1234.5), "1234.500000");
  EXPECT_EQ(parse_number("1234.5").value(), 1234.5);
  std::locale::global(old);
}

}  // namespace
}  // namespace stillpoint
