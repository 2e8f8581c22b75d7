// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where was space seen free?   Small depth images of the past seconds: an object where a camera saw free space is a
// newcomer. It needs neither a match nor texture.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// A depth image, pooled: the nearest depth of each block of pixels.
struct PooledDepth {
  std::vector<float> nearest_m;  ///< of a block and those around it, row by row; 0 where half of one has no depth
  int width = 0, height = 0;
  float block_px = 4;  ///< pixels of the gray image to a side of a block
  double timestamp_s = 0.0;
  Pose filter_from_camera = Pose::Identity();

  /// The nearest depth within one block around a pixel, metres; 0 where a block there is unknown or outside.
  float nearest_around(const Vector2f& pixel) const noexcept {
    const float u = (pixel.x() + 0.5f) / block_px, v = (pixel.y() + 0.5f) / block_px;
    if (!(u >= 0.0f && v >= 0.0f && u < static_cast<float>(width) && v < static_cast<float>(height))) return 0.0f;
    return nearest_m[index(static_cast<int>(u), static_cast<int>(v))];
  }

  void assign(const FrameView& frame, const Pose& pose) {
    constexpr int kBlocksAcross = 160;
    block_px = std::max(1.0f, static_cast<float>(frame.gray.width) / kBlocksAcross);
    width = static_cast<int>(static_cast<float>(frame.gray.width) / block_px);
    height = static_cast<int>(std::ceil(static_cast<float>(frame.gray.height) / block_px));
    timestamp_s = frame.timestamp_s;
    filter_from_camera = pose;
    refill(nearest_m, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
    const ImageView& depth = frame.depth.image;
    if (depth.empty()) return;
    if (depth.format == PixelFormat::depth16)
      pool<std::uint16_t>(frame.depth, static_cast<float>(frame.gray.height));
    else
      pool<float>(frame.depth, static_cast<float>(frame.gray.height));
    spread_nearest();
  }

 private:
  /// The nearest of each block, compared in the units of the image: one division for a block.
  template <class Depth>
  void pool(const DepthView& depth, float gray_height) {
    constexpr Depth kMost = std::numeric_limits<Depth>::max();
    const float across = static_cast<float>(depth.image.width) / static_cast<float>(width);
    const float down = static_cast<float>(depth.image.height) / gray_height * block_px;  // the last may be cut off
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const int first_u = static_cast<int>(static_cast<float>(u) * across);
        const int last_u = std::max(first_u + 1, static_cast<int>(static_cast<float>(u + 1) * across));
        const int first_v = std::min(static_cast<int>(static_cast<float>(v) * down), depth.image.height - 1);
        const int last_v =
            std::min(std::max(first_v + 1, static_cast<int>(static_cast<float>(v + 1) * down)), depth.image.height);
        int known = 0;
        Depth nearest = kMost;
        for (int y = first_v; y < last_v; ++y)
          for (int x = first_u; x < last_u; ++x) {
            const Depth there = depth.image.row<Depth>(y)[x];
            if (!(there > 0 && there <= kMost)) continue;  // nothing, or not finite
            ++known;
            nearest = std::min(nearest, there);
          }
        if (2 * known >= (last_u - first_u) * (last_v - first_v)) nearest_m[index(u, v)] = depth.metres(nearest);
      }
  }

  /// Least of three by three, in place: each row's least of three, then the rows above and below. A border block has
  /// neighbours that are unknown.
  void spread_nearest() {
    for (int v = 0; v < height; ++v) {
      float* const row = nearest_m.data() + index(0, v);
      float left = 0.0f;
      for (int u = 0; u < width; ++u) {
        const float here = row[u], right = u + 1 < width ? row[u + 1] : 0.0f;
        row[u] = std::min({left, here, right});
        left = here;
      }
    }
    for (int u = 0; u < width; ++u) {
      float above = 0.0f;
      for (int v = 0; v < height; ++v) {
        const float here = nearest_m[index(u, v)], below = v + 1 < height ? nearest_m[index(u, v + 1)] : 0.0f;
        nearest_m[index(u, v)] = std::min({above, here, below});
        above = here;
      }
    }
  }

  std::size_t index(int u, int v) const noexcept {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

/// A ring of pooled depth images, one each `kSpacing_s`. Memory is reused.
class SpaceHistory {
 public:
  static constexpr double kSpacing_s = 0.4;
  static constexpr std::size_t kViews = 12;

  void clear() noexcept { size_ = 0; }

  void push(const FrameView& frame, const Pose& filter_from_camera) {
    if (size_ > 0) {
      const double since_s = frame.timestamp_s - back(1).timestamp_s;
      if (since_s < kSpacing_s - 1e-3) return;
    }
    ring_[head_].assign(frame, filter_from_camera);
    for (PooledDepth& view : ring_)
      view.nearest_m.reserve(ring_[head_].nearest_m.size());  // nothing is allocated later
    head_ = (head_ + 1) % ring_.size();
    size_ = std::min(size_ + 1, ring_.size());
  }

  std::size_t size() const noexcept { return size_; }
  /// 1 is the newest.
  const PooledDepth& back(std::size_t age) const noexcept { return ring_[(head_ + ring_.size() - age) % ring_.size()]; }

 private:
  std::vector<PooledDepth> ring_{kViews};
  std::size_t head_ = 0, size_ = 0;
};

}  // namespace stillpoint
