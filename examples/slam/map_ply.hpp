// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The map as a file that people look at: PLY, with the points in their colours and each keyframe as a pyramid.

#include <string>

#include "map.hpp"
#include "stillpoint/core/camera.hpp"

namespace examples::slam {

/// PLY as text, metres, in the world of the first keyframe. Points that only one keyframe has seen are left out.
std::string map_as_ply(const Map& map, const stillpoint::Camera& camera);

}  // namespace examples::slam
