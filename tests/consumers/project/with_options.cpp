// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host that sets its filter from a file, without any reader of images.

#include <cstdio>
#include <fstream>
#include <stillpoint/options/options_file.hpp>
#include <stillpoint/stillpoint.hpp>

int main() {
  std::ofstream("options.yaml") << "keep_floor:\n  fewest_features: 500\n";
  stillpoint::FrameFilter<> filter(stillpoint::Camera(525, 525, 319.5, 239.5, 640, 480));
  stillpoint::read_options("options.yaml", filter);
  std::printf("kept %zu of 500\n", filter.keep_floor.options.fewest_features);
}
