// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A Darknet network that sees the same in every picture, written by hand: no model has to be there for it.

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "run_program.hpp"

namespace system_test {

/// Writes NAME.cfg and NAME.weights. Its only layer multiplies by zero, so that its biases are its answer: in each of
/// 3 x 2 cells of 32 pixels three boxes, centred (sigmoid 0 = 1/2) and as large as their anchors (exp 0 = 1), with the
/// objectness sigmoid(`objectness`) and class 0 for certain.
/// @return the .cfg
inline fs::path write_network(const fs::path& folder, const std::string& name, float objectness) {
  fs::create_directories(folder);
  const fs::path cfg = folder / (name + ".cfg");
  write_text(cfg,
             "[net]\nwidth=96\nheight=64\nchannels=3\n\n"
             "[convolutional]\nfilters=18\nsize=1\nstride=32\npad=0\nactivation=linear\n\n"
             "[yolo]\nmask=0,1,2\nanchors=30,30, 20,40, 40,20\nclasses=1\nnum=3\n");
  std::ofstream weights(folder / (name + ".weights"), std::ios::binary);
  const auto write = [&weights](const auto& value) {
    weights.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::int32_t version : {0, 2, 0}) write(version);
  write(std::uint64_t{0});  // pictures that it was trained with
  for (int anchor = 0; anchor < 3; ++anchor) write(std::array<float, 6>{0, 0, 0, 0, objectness, 8.0f});
  write(std::array<float, 18 * 3>{});
  return cfg;
}

}  // namespace system_test
