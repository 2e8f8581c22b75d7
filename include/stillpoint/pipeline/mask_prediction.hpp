// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where will the coming frame show moving objects?   The last verdicts, carried on: for a host that spends its feature
// budget before it can ask about features.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/mask.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/pipeline/mean_velocity.hpp"

namespace stillpoint {

/// Remembers the features of the last frame that was judged, the matcher's own corners among them (a host that extracts
/// nothing under the mask still has them looked at), and how far each went in the image. A moving feature without a
/// match of its own goes with the moving ones around it. Nothing is predicted where the last frame was not judged.
class MaskPrediction {
 public:
  struct Options {
    int reach_px = 24;  ///< a feature speaks for its surface so far around: a support corner's cell
  };
  Options options;

  /// Takes what a frame said; what follows from it is worked out when somebody asks.
  void remember(const Matches& matches, span<const Label> labels, double timestamp_s) {
    forget();
    timestamp_s_ = timestamp_s;
    elapsed_s_ = matches.elapsed_s;
    reach_px_ = std::max(1, rounded(matches.pixel_scale * static_cast<float>(options.reach_px)));
    pixel_.reserve(matches.size());  // with the first frame, not with the first that moves
    seen_.reserve(matches.size());
    const auto moves = [](const Label& label) { return label.verdict == Verdict::dynamic; };
    if (!(matches.elapsed_s > 0) || std::none_of(labels.begin(), labels.end(), moves)) return;
    pixel_ = matches.current.pixel;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const bool followed = matches.matched(i);
      Vector2f velocity_px_s = Vector2f::Zero();
      if (followed)
        velocity_px_s = (matches.current.pixel[i] - matches.reference.pixel[i]) / static_cast<float>(matches.elapsed_s);
      seen_.push_back({velocity_px_s, static_cast<float>(matches.current.depth_m[i]),
                       static_cast<float>(kSameSurface.at(matches.current.depth_sigma_m[i])), moves(labels[i]),
                       followed});
    }
  }

  /// Objects that are followed carry their features: features of one body move as their object does, by the motion of
  /// all of its features in place of each one's match; those of a limb do so where nothing beside it was followed.
  template <class Camera>
  void follow(const Movers& movers, const Matches& matches, const Camera& camera) {
    if (seen_.empty()) return;
    for (const Mover& mover : movers.list) {
      if (mover.state != MoverState::moving) continue;
      for (std::size_t k = mover.first_pixel; k < mover.first_pixel + mover.pixel_count; ++k) {
        const std::size_t i = movers.match[k];
        Seen& seen = seen_[i];
        if (!matches.current.has_depth(i) || (seen.followed && !mover.has_rotation)) continue;
        const Vector3d next = mover.current_from_reference * matches.current.point[i];
        if (!(next.z() > 0)) continue;
        const Vector2d step = camera.distort(camera.project(next)) - to_double(pixel_[i]);
        seen.velocity_px_s = to_float(step / matches.elapsed_s);
        seen.followed |= mover.has_rotation;
      }
    }
  }

  void forget() noexcept {
    pixel_.clear();
    seen_.clear();
  }

  /// Paints where they will be: for each the part of its surface that is near, without a depth the feature alone.
  /// @param timestamp_s  of the coming frame; one that is not later than the last frame's predicts nothing
  /// @param depth        of the last frame, may be empty
  /// @param margin_px    is dropped around it as well
  /// @param mask         becomes gray8 of this size: 255 keeps, 0 drops
  void paint(double timestamp_s, const DepthView& depth, int width, int height, int margin_px, ImageBuffer& mask,
             Workspace& workspace) {
    keep_everywhere(width, height, mask);
    const double ahead_s = timestamp_s - timestamp_s_;
    if (seen_.empty() || !(ahead_s > 0) || !(ahead_s <= kLongestGap_s)) return;
    columns_ = (width + kCell_px - 1) / kCell_px;
    rows_ = (height + kCell_px - 1) / kCell_px;
    refill(cells_, static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    const ImageView image(nullptr, width, height, 0, PixelFormat::gray8);
    const Workspace::Scope scope(workspace);
    const auto reach_px = static_cast<float>(reach_px_);
    const float step_s = ahead_s < MeanVelocity::kMostStretch * elapsed_s_ ? static_cast<float>(ahead_s) : 0.0f;
    const PixelGrid around(pixel_, reach_px, workspace, [](std::size_t) { return true; });
    const PixelGrid followed(pixel_, 2 * reach_px, workspace,
                             [&](std::size_t j) { return seen_[j].moves && seen_[j].followed; });
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (seen_[i].moves && is_finite(pixel_[i]))
        mark(i, with_surface(i, around), step_s * velocity_px_s(i, followed), depth, image);
    drop_marked(std::clamp(margin_px, 0, width + height), mask);
  }

 private:
  struct Seen {
    Vector2f velocity_px_s;  ///< by its match or its object; else 0
    float depth_m;           ///< 0 where there is none
    float tolerance_m;       ///< by which depths on its surface may differ
    bool moves;
    bool followed;  ///< its own velocity is better than that of those around it
  };
  static constexpr int kCell_px = 4;
  static constexpr double kLongestGap_s = 1.0;  // farther ahead nothing is predicted
  static constexpr DepthTolerance kSameSurface{0.06};

  static bool one_surface(const Seen& seen, float other_m) noexcept {
    return seen.depth_m > 0 && std::abs(other_m - seen.depth_m) <= seen.tolerance_m;
  }

  /// Do most features near `i` on its surface move as well?
  bool with_surface(std::size_t i, const PixelGrid& around) const {
    int moving = 0, all = 0;
    around.within(pixel_[i], static_cast<float>(reach_px_), [&](std::size_t j, float) {
      if (!one_surface(seen_[i], seen_[j].depth_m)) return;
      ++all;
      moving += seen_[j].moves;
    });
    return 2 * moving > all;
  }

  /// How fast feature `i` goes: by itself, else with the moving ones around it, else with its object.
  Vector2f velocity_px_s(std::size_t i, const PixelGrid& followed) const {
    if (seen_[i].followed) return seen_[i].velocity_px_s;
    const auto reach_px = static_cast<float>(2 * reach_px_);
    Vector2f sum = Vector2f::Zero();
    float weight = 0;
    followed.within(pixel_[i], reach_px, [&](std::size_t j, float squared) {
      const float near = 1 - squared / (reach_px * reach_px);
      weight += near;
      sum += near * seen_[j].velocity_px_s;
    });
    if (!(weight > 0)) return seen_[i].velocity_px_s;
    return sum / weight;
  }

  /// Marks the cells in which feature `i` and its surface will be, a step from here.
  void mark(std::size_t i, bool with_surface, const Vector2f& step, const DepthView& depth, const ImageView& image) {
    mark_cell(pixel_[i] + step);
    if (depth.empty() || !with_surface) return;
    const DepthScale to_depth(image, depth.image);
    for (int dv = -reach_px_; dv <= reach_px_; dv += kCell_px) {
      for (int du = -reach_px_; du <= reach_px_; du += kCell_px) {
        if (du * du + dv * dv > reach_px_ * reach_px_) continue;
        const Vector2f pixel = pixel_[i] + Vector2f(static_cast<float>(du), static_cast<float>(dv));
        const auto depth_m = static_cast<float>(RoundedDepth{}.at(depth, to_depth(pixel)));
        if (one_surface(seen_[i], depth_m)) mark_cell(pixel + step);
      }
    }
  }

  void mark_cell(const Vector2f& pixel) {
    const float column = std::floor((pixel.x() + 0.5f) / kCell_px), row = std::floor((pixel.y() + 0.5f) / kCell_px);
    if (column >= 0 && row >= 0 && column < static_cast<float>(columns_) && row < static_cast<float>(rows_))
      cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)] = 1;
  }

  bool marked(int column, int row) const noexcept {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
           cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)] != 0;
  }

  /// A disc around every marked cell; inside of an area the cell's own square is enough.
  void drop_marked(int margin_px, ImageBuffer& mask) const {
    const ImageView view = mask.view();
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (!marked(column, row)) continue;
        const int u0 = column * kCell_px, v0 = row * kCell_px;
        const int u1 = std::min(u0 + kCell_px, view.width), v1 = std::min(v0 + kCell_px, view.height);
        for (int v = v0; v < v1; ++v)
          std::fill(mask.row<std::uint8_t>(v) + u0, mask.row<std::uint8_t>(v) + u1, kMaskDrops);
        const bool inside =
            marked(column - 1, row) && marked(column + 1, row) && marked(column, row - 1) && marked(column, row + 1);
        constexpr float kHalf = 0.5f * (kCell_px - 1);
        if (!inside)
          drop_disc({static_cast<float>(u0) + kHalf, static_cast<float>(v0) + kHalf}, margin_px + kCell_px / 2, mask);
      }
    }
  }

  // Of the last frame that was judged; empty where nothing moves.
  std::vector<Vector2f> pixel_;
  std::vector<Seen> seen_;
  std::vector<std::uint8_t> cells_;
  int columns_ = 0, rows_ = 0;
  int reach_px_ = 0;  // of the options, in pixels of this camera
  double timestamp_s_ = std::numeric_limits<double>::quiet_NaN();
  double elapsed_s_ = 0.0;  // before it
};

template <class Visit>
void each_option(MaskPrediction& stage, Visit& visit) {
  visit("reach_px", stage.options.reach_px, OptionRange{1, 200});
}

}  // namespace stillpoint
