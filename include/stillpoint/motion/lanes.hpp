// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The same formulas for one number and for two side by side, which a processor works out in the same time.

#include <Eigen/Core>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// Two doubles: a register of every 64-bit processor.
using Lanes = Eigen::Array2d;

inline double lanes(double a) noexcept { return a; }
inline Lanes lanes(double a, double b) { return {a, b}; }

/// The same number in all lanes.
template <class Real>
Real lanes_of(double a);
template <>
inline double lanes_of<double>(double a) {
  return a;
}
template <>
inline Lanes lanes_of<Lanes>(double a) {
  return {a, a};
}

inline double where(bool condition, double then, double otherwise) noexcept { return condition ? then : otherwise; }
template <class Condition>
Lanes where(const Condition& condition, const Lanes& then, const Lanes& otherwise) {
  return {condition(0) ? then(0) : otherwise(0), condition(1) ? then(1) : otherwise(1)};
}

inline double sum_of(double a) noexcept { return a; }
inline double sum_of(const Lanes& a) { return a(0) + a(1); }

}  // namespace stillpoint
