// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// K-means in three dimensions (the paper, Eq. 11 and 12): k-means++ start, Lloyd's iteration.
//
// Coordinates are kept as separate float arrays and the inner loop runs over points, so that compilers vectorise it.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Points as separate coordinates, padded with zeros to a multiple of kLane.
struct PointArrays {
  static constexpr std::size_t kLane = 16;
  span<float> x, y, z;   ///< padded size
  std::size_t size = 0;  ///< without the padding

  PointArrays(std::size_t count, Workspace& workspace) : size(count) {
    const std::size_t padded = (count + kLane - 1) / kLane * kLane;
    x = workspace.take<float>(padded);
    y = workspace.take<float>(padded);
    z = workspace.take<float>(padded);
  }

  void set(std::size_t i, const Vector3d& point) noexcept {
    x[i] = static_cast<float>(point.x());
    y[i] = static_cast<float>(point.y());
    z[i] = static_cast<float>(point.z());
  }
  Eigen::Vector3f operator[](std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
};

/// What K-means found. The spans live in the workspace that was handed in.
struct KMeansResult {
  span<std::int32_t> cluster;      ///< of each point, 0 to k − 1
  span<Eigen::Vector3f> centre;    ///< k of them
  span<std::size_t> member_count;  ///< of each cluster, at least 1
  double cost = 0;                 ///< J (Eq. 11): sum of squared distances to the own centre
  int iterations = 0;
};

namespace detail {

/// For every point: its squared distance to the nearest of the first centres, and which that is. The nearer of two
/// equal ones is the first.
class NearestCentre {
 public:
  NearestCentre(const PointArrays& points, Workspace& workspace)
      : points_(points),
        squared_(workspace.take<float>(points.x.size())),
        index_(workspace.take<std::int32_t>(points.x.size())) {
    clear();
  }

  void clear() noexcept { std::fill(squared_.begin(), squared_.end(), std::numeric_limits<float>::infinity()); }

  /// Offers centres in their order, with the indices from `first_index` on. A lane of points stays near the arithmetic
  /// while all centres pass by; its local arrays can't overlap, as the compiler would have to fear of spans.
  void offer(span<const Eigen::Vector3f> centres, std::int32_t first_index) noexcept {
    constexpr std::size_t kLane = PointArrays::kLane;
    for (std::size_t begin = 0; begin < points_.x.size(); begin += kLane) {
      float x[kLane], y[kLane], z[kLane], best[kLane];
      std::int32_t best_index[kLane];
      std::copy_n(points_.x.data() + begin, kLane, x);
      std::copy_n(points_.y.data() + begin, kLane, y);
      std::copy_n(points_.z.data() + begin, kLane, z);
      std::copy_n(squared_.data() + begin, kLane, best);
      std::copy_n(index_.data() + begin, kLane, best_index);
      std::int32_t index = first_index;
      for (const Eigen::Vector3f& centre : centres) {
        const float cx = centre.x(), cy = centre.y(), cz = centre.z();
        for (std::size_t i = 0; i < kLane; ++i) {
          const float dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
          const float squared = dx * dx + dy * dy + dz * dz;
          const std::int32_t nearer = -static_cast<std::int32_t>(squared < best[i]);  // all bits: no branch for g++
          best_index[i] = (nearer & index) | (~nearer & best_index[i]);
          best[i] = std::min(best[i], squared);
        }
        ++index;
      }
      std::copy_n(best, kLane, squared_.data() + begin);
      std::copy_n(best_index, kLane, index_.data() + begin);
    }
  }

  float squared(std::size_t i) const noexcept { return squared_[i]; }
  std::int32_t index(std::size_t i) const noexcept { return index_[i]; }

 private:
  const PointArrays& points_;
  span<float> squared_;
  span<std::int32_t> index_;
};

/// Draws points with a probability proportional to their squared distance. Sums are of blocks first: the sum over all
/// points in a row would wait for each addition.
class SquaredDistanceDraw {
 public:
  SquaredDistanceDraw(const NearestCentre& nearest, std::size_t points, Workspace& workspace)
      : nearest_(nearest), points_(points), block_sum_(workspace.take<double>((points + kBlock - 1) / kBlock)) {}

  /// @return the point; `points` where all distances are 0
  std::size_t operator()(Random& random) {
    double total = 0;
    for (std::size_t b = 0; b < block_sum_.size(); ++b) {
      double even = 0, odd = 0;
      std::size_t i = b * kBlock;
      for (; i + 1 < end_of(b); i += 2) {
        even += squared(i);
        odd += squared(i + 1);
      }
      if (i < end_of(b)) even += squared(i);
      total += block_sum_[b] = even + odd;
    }
    if (!(total > 0)) return points_;
    double left = random.uniform() * total;
    std::size_t block = 0;
    while (block + 1 < block_sum_.size() && left >= block_sum_[block]) left -= block_sum_[block++];
    std::size_t chosen = points_;
    for (std::size_t i = block * kBlock; i < points_ && !(chosen < points_ && left < 0); ++i) {
      if (squared(i) > 0) chosen = i;
      left -= squared(i);
    }
    // Rounding may leave a little where nothing follows: then it is the last that has a distance at all.
    for (std::size_t i = points_; chosen == points_ && i-- > 0;)
      if (squared(i) > 0) chosen = i;
    return chosen;
  }

 private:
  static constexpr std::size_t kBlock = 16;

  std::size_t end_of(std::size_t block) const noexcept { return std::min((block + 1) * kBlock, points_); }
  double squared(std::size_t i) const noexcept { return static_cast<double>(nearest_.squared(i)); }

  const NearestCentre& nearest_;
  std::size_t points_;
  span<double> block_sum_;
};

/// Each cluster without a member takes the point that is farthest from its own centre, of clusters that keep another.
/// @param sum  of the members' coordinates, per cluster
/// @return     was there any?
inline bool refill_empty_clusters(const PointArrays& points, const NearestCentre& nearest, KMeansResult& result,
                                  span<Vector3d> sum) {
  bool any = false;
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (result.member_count[c] > 0) continue;
    std::size_t farthest = points.size;
    for (std::size_t i = 0; i < points.size; ++i)
      if (result.member_count[static_cast<std::size_t>(result.cluster[i])] > 1 &&
          (farthest == points.size || nearest.squared(i) > nearest.squared(farthest)))
        farthest = i;
    const auto old = static_cast<std::size_t>(result.cluster[farthest]);
    sum[old] -= to_double(points[farthest]);
    --result.member_count[old];
    sum[c] = to_double(points[farthest]);
    result.member_count[c] = 1;
    result.cluster[farthest] = static_cast<std::int32_t>(c);
    any = true;
  }
  return any;
}

}  // namespace detail

/// k-means++: each further centre is a point drawn with probability proportional to its squared distance to the centres
/// so far. Source: Arthur and Vassilvitskii, "k-means++: The Advantages of Careful Seeding", SODA 2007.
/// @param k at least 1 and at most points.size. O(n k).
inline span<Eigen::Vector3f> k_means_plus_plus(const PointArrays& points, std::size_t k, Random& random,
                                               Workspace& workspace) {
  const span<Eigen::Vector3f> centres = workspace.take<Eigen::Vector3f>(k, Eigen::Vector3f::Zero());
  const Workspace::Scope scope(workspace);
  detail::NearestCentre nearest(points, workspace);
  detail::SquaredDistanceDraw draw(nearest, points.size, workspace);
  std::size_t chosen = random.index(points.size);
  for (std::size_t c = 0; c < k; ++c) {
    centres[c] = points[chosen];
    nearest.offer(centres.subspan(c, 1), static_cast<std::int32_t>(c));
    chosen = draw(random);
    if (chosen == points.size) chosen = random.index(points.size);  // fewer different points than centres
  }
  return centres;
}

/// Lloyd's iteration from given centres until no assignment changes any more, or for `max_iterations` (at least one).
/// A cluster that runs empty takes the point that is farthest from its own centre. O(n k) per iteration.
/// @param centres k of them, at most points.size; moved to their final places
inline KMeansResult lloyd(const PointArrays& points, span<Eigen::Vector3f> centres, int max_iterations,
                          Workspace& workspace) {
  const std::size_t k = centres.size();
  KMeansResult result;
  result.centre = centres;
  result.cluster = workspace.take<std::int32_t>(points.size, -1);
  result.member_count = workspace.take<std::size_t>(k);
  const Workspace::Scope scope(workspace);
  const span<Vector3d> sum = workspace.take<Vector3d>(k, Vector3d::Zero());
  detail::NearestCentre nearest(points, workspace);

  bool improves = true;
  while (improves && (result.iterations == 0 || result.iterations < max_iterations)) {
    ++result.iterations;
    bool changed = false;
    double left = 0;  // what moving the centres may still gain
    nearest.clear();
    nearest.offer(centres, 0);
    std::fill(sum.begin(), sum.end(), Vector3d::Zero());
    std::fill(result.member_count.begin(), result.member_count.end(), std::size_t{0});
    for (std::size_t i = 0; i < points.size; ++i) {
      changed = changed || nearest.index(i) != result.cluster[i];
      result.cluster[i] = nearest.index(i);
      const auto c = static_cast<std::size_t>(nearest.index(i));
      sum[c] += to_double(points[i]);
      ++result.member_count[c];
      left += static_cast<double>(nearest.squared(i));
    }
    if (detail::refill_empty_clusters(points, nearest, result, sum)) changed = true;
    for (std::size_t c = 0; c < k; ++c) centres[c] = to_float(sum[c] / static_cast<double>(result.member_count[c]));
    improves = changed && left > 0;  // with fewer different points than centres, empty clusters change for ever
  }
  for (std::size_t i = 0; i < points.size; ++i)
    result.cost +=
        static_cast<double>((points[i] - centres[static_cast<std::size_t>(result.cluster[i])]).squaredNorm());
  return result;
}

}  // namespace stillpoint
