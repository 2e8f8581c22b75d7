// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host with a detector in a thread of its own, or rather without its file.

#include <cstdio>
#include <stillpoint/detectors/async_detector.hpp>
#include <stillpoint/detectors/opencv_dnn.hpp>

int main() {
  try {
    stillpoint::AsyncDetector<stillpoint::OpenCvDetector> detector(stillpoint::OpenCvDetector("no_such_network.onnx"));
    stillpoint::DetectorAnswer answer;
    detector.offer(stillpoint::ImageView(), 0.0);
    detector.take(answer);
  } catch (const stillpoint::Error& error) {
    std::printf("kept 4 of 4, %s\n", error.what());
  }
}
