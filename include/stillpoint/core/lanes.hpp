// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The same formulas for one number and for several side by side, which a processor works out in the same time. The
// types are vectors of the compilers' own (GCC's vector extensions, which Clang has, too): + - * / and comparisons need
// no templates, as Eigen's arrays do.

#include <cstring>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// Two doubles: a register of every 64-bit processor.
using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
/// Four floats.
using FloatLanes = float __attribute__((vector_size(4 * sizeof(float))));

inline double lanes(double a) noexcept { return a; }
inline Lanes lanes(double a, double b) noexcept { return Lanes{a, b}; }

/// The same number in all lanes.
template <class Real>
Real lanes_of(double a) noexcept;
template <>
inline double lanes_of<double>(double a) noexcept {
  return a;
}
template <>
inline Lanes lanes_of<Lanes>(double a) noexcept {
  return Lanes{a, a};
}

/// Four floats from memory, wherever they lie.
inline FloatLanes float_lanes(const float* values) noexcept {
  FloatLanes result;
  std::memcpy(&result, values, sizeof result);
  return result;
}

/// In each lane one of two numbers, by a comparison.
template <class Real, class Condition>
Real where(const Condition& condition, const Real& then, const Real& otherwise) noexcept {
  return condition ? then : otherwise;
}

inline FloatLanes larger(const FloatLanes& a, const FloatLanes& b) noexcept { return a > b ? a : b; }

inline double sum_of(double a) noexcept { return a; }
inline double sum_of(const Lanes& a) noexcept { return a[0] + a[1]; }
inline float sum_of(const FloatLanes& a) noexcept { return (a[0] + a[2]) + (a[1] + a[3]); }

}  // namespace stillpoint
