// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/span.hpp"

#include <gtest/gtest.h>

#include <array>
#include <type_traits>
#include <vector>

namespace stillpoint {
namespace {

static_assert(std::is_convertible_v<span<int>, span<const int>>);
static_assert(!std::is_convertible_v<span<const int>, span<int>>, "a view must not take constness away");
static_assert(!std::is_convertible_v<const std::vector<int>&, span<int>>);
static_assert(!std::is_convertible_v<std::vector<int>&, span<double>>);
struct Base {};
struct Derived : Base {
  int more = 0;
};
static_assert(!std::is_convertible_v<std::vector<Derived>&, span<Base>>, "elements would be sliced");

TEST(Span, SeesTheElementsOfContiguousRanges) {
  std::vector<int> vector = {1, 2, 3};
  std::array<int, 3> array = {4, 5, 6};
  const span<int> of_vector(vector), of_array(array);
  EXPECT_EQ(of_vector.data(), vector.data());
  EXPECT_EQ(of_vector.size(), 3u);
  EXPECT_EQ(of_array[2], 6);
  of_vector[1] = 20;
  EXPECT_EQ(vector[1], 20);
  int plain[] = {7, 8};
  const span<const int> of_plain(plain);
  EXPECT_EQ(of_plain.data(), plain);
  EXPECT_EQ(of_plain.size(), 2u);
  static_assert(std::is_same_v<decltype(span(plain)), span<int>>);
  static_assert(std::is_same_v<decltype(span(vector)), span<int>>);
  static_assert(std::is_same_v<decltype(span(std::as_const(vector))), span<const int>>);
}

TEST(Span, PartsAreCountedFromTheirOffset) {
  std::vector<int> vector = {0, 1, 2, 3, 4};
  const span<int> all(vector);
  EXPECT_EQ(all.front(), 0);
  EXPECT_EQ(all.back(), 4);
  EXPECT_EQ(all.first(2).size(), 2u);
  EXPECT_EQ(all.first(2).back(), 1);
  EXPECT_EQ(all.subspan(1, 3).front(), 1);
  EXPECT_EQ(all.subspan(1, 3).back(), 3);
  EXPECT_TRUE(all.subspan(5, 0).empty());
  int sum = 0;
  for (const int value : all) sum += value;
  EXPECT_EQ(sum, 10);
}

TEST(Span, DefaultIsEmpty) {
  const span<int> none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.begin(), none.end());
}

}  // namespace
}  // namespace stillpoint
