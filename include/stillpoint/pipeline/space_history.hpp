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
#include "stillpoint/core/image.hpp"
#include "stillpoint/depth/depth_scale.hpp"

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
    constexpr int kBlocksAlong = 160;
    block_px = std::max(1.0f, static_cast<float>(frame.gray.longer_side_px()) / kBlocksAlong);
    width = blocks_of(frame.gray.width);
    height = blocks_of(frame.gray.height);
    timestamp_s = frame.timestamp_s;
    filter_from_camera = pose;
    refill(nearest_m, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
    const ImageView& depth = frame.depth.image;
    if (depth.empty()) return;
    if (depth.format == PixelFormat::depth16)
      pool<std::uint16_t>(frame);
    else
      pool<float>(frame);
    spread_nearest();
  }

 private:
  /// The last one may be cut off; what rounding leaves is none.
  int blocks_of(int side_px) const noexcept {
    return static_cast<int>(std::ceil(static_cast<float>(side_px) / block_px - 1e-3f));
  }

  /// The nearest of each block, compared in the units of the image: one division for a block.
  template <class Depth>
  void pool(const FrameView& frame) {
    constexpr Depth kMost = std::numeric_limits<Depth>::max();
    const ImageView& depth = frame.depth.image;
    const DepthScale to_depth(frame.gray, depth);
    const float across = to_depth.x * block_px, down = to_depth.y * block_px;
    for (int v = 0; v < height; ++v) {
      const Pixels rows = pixels_of(v, down, depth.height);
      for (int u = 0; u < width; ++u) {
        const Pixels columns = pixels_of(u, across, depth.width);
        int known = 0;
        Depth nearest = kMost;
        for (int y = rows.first; y < rows.end; ++y)
          for (int x = columns.first; x < columns.end; ++x) {
            const Depth there = depth.row<Depth>(y)[x];
            if (!(there > 0 && there <= kMost)) continue;  // nothing, or not finite
            ++known;
            nearest = std::min(nearest, there);
          }
        if (2 * known >= (columns.end - columns.first) * (rows.end - rows.first))
          nearest_m[index(u, v)] = frame.depth.metres(nearest);
      }
    }
  }

  struct Pixels {
    int first, end;
  };

  /// Of the depth image, in one row or column of blocks: at least one.
  static Pixels pixels_of(int block, float pixels_per_block, int side_px) noexcept {
    const int first = std::min(static_cast<int>(static_cast<float>(block) * pixels_per_block), side_px - 1);
    const int end = static_cast<int>(static_cast<float>(block + 1) * pixels_per_block);
    return {first, std::min(std::max(first + 1, end), side_px)};
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
