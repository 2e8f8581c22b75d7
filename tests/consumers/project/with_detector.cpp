// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host with a detector, or rather without its file.

#include <cstdio>
#include <stillpoint/detectors/opencv_dnn.hpp>

int main() {
  try {
    const stillpoint::OpenCvDetector detector("no_such_network.onnx");
  } catch (const stillpoint::Error& error) {
    std::printf("kept 4 of 4, %s\n", error.what());
  }
}
