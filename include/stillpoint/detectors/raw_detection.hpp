// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the decoders have in common: what they are told, and what they answer before it is mapped back to the image.

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/tensor.hpp"

namespace stillpoint {

/// Width and height of what the network is fed with, pixels.
struct InputSize {
  int width = 0, height = 0;
};

/// What each decoder is told beside the outputs.
struct DecodeSettings {
  InputSize input;                 ///< what the network was fed with
  int class_count = 0;             ///< names in the class list
  float lowest_confidence = 0.4f;  ///< what scores less is left out; so is NaN
};

/// A box as the network gave it: pixels of its input, where the outer edge of the first pixel is 0.
struct RawDetection {
  static constexpr int kNoSource = -1;

  float left = 0, top = 0, right = 0, bottom = 0;
  float score = 0;
  int label = 0;                                  ///< the network's own number of the class
  int source = kNoSource;                         ///< row of the output that it came from: where its mask is
  std::shared_ptr<const BoxMask> mask = nullptr;  ///< stretched over the box
};

/// Appends a box given by its corners, unless it has no area, or a corner that is not finite or lies farther out than
/// any input reaches: what such a box covers is not known.
inline void append_corners(std::vector<RawDetection>& found, float left, float top, float right, float bottom,
                           float score, int label, int source) {
  constexpr float kFarthest_px = 1e6f;
  const auto is_near = [](float place) { return std::abs(place) <= kFarthest_px; };  // NaN is not
  if (!(is_near(left) && is_near(top) && is_near(right) && is_near(bottom) && right > left && bottom > top)) return;
  found.push_back({left, top, right, bottom, score, label, source});
}

/// Appends a box given by its middle.
inline void append_centred(std::vector<RawDetection>& found, float x, float y, float width, float height, float score,
                           int label, int source) {
  append_corners(found, x - width / 2, y - height / 2, x + width / 2, y + height / 2, score, label, source);
}

/// A network's number of a class, from a tensor of floats; -1 for what is none.
inline int label_of(float value) noexcept {
  return value >= 0.0f && value < 1e6f ? static_cast<int>(value + 0.5f) : -1;
}

inline float sigmoid(float x) noexcept { return 1.0f / (1.0f + std::exp(-x)); }

struct BestClass {
  int label = -1;
  float score = 0;
};

/// The largest of `count` scores, `stride` elements apart.
inline BestClass best_class(const float* scores, int count, std::ptrdiff_t stride = 1) noexcept {
  BestClass best;
  for (int c = 0; c < count; ++c)
    if (best.label < 0 || scores[c * stride] > best.score) best = {c, scores[c * stride]};
  return best;
}

/// @throws Error that says what the layout expects and which shapes the network gave.
inline void require_shape(bool fits, const char* layout, const char* expected, span<const Tensor> outputs) {
  if (!fits)
    throw Error(std::string("layout ") + layout + ": found outputs " + describe(outputs) + ", expected " + expected);
}

}  // namespace stillpoint
