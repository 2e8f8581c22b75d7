// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How well a filter told moving features from the background, where every pixel has a known label.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// What a pixel of a label image says.
enum class PixelLabel : std::uint8_t {
  background = 0,
  ignore = 64,   ///< the rim of a mover: not counted
  parked = 128,  ///< a mover at rest: counted, but judged neither way
  moving = 255,
};

/// Features of one label, and how many of them the filter dropped.
struct DropCount {
  std::size_t features = 0;
  std::size_t dropped = 0;

  /// dropped / features in [0, 1], empty (n/a) where there is no feature.
  std::optional<double> share() const {
    if (features == 0) return std::nullopt;
    return static_cast<double>(dropped) / static_cast<double>(features);
  }
};

/// Sums up a filter's verdicts over the frames of a sequence.
class FilterScore {
 public:
  /// Counts the features of one frame. The first frame handed over is left out: no filter can know motion from it.
  /// A feature whose rounded pixel is outside the label image has no label and is not counted.
  /// @param labels  gray8, values of `PixelLabel`.
  /// @param pixels  N pixels in that image, as detected.
  /// @param keep    N bytes in the same order, 0 for a feature that the filter dropped.
  /// @throws Error if the sizes differ, the image is not gray8, or a feature lies on another value than the four.
  void add_frame(const ImageView& labels, span<const Vector2f> pixels, span<const std::uint8_t> keep) {
    if (pixels.size() != keep.size())
      throw Error("filter score: " + std::to_string(pixels.size()) + " features and " + std::to_string(keep.size()) +
                  " verdicts, expected as many of each");
    if (labels.empty() || labels.format != PixelFormat::gray8)
      throw Error("filter score: the label image is empty or not 8 bit with one channel, expected gray8");
    if (frames_++ == 0) return;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const float x = pixels[i].x(), y = pixels[i].y();
      const bool is_inside = x > -0.5f && y > -0.5f && x < static_cast<float>(labels.width) - 0.5f &&
                             y < static_cast<float>(labels.height) - 0.5f;
      if (!is_inside) continue;
      const int u = static_cast<int>(std::lround(x)), v = static_cast<int>(std::lround(y));
      count(labels.row<std::uint8_t>(v)[u], keep[i] == 0);
    }
  }

  /// Frames handed over, the first one included.
  std::size_t frames() const { return frames_; }

  const DropCount& moving() const { return moving_; }
  const DropCount& background() const { return background_; }
  const DropCount& parked() const { return parked_; }

  /// Share of the moving features that were dropped: 1 is best.
  std::optional<double> recall() const { return moving_.share(); }
  /// Share of the background's features that were dropped: 0 is best.
  std::optional<double> false_positive_rate() const { return background_.share(); }
  [[deprecated("false_positive_rate()")]] std::optional<double> false_alarms() const { return false_positive_rate(); }
  /// Share of the features on movers at rest that were dropped.
  std::optional<double> parked_dropped() const { return parked_.share(); }

 private:
  void count(std::uint8_t label, bool dropped) {
    DropCount* counted = nullptr;
    switch (static_cast<PixelLabel>(label)) {
      case PixelLabel::background: counted = &background_; break;
      case PixelLabel::parked: counted = &parked_; break;
      case PixelLabel::moving: counted = &moving_; break;
      case PixelLabel::ignore: return;
    }
    if (counted == nullptr)
      throw Error("filter score: label " + std::to_string(label) + ", expected 0, 64, 128 or 255");
    ++counted->features;
    counted->dropped += dropped ? 1 : 0;
  }

  std::size_t frames_ = 0;
  DropCount moving_, background_, parked_;
};

}  // namespace stillpoint
