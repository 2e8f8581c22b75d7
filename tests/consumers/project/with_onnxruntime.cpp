// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host with a detector on ONNX Runtime, or rather without its file.

#include <cstdio>
#include <stillpoint/detectors/onnxruntime.hpp>

int main() {
  try {
    const stillpoint::OnnxRuntimeDetector detector("no_such_network.onnx");
  } catch (const stillpoint::Error& error) {
    std::printf("kept 4 of 4, %s\n", error.what());
  }
}
