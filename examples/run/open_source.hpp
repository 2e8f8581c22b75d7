// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From the command line to the source of frames that it names.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "bag_source.hpp"
#include "frame_source.hpp"
#include "image_sources.hpp"
#include "options.hpp"
#include "stereo_sources.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint_run {

/// Opens what the options name.
/// @throws stillpoint::Error where it can't be read, or lacks what the options ask of it.
inline std::unique_ptr<FrameSource> open_source(const Options& options) {
  std::unique_ptr<FrameSource> source;
  if (options.demo)
    source = std::make_unique<DemoSource>(options);
  else if (!options.tum.empty())
    source = std::make_unique<TumSource>(options);
  else if (!options.euroc.empty())
    source = std::make_unique<EurocSource>(options);
  else if (!options.bag.empty())
    source = open_bag(options);
  else if (!options.right.empty())
    source = std::make_unique<StereoFolderSource>(options);
  else if (!options.images.empty())
    source = std::make_unique<ImageFolderSource>(options);
  else
    source = std::make_unique<VideoFrames>(options);
  const std::optional<std::size_t> size = source->size();
  if (size && static_cast<std::size_t>(options.start) >= *size)
    throw stillpoint::Error("--start: found " + std::to_string(options.start) + ", expected less than " +
                            std::to_string(*size) + ", the number of frames of " + source->name());
  if (options.prior == "labels" && !source->has_labels())
    throw stillpoint::Error("--prior: found labels, but " + source->name() +
                            " has none; expected a folder with label images in labels/");
  return source;
}

}  // namespace stillpoint_run
