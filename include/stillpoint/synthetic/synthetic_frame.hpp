// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One rendered moment with the whole truth about it.

#include <cstddef>
#include <string>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::synthetic {

/// Values of the label image.
enum Label : std::uint8_t {
  kStatic = 0,
  kIgnored = 64,  ///< within 2 px on either side of a mover's silhouette
  kAtRest = 128,  ///< a mover's pixel that does not move now
  kMoving = 255,
};

/// Visible extent of a mover, padded by 4 px and clipped to the image. Covers the pixels [x, x + width) × [y, y +
/// height).
struct TruthBox {
  std::string class_name;
  std::size_t mover = 0;  ///< index into `Scene::movers`
  int x = 0, y = 0, width = 0, height = 0;
  int visible_pixels = 0;
};

/// Owns its images; rendering into it again allocates nothing.
struct SyntheticFrame {
  int index = 0;
  double timestamp_s = 0.0;
  ImageBuffer gray;    ///< gray8: luma of `colour`
  ImageBuffer colour;  ///< bgr8
  ImageBuffer depth;   ///< depth16, as the sensor measures it, 0 = none
  ImageBuffer
      exact_depth;        ///< depth32f, metres, of the ray through the pixel's centre when `colour` is taken, 0 = none
  ImageBuffer labels;     ///< gray8, values of `Label`
  ImageBuffer mover_ids;  ///< gray8: 0 static, k + 1 for mover k; movers beyond 254 share 255
  ImageBuffer furniture_ids;  ///< gray8: 0 no furniture, k + 1 for `Scene::furniture[k]`; those beyond 254 share 255
  Pose world_from_camera = Pose::Identity();
  std::vector<Pose> world_from_mover;  ///< one per mover
  std::vector<TruthBox> boxes;         ///< movers of at least 400 visible pixels that have a class name
  double depth_factor = 5000.0;

  /// What a host would hand to the filter. Valid until the frame is rendered again or dies.
  FrameView view() const {
    FrameView frame(gray.view(), DepthView(depth.view(), depth_factor), timestamp_s);
    frame.colour = colour.view();
    return frame;
  }
};

}  // namespace stillpoint::synthetic
