// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/workspace.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

template <class T>
bool aligned(span<T> elements) {
  return reinterpret_cast<std::uintptr_t>(elements.data()) % 64 == 0;
}

TEST(Workspace, GivesAlignedArraysOfTheValueAskedFor) {
  Workspace workspace;
  for (const std::size_t count : {1u, 3u, 64u, 65u, 1000u}) {
    const span<std::uint8_t> bytes = workspace.take<std::uint8_t>(count, 7);
    const span<double> zeros = workspace.take<double>(count);
    const span<Matrix3d> matrices = workspace.take<Matrix3d>(count, Matrix3d::Identity());
    EXPECT_TRUE(aligned(bytes) && aligned(zeros) && aligned(matrices));
    ASSERT_EQ(bytes.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(bytes[i], 7);
      ASSERT_EQ(zeros[i], 0.0);
      ASSERT_EQ(matrices[i], Matrix3d::Identity());
    }
  }
}

TEST(Workspace, OldContentDoesNotShineThrough) {
  Workspace workspace;
  for (double& value : workspace.take<double>(100)) value = 42.0;
  workspace.rewind();
  for (const double value : workspace.take<double>(100)) EXPECT_EQ(value, 0.0);
}

// Arrays that are alive together never overlap, however the arena grows: each is filled with its own number and read
// again at the end.
TEST(Workspace, ArraysNeverOverlap) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Workspace workspace;
    std::vector<span<std::uint32_t>> arrays;
    for (std::uint32_t a = 0; a < 30; ++a) {
      const std::size_t largest = random.index(10) == 0 ? 100000 : 2000;
      arrays.push_back(workspace.take<std::uint32_t>(random.index(largest), a));
      if (random.index(4) == 0) {
        const Workspace::Scope scope(workspace);
        for (std::uint32_t& scratch : workspace.take<std::uint32_t>(random.index(largest))) scratch = 0xffffffffu;
      }
    }
    for (std::uint32_t a = 0; a < 30; ++a)
      for (const std::uint32_t value : arrays[a]) ASSERT_EQ(value, a) << "seed " << seed;
  }
}

TEST(Workspace, ScopeGivesItsMemoryBack) {
  Workspace workspace;
  workspace.take<int>(10);
  const int* inside = nullptr;
  {
    const Workspace::Scope outer(workspace);
    inside = workspace.take<int>(10).data();
    {
      const Workspace::Scope inner(workspace);
      EXPECT_NE(workspace.take<int>(10).data(), inside);
    }
  }
  EXPECT_EQ(workspace.take<int>(10).data(), inside);
}

TEST(Workspace, ScopeThatGrewTheArenaGivesItsMemoryBack) {
  Workspace workspace;
  const int* const first = workspace.take<int>(10).data();
  {
    const Workspace::Scope scope(workspace);
    workspace.take<char>(1 << 20);
  }
  const int* const second = workspace.take<int>(10).data();
  EXPECT_EQ(second - first, 16) << "expected the next 64 bytes of the first block";
}

TEST(Workspace, RewindReusesTheSameMemory) {
  Workspace workspace;
  const auto frame = [&workspace] {
    workspace.rewind();
    std::vector<const void*> addresses;
    for (const std::size_t count : {100u, 30000u, 5u, 200000u, 0u, 17u})
      addresses.push_back(workspace.take<double>(count).data());
    return addresses;
  };
  const auto first = frame();
  EXPECT_EQ(frame(), first);
  EXPECT_EQ(frame(), first);
}

TEST(Workspace, EmptyArraysAreFine) {
  Workspace workspace;
  EXPECT_TRUE(workspace.take<double>(0).empty());
  EXPECT_EQ(workspace.take<double>(1)[0], 0.0);
}

}  // namespace
}  // namespace stillpoint
