// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// One program of two files that see the library in two standards: its classes must be the same in both.

#include <cstddef>
#include <cstdio>

std::size_t count_kept();

int main() { std::printf("kept %zu of 4\n", count_kept()); }
