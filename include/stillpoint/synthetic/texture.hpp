// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A painted surface: a square tile that repeats without a seam, full of corners at several scales, with its image
// pyramid for filtered look-up.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::synthetic {

/// A colour, each channel in [0, 255].
struct Bgr {
  float blue = 0, green = 0, red = 0;
};

/// What lies under the scattered marks.
enum class Ground { plain, planks, tiles, stripes, blocks };

/// A recipe for a surface.
struct TextureStyle {
  Ground ground = Ground::plain;
  std::vector<Bgr> colours = {{200, 200, 200}, {60, 60, 60}};  ///< the first is the ground's
  double cell_m = 0.3;                                         ///< size of planks, tiles, stripes or blocks
  double largest_mark_m = 0.4;  ///< marks are scattered at this size and at halves of it, down to smallest_mark_m
  double smallest_mark_m = 0.012;
  double coverage = 0.3;  ///< share of the area that each size of marks covers
};

/// One level of a texture's pyramid: a square of texels.
struct TextureLevel {
  /// Three channels in lanes of 16 bits, blue the lowest: times weights that sum to 256 no lane overflows.
  using Texel = std::uint64_t;

  int size;                   ///< a power of two
  std::vector<Texel> texels;  ///< texel i of level l covers [i, i + 1) · 2^l of the finest one's coordinates

  /// @param x, y  1/256 of a texel
  Bgr bilinear(float x, float y) const noexcept {
    const int fixed_x = static_cast<int>(x) - 128, fixed_y = static_cast<int>(y) - 128;
    const auto fx = static_cast<Texel>(fixed_x & 255), fy = static_cast<Texel>(fixed_y & 255);
    const int mask = size - 1;
    const int left = (fixed_x >> 8) & mask, right = (left + 1) & mask;
    const int top = (fixed_y >> 8) & mask, bottom = (top + 1) & mask;
    const Texel* const upper = texels.data() + static_cast<std::ptrdiff_t>(top) * size;
    const Texel* const under = texels.data() + static_cast<std::ptrdiff_t>(bottom) * size;
    const Texel both = (fx * fy + 128) >> 8;
    const Texel sum = upper[left] * (256 - fx - fy + both) + upper[right] * (fx - both) + under[left] * (fy - both) +
                      under[right] * both;
    constexpr float kUnit = 1.0f / 256.0f;
    return {kUnit * static_cast<float>(static_cast<int>(sum & 0xffff)),
            kUnit * static_cast<float>(static_cast<int>((sum >> 16) & 0xffff)),
            kUnit * static_cast<float>(static_cast<int>((sum >> 32) & 0xffff))};
  }
};

/// A texture at one footprint: between two levels of its pyramid. Valid as long as the texture.
class TextureSampler {
 public:
  /// @param levels  of the pyramid, the finest first   @param level  log2 of the footprint, texels
  TextureSampler(const std::vector<TextureLevel>& levels, float texels_per_metre, float level) noexcept
      : texels_per_metre_(texels_per_metre) {
    const float last = static_cast<float>(levels.size() - 1);
    const float wanted = level > 0.0f ? (level < last ? level : last) : 0.0f;
    const int lower = static_cast<int>(wanted);
    fine_ = levels.data() + lower;
    fine_scale_ = 256.0f / static_cast<float>(1 << lower);
    coarse_scale_ = 256.0f / static_cast<float>(2 << lower);
    share_ = wanted - static_cast<float>(lower);
  }

  /// Colour at a place on the surface, metres. Linear in the position and between levels: without a jump when the
  /// surface moves by a part of a pixel.
  Bgr operator()(float x_m, float y_m) const noexcept {
    const float x = x_m * texels_per_metre_, y = y_m * texels_per_metre_;
    const Bgr fine = fine_->bilinear(x * fine_scale_, y * fine_scale_);
    if (share_ <= 0.0f) return fine;
    const Bgr coarse = fine_[1].bilinear(x * coarse_scale_, y * coarse_scale_);
    return {fine.blue + share_ * (coarse.blue - fine.blue), fine.green + share_ * (coarse.green - fine.green),
            fine.red + share_ * (coarse.red - fine.red)};
  }

 private:
  float texels_per_metre_;
  const TextureLevel* fine_;
  float fine_scale_, coarse_scale_;  // 1/256 of a texel of each level per texel of the finest
  float share_;                      // of the coarser level
};

/// A painted tile of size × size texels.
class Texture {
 public:
  /// @param size_px a power of two   @throws Error otherwise.   Cost O(size² · number of mark sizes).
  Texture(int size_px, double texels_per_metre, const TextureStyle& style, std::uint64_t seed)
      : texels_per_metre_(static_cast<float>(texels_per_metre)) {
    if (size_px < 2 || (size_px & (size_px - 1)) != 0)
      throw Error("texture: size_px is " + std::to_string(size_px) + ", expected a power of two");
    if (!(texels_per_metre > 0))
      throw Error("texture: texels_per_metre is " + std::to_string(texels_per_metre) + ", expected more than 0");
    if (style.colours.empty()) throw Error("texture: no colour in the style, expected at least one");
    levels_.push_back({size_px, std::vector<Texel>(place(size_px, size_px, 0))});
    Random random(seed);
    paint_ground(style, random);
    for (double mark_m = style.largest_mark_m; mark_m >= style.smallest_mark_m; mark_m *= 0.5)
      scatter_marks(style, mark_m * texels_per_metre, random);
    while (levels_.back().size > 1) levels_.push_back(halved(levels_.back()));
  }

  float texels_per_metre() const noexcept { return texels_per_metre_; }

  /// To look it up, averaged over a footprint of 2^`level` texels.
  TextureSampler sampler(float level) const noexcept { return {levels_, texels_per_metre_, level}; }

 private:
  using Level = TextureLevel;
  using Texel = TextureLevel::Texel;

  /// Index of an element of a row-major square.
  static std::size_t place(int size, int row, int column) noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
  }

  static Texel packed(const Bgr& colour) noexcept {
    const auto byte = [](float value) { return static_cast<Texel>(std::min(255.0f, std::max(0.0f, value))); };
    return byte(colour.blue) | byte(colour.green) << 16 | byte(colour.red) << 32;
  }

  static Level halved(const Level& fine) {
    Level coarse{fine.size / 2, std::vector<Texel>(place(fine.size / 2, fine.size / 2, 0))};
    for (int y = 0; y < coarse.size; ++y) {
      const Texel* const row = fine.texels.data() + static_cast<std::ptrdiff_t>(2 * y) * fine.size;
      Texel* const mean = coarse.texels.data() + static_cast<std::ptrdiff_t>(y) * coarse.size;
      for (int x = 0; x < coarse.size; ++x) {
        const Texel sum = row[2 * x] + row[2 * x + 1] + row[fine.size + 2 * x] + row[fine.size + 2 * x + 1];
        mean[x] = ((sum + 0x0002'0002'0002u) >> 2) & 0x00ff'00ff'00ffu;
      }
    }
    return coarse;
  }

  static Bgr brighter(const Bgr& colour, double gain) noexcept {
    const float factor = static_cast<float>(gain);
    return {colour.blue * factor, colour.green * factor, colour.red * factor};
  }

  void paint_ground(const TextureStyle& style, Random& random) {
    const int size = levels_[0].size;
    const int cells =
        std::max(1, static_cast<int>(std::lround(size / (style.cell_m * static_cast<double>(texels_per_metre_)))));
    std::vector<double> gains(place(cells, cells, 0));
    for (double& gain : gains) gain = random.uniform(0.8, 1.15);
    int log_size = 0;
    while (1 << log_size < size) ++log_size;
    for (int y = 0; y < size; ++y) {
      const int row = y * cells >> log_size, into_row = y * cells & (size - 1);
      for (int x = 0; x < size; ++x) {
        const int column = x * cells >> log_size, into_column = x * cells & (size - 1);
        double gain = 1.0;
        switch (style.ground) {
          case Ground::plain: break;
          case Ground::planks: gain = into_row < 2 * cells ? 0.5 : gains[static_cast<std::size_t>(row)]; break;
          case Ground::tiles:
            gain = into_row < 3 * cells || into_column < 3 * cells ? 0.6 : gains[place(cells, row, column)];
            break;
          case Ground::stripes: gain = (column & 1) != 0 ? 0.75 : 1.0; break;
          case Ground::blocks: gain = gains[place(cells, row, column)]; break;
        }
        gain *= random.uniform(0.97, 1.03);  // the grain of the material
        levels_[0].texels[place(size, y, x)] = packed(brighter(style.colours[0], gain));
      }
    }
  }

  /// Turned rectangles, discs, frames and 2x2 checks in the style's colours, wrapped around the tile's border.
  void scatter_marks(const TextureStyle& style, double mark_px, Random& random) {
    const int size = levels_[0].size;
    mark_px = std::min(mark_px, size / 3.0);
    if (!(mark_px >= 2.0)) return;
    const int count = static_cast<int>(style.coverage * size * size / (mark_px * mark_px));
    for (int i = 0; i < count; ++i) {
      const double half_x = 0.5 * mark_px * random.uniform(0.5, 1.1), half_y = 0.5 * mark_px * random.uniform(0.5, 1.1);
      const double angle = random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 3.141592653589793);
      const auto cosine = static_cast<float>(std::cos(angle)), sine = static_cast<float>(std::sin(angle));
      // One after the other: arguments are evaluated in the compiler's own order.
      const double gain = random.uniform(0.75, 1.2);
      const Bgr colour = brighter(style.colours[random.index(style.colours.size())], gain);
      const Texel value = packed(colour), inner = packed(brighter(colour, 0.6));
      const std::size_t kind = random.index(4);
      const int centre_x = static_cast<int>(random.index(static_cast<std::size_t>(size)));
      const int centre_y = static_cast<int>(random.index(static_cast<std::size_t>(size)));
      const int reach = static_cast<int>(std::ceil(std::hypot(half_x, half_y)));
      const auto unit_x = static_cast<float>(1.0 / half_x), unit_y = static_cast<float>(1.0 / half_y);
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
          const float a = (cosine * static_cast<float>(dx) + sine * static_cast<float>(dy)) * unit_x;
          const float b = (cosine * static_cast<float>(dy) - sine * static_cast<float>(dx)) * unit_y;
          const float far = std::max(std::abs(a), std::abs(b));
          if (kind == 1 ? a * a + b * b > 1.0f : far > 1.0f) continue;
          const bool dark = (kind == 2 && far < 0.55f) || (kind == 3 && (a < 0.0f) == (b < 0.0f));
          const int x = (centre_x + dx) & (size - 1), y = (centre_y + dy) & (size - 1);
          levels_[0].texels[place(size, y, x)] = dark ? inner : value;
        }
    }
  }

  float texels_per_metre_;
  std::vector<Level> levels_;
};

using TexturePtr = std::shared_ptr<const Texture>;

}  // namespace stillpoint::synthetic
