// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which dynamic features belong to one object?   Motions are peeled off one by one: K-means gives pieces of surface
// (the paper, Eq. 11 and 12), each piece proposes its motion, the one that explains most takes its connected pieces.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stillpoint/cluster/k_means.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/movers/moving_features.hpp"
#include "stillpoint/movers/object_motion.hpp"

namespace stillpoint {

/// Dynamic features as points: parallel arrays, in the workspace.
struct DynamicPoints {
  span<std::uint32_t> feature;  ///< index into `Matches`
  span<WhitenedPair> pair;      ///< `current` always; the rest where `has_step`
  span<std::uint8_t> has_step;  ///< it was found in the reference frame, with a depth there
  std::size_t size = 0;

  DynamicPoints() = default;
  DynamicPoints(std::size_t most, Workspace& workspace)
      : feature(workspace.take<std::uint32_t>(most)),
        pair(workspace.take<WhitenedPair>(most)),
        has_step(workspace.take<std::uint8_t>(most)) {}

  template <class Camera>
  void add(std::size_t i, const MovingFeatures<Camera>& features) {
    feature[size] = static_cast<std::uint32_t>(i);
    has_step[size] = features.matches.metric(i);
    if (has_step[size] != 0)
      pair[size] = features.pair(i);
    else
      pair[size].current = features.matches.current.point[i];
    ++size;
  }

  /// Leaves `most` of them, evenly.
  void thin_out(std::size_t most) {
    if (size <= most) return;
    for (std::size_t k = 0; k < most; ++k) {
      const std::size_t from = k * size / most;
      feature[k] = feature[from];
      pair[k] = pair[from];
      has_step[k] = has_step[from];
    }
    size = most;
  }

  const Vector3d& point(std::size_t k) const noexcept { return pair[k].current; }
  Vector3d step(std::size_t k) const { return pair[k].current - pair[k].reference; }
};

/// Peels groups of one motion off a set of points.
class MotionGroups {
 public:
  static constexpr std::int32_t kNone = -1;
  static constexpr double kReach_m = 0.18;    // between neighbouring features of one object
  static constexpr double kSlack_m_s = 0.25;  // limbs and turns differ so much from their object's translation

  span<std::int32_t> of_point;  ///< group of each point, 0 to `count` - 1, or `kNone`
  std::size_t count = 0;

  /// @param elapsed_s  between the two frames
  MotionGroups(const DynamicPoints& points, double elapsed_s, Workspace& workspace)
      : of_point(workspace.take<std::int32_t>(points.size, kNone)), points_(points), slack_m_(kSlack_m_s * elapsed_s) {
    if (points.size == 0) return;
    const Workspace::Scope scope(workspace);
    make_pieces(workspace);
    find_neighbours(workspace);
    while (peel(workspace)) ++count;
    join_limbs(workspace);
  }

 private:
  static constexpr std::size_t kPointsPerPiece = 10, kFewestSteps = 3;
  static constexpr int kIterations = 3;
  static constexpr double kFewestSupport = 3.0;
  static constexpr double kLimb = 0.5;  // share of its neighbour's points below which a group is a part of it

  void make_pieces(Workspace& workspace) {
    PointArrays arrays(points_.size, workspace);
    for (std::size_t k = 0; k < points_.size; ++k) arrays.set(k, points_.point(k));
    const std::size_t wanted = std::max<std::size_t>(1, points_.size / kPointsPerPiece);
    Random random;
    const KMeansResult clusters =
        lloyd(arrays, k_means_plus_plus(arrays, wanted, random, workspace), kIterations, workspace);
    begin_ = workspace.take<std::size_t>(points_.size + 1);
    member_ = workspace.take<std::uint32_t>(points_.size);
    centre_ = workspace.take<Eigen::Vector3f>(points_.size, Eigen::Vector3f::Zero());
    radius_ = workspace.take<float>(points_.size);
    std::size_t end = 0;
    for (std::size_t c = 0; c < wanted; ++c) {
      const std::size_t first = end;
      for (std::size_t k = 0; k < points_.size; ++k)
        if (clusters.cluster[k] == static_cast<std::int32_t>(c)) member_[end++] = static_cast<std::uint32_t>(k);
      split(first, end, arrays);
    }
    group_ = workspace.take<std::int32_t>(pieces_, kNone);
  }

  /// A cluster of what is strewn is no surface: only what hangs together is one piece.
  void split(std::size_t first, std::size_t end, const PointArrays& arrays) {
    while (first < end) {
      std::size_t last = first + 1;
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t j = last; j < end; ++j)
          if (near(member_[i], member_[j])) std::swap(member_[last++], member_[j]);
      Eigen::Vector3f& centre = centre_[pieces_];
      for (std::size_t i = first; i < last; ++i) centre += arrays[member_[i]] / static_cast<float>(last - first);
      for (std::size_t i = first; i < last; ++i)
        radius_[pieces_] = std::max(radius_[pieces_], (arrays[member_[i]] - centre).norm());
      begin_[++pieces_] = last;
      first = last;
    }
  }

  span<const std::uint32_t> members(std::size_t piece) const {
    return {member_.data() + begin_[piece], begin_[piece + 1] - begin_[piece]};
  }

  bool adjacent(std::size_t a, std::size_t b) const {
    const auto reach_m = static_cast<float>(kReach_m);
    if ((centre_[a] - centre_[b]).norm() > radius_[a] + radius_[b] + reach_m) return false;
    for (const std::uint32_t i : members(a))
      for (const std::uint32_t j : members(b))
        if (near(i, j)) return true;
    return false;
  }

  /// Which pieces each one is adjacent to, in their order: growing asks again and again. O(pieces²), two passes: the
  /// first counts what the second fills.
  void find_neighbours(Workspace& workspace) {
    const auto each_pair = [this](const auto& visit) {
      for (std::size_t a = 0; a < pieces_; ++a)
        for (std::size_t b = a + 1; b < pieces_; ++b)
          if (adjacent(a, b)) visit(a, b);
    };
    first_neighbour_ = workspace.take<std::size_t>(pieces_ + 1, 0);
    each_pair([this](std::size_t a, std::size_t b) { ++first_neighbour_[a + 1], ++first_neighbour_[b + 1]; });
    for (std::size_t piece = 0; piece < pieces_; ++piece) first_neighbour_[piece + 1] += first_neighbour_[piece];
    neighbour_ = workspace.take<std::uint32_t>(first_neighbour_[pieces_]);
    const span<std::size_t> end = workspace.take<std::size_t>(pieces_);
    std::copy_n(first_neighbour_.begin(), pieces_, end.begin());
    each_pair([&](std::size_t a, std::size_t b) {
      neighbour_[end[a]++] = static_cast<std::uint32_t>(b);
      neighbour_[end[b]++] = static_cast<std::uint32_t>(a);
    });
  }

  span<const std::uint32_t> neighbours(std::size_t piece) const {
    return {neighbour_.data() + first_neighbour_[piece], first_neighbour_[piece + 1] - first_neighbour_[piece]};
  }

  bool near(std::uint32_t i, std::uint32_t j) const {
    return (points_.point(i) - points_.point(j)).squaredNorm() <= kReach_m * kReach_m;
  }

  /// 1 for a step that is `translation` exactly, 0 for one that is not.
  float support(std::size_t k, const Vector3d& translation) const {
    Pose moved = Pose::Identity();
    moved.translation() = translation;
    const double whitened = squared_distance(points_.pair[k], moved) / ObjectMotionEstimator::kInlier_sq;
    const double slack = (points_.step(k) - translation).squaredNorm() / (slack_m_ * slack_m_);
    return static_cast<float>(std::max(0.0, 1.0 - std::min(whitened, slack)));
  }

  struct Vote {
    float support = 0;
    std::size_t steps = 0;
  };
  Vote vote(std::size_t piece, const Vector3d& translation) const {
    Vote result;
    for (const std::uint32_t k : members(piece)) {
      if (points_.has_step[k] == 0) continue;
      ++result.steps;
      result.support += support(k, translation);
    }
    return result;
  }

  bool median_step(span<const std::uint8_t> chosen, Workspace& workspace, Vector3d& step) const {
    const Workspace::Scope scope(workspace);
    const span<double> values = workspace.take<double>(points_.size);
    for (int axis = 0; axis < 3; ++axis) {
      std::size_t steps = 0;
      for (std::size_t piece = 0; piece < pieces_; ++piece)
        if (chosen[piece] != 0)
          for (const std::uint32_t k : members(piece))
            if (points_.has_step[k] != 0) values[steps++] = points_.step(k)(axis);
      if (steps < kFewestSteps) return false;
      step(axis) = median_in_place(values.first(steps));
    }
    return true;
  }

  /// Pieces that hang together with `seed` and mostly move by `translation`; what has no step goes with its neighbour.
  float grow(std::size_t seed, const Vector3d& translation, span<std::uint8_t> chosen,
             span<std::uint32_t> queue) const {
    std::fill(chosen.begin(), chosen.end(), std::uint8_t{0});
    float total = vote(seed, translation).support;
    std::size_t head = 0, tail = 0;
    queue[tail++] = static_cast<std::uint32_t>(seed);
    chosen[seed] = 1;
    while (head < tail) {
      const std::size_t from = queue[head++];
      for (const std::uint32_t other : neighbours(from)) {
        if (chosen[other] != 0 || group_[other] != kNone) continue;
        const Vote votes = vote(other, translation);
        if (votes.steps > 0 && 2 * votes.support < static_cast<float>(votes.steps)) continue;
        chosen[other] = 1;
        queue[tail++] = other;
        total += votes.support;
      }
    }
    return total;
  }

  bool peel(Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const span<std::uint8_t> chosen = workspace.take<std::uint8_t>(pieces_),
                             best = workspace.take<std::uint8_t>(pieces_);
    const span<std::uint32_t> queue = workspace.take<std::uint32_t>(pieces_);
    float most = static_cast<float>(kFewestSupport);
    bool found = false;
    for (std::size_t seed = 0; seed < pieces_; ++seed) {
      if (group_[seed] != kNone) continue;
      std::fill(chosen.begin(), chosen.end(), std::uint8_t{0});
      chosen[seed] = 1;
      Vector3d step;
      if (!median_step(chosen, workspace, step)) continue;
      float total = grow(seed, step, chosen, queue);
      if (median_step(chosen, workspace, step)) total = grow(seed, step, chosen, queue);
      if (!(total > most)) continue;
      most = total;
      found = true;
      std::copy(chosen.begin(), chosen.end(), best.begin());
    }
    if (!found) return false;
    for (std::size_t piece = 0; piece < pieces_; ++piece) {
      if (best[piece] == 0) continue;
      group_[piece] = static_cast<std::int32_t>(count);
      for (const std::uint32_t k : members(piece)) of_point[k] = group_[piece];
    }
    return true;
  }

  /// What hangs on a larger group and has less than half of its points is a limb of it, as are pieces of no group.
  void join_limbs(Workspace& workspace) {
    if (count == 0) return;
    const span<std::size_t> size = workspace.take<std::size_t>(count);
    for (std::size_t piece = 0; piece < pieces_; ++piece)
      if (group_[piece] != kNone) size[static_cast<std::size_t>(group_[piece])] += members(piece).size();
    const span<std::int32_t> into = workspace.take<std::int32_t>(count + pieces_, kNone);
    for (std::size_t a = 0; a < pieces_; ++a) {
      for (const std::uint32_t b : neighbours(a)) {
        if (group_[b] == kNone || group_[a] == group_[b]) continue;
        const auto to = static_cast<std::size_t>(group_[b]);
        const std::size_t own = group_[a] == kNone ? members(a).size() : size[static_cast<std::size_t>(group_[a])];
        if (!(static_cast<double>(own) < kLimb * static_cast<double>(size[to]))) continue;
        std::int32_t& target = into[group_[a] == kNone ? count + a : static_cast<std::size_t>(group_[a])];
        if (target == kNone || size[to] > size[static_cast<std::size_t>(target)]) target = group_[b];
      }
    }
    for (std::size_t piece = 0; piece < pieces_; ++piece) {
      std::int32_t group = group_[piece];
      if (group == kNone) group = into[count + piece];
      while (group != kNone && into[static_cast<std::size_t>(group)] != kNone)  // towards ever larger groups
        group = into[static_cast<std::size_t>(group)];
      for (const std::uint32_t k : members(piece)) of_point[k] = group;
    }
  }

  const DynamicPoints& points_;
  double slack_m_;
  std::size_t pieces_ = 0;
  span<std::size_t> begin_;
  span<std::uint32_t> member_;
  span<Eigen::Vector3f> centre_;
  span<float> radius_;
  span<std::int32_t> group_;
  span<std::size_t> first_neighbour_;
  span<std::uint32_t> neighbour_;
};

}  // namespace stillpoint
