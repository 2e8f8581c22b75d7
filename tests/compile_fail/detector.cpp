// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A detector that returns what it found.
// expected: stillpoint: a Detector must offer void detect(const ImageView&, std::vector<Detection>&); see detectors/async_detector.hpp

#include "stillpoint/detectors/async_detector.hpp"

struct SoundDetector {
  void detect(const stillpoint::ImageView&, std::vector<stillpoint::Detection>&) {}
};
struct ReturningDetector {
  std::vector<stillpoint::Detection> detect(const stillpoint::ImageView&) { return {}; }
};

#ifdef STILLPOINT_MISTAKE
template class stillpoint::AsyncDetector<ReturningDetector>;
#else
template class stillpoint::AsyncDetector<SoundDetector>;
#endif
