// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Readers of YAML: cameras, EuRoC's sensors, options of the stages. The first byte says which reader.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "bytes.hpp"
#include "input_folder.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/euroc_sensor.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/policies.hpp"

namespace {

void expect_sound(const stillpoint::Camera& camera) {
  fuzz::require(camera.width() > 0 && camera.height() > 0 && camera.fx() > 0 && camera.fy() > 0);
  fuzz::require(std::isfinite(camera.cx()) && std::isfinite(camera.cy()));
}

void read(int reader, const std::string& text) {
  static const fuzz::InputFolder folder;
  const auto file = folder.write("input.yaml", text);
  switch (reader % 4) {
    case 0: return expect_sound(stillpoint::read_camera(file).camera);
    case 1: return expect_sound(stillpoint::read_image_camera(file).camera);
    case 2: return expect_sound(stillpoint::read_euroc_camera(file).camera);
    default: {
      stillpoint::FrameFilter<> filter(stillpoint::Camera(50, 50, 32, 24, 64, 48));
      return stillpoint::read_options(file, filter);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_chosen(data, size, read);
  return 0;
}
