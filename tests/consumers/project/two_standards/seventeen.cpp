// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#if __cplusplus != 201703L
#error "this file is C++17"
#endif

#include "../tripod_policies.hpp"

using Filter = stillpoint::FrameFilter<TripodPolicies>;

Filter make_filter() { return Filter(stillpoint::Camera(60, 60, 32, 24, 64, 48)); }
