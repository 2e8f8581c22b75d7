// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Names of the types that a host's own headers mention, without their definitions: a header that holds a pointer or a
// reference includes this and no Eigen, no OpenCV, no stage. The file that makes or calls the filter includes
// stillpoint.hpp. What holds `std::unique_ptr<stillpoint::FrameFilter<>>` needs its destructor in that file.

namespace stillpoint {

struct AnyDistortion;
template <class Distortion>
class PinholeCamera;
using Camera = PinholeCamera<AnyDistortion>;

struct ImageView;
class ImageBuffer;
struct DepthView;
struct FrameView;
struct Detection;
class FrameResult;

struct DefaultPolicies;
struct MonocularPolicies;
struct PaperPolicies;
struct PaperRigidPolicies;
struct CompiledPolicies;  // those of the library stillpoint::compiled (compiled.hpp)
#ifdef STILLPOINT_COMPILED
template <class Policies = CompiledPolicies>
class FrameFilter;
template <class Policies = CompiledPolicies>
struct WithMovers;  // policies/with_movers.hpp
#else
template <class Policies = DefaultPolicies>
class FrameFilter;
template <class Policies = DefaultPolicies>
struct WithMovers;
#endif

}  // namespace stillpoint
