// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a host and a compiled library must have in common, as a type: it is a part of the library's symbols, so that the
// linker compares it. Eigen aligns its types by the instruction set; where the two differ, a program would crash.

#include <Eigen/Core>

#include "stillpoint/core/needs_cpp17.hpp"
#include "stillpoint/version.hpp"

namespace stillpoint {

/// Names of instruction sets, for the linker's message.
namespace march {
struct baseline;
struct sse3;
struct ssse3;
struct sse4_1;
struct sse4_2;
struct avx;
struct avx2;
struct avx512f;
template <class Set>
struct with_fma;
}  // namespace march

namespace detail {
#if defined(__AVX512F__)
using InstructionSet = march::avx512f;
#elif defined(__AVX2__)
using InstructionSet = march::avx2;
#elif defined(__AVX__)
using InstructionSet = march::avx;
#elif defined(__SSE4_2__)
using InstructionSet = march::sse4_2;
#elif defined(__SSE4_1__)
using InstructionSet = march::sse4_1;
#elif defined(__SSSE3__)
using InstructionSet = march::ssse3;
#elif defined(__SSE3__)
using InstructionSet = march::sse3;
#else
using InstructionSet = march::baseline;
#endif
#if defined(__FMA__)
using InstructionSets = march::with_fma<InstructionSet>;
#else
using InstructionSets = InstructionSet;
#endif
}  // namespace detail

/// Its containers change with `_GLIBCXX_DEBUG`, its strings with `_GLIBCXX_USE_CXX11_ABI`.
template <bool checks_iterators, int string_abi>
struct of_standard_library;
template <int version>
struct of_stillpoint;
template <int world, int major, int minor>
struct of_eigen;
template <int most_bytes, int most_bytes_of_static, int storage_order>
struct of_eigen_alignment;
template <class InstructionSet, class Alignment, class Eigen, class StandardLibrary, class Stillpoint>
struct HostAbi;

namespace detail {
#if defined(_GLIBCXX_DEBUG)
inline constexpr bool kChecksIterators = true;
#else
inline constexpr bool kChecksIterators = false;
#endif
#if defined(_GLIBCXX_USE_CXX11_ABI)
using StandardLibrary = of_standard_library<kChecksIterators, _GLIBCXX_USE_CXX11_ABI>;
#else
using StandardLibrary = of_standard_library<kChecksIterators, 0>;  // libc++: its namespace names its version
#endif
}  // namespace detail

/// That of this file.
using Abi = HostAbi<
    detail::InstructionSets,
    of_eigen_alignment<EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, static_cast<int>(Eigen::Matrix2d::Options)>,
    of_eigen<EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION>, detail::StandardLibrary,
    of_stillpoint<STILLPOINT_VERSION_MAJOR * 10000 + STILLPOINT_VERSION_MINOR * 100 + STILLPOINT_VERSION_PATCH>>;

}  // namespace stillpoint
