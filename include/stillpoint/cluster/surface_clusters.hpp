// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features move together?   Neighbours on one surface share their evidence; features without evidence take it
// from them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "stillpoint/cluster/depthless_features.hpp"
#include "stillpoint/cluster/k_means.hpp"
#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// Gives every feature the log-odds of this frame, evidence minus threshold. All features are clustered, inside and
/// outside of regions, by K-means in coordinates in which noise is round; a cluster with two populations is split.
class SurfaceClusters {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::log_likelihoods, capability::tail_threshold>;
  using Provides = Capabilities<capability::log_odds>;

  struct Options {
    std::size_t features_per_cluster = 30;
    float own_share = 0.5f;      ///< of a feature's own score in its log-odds; the rest is its cluster's mean
    float dynamic_shift = 2.0f;  ///< what a dynamic region adds to the log-odds, nats
  };
  Options options;

  // No option in files.
  std::size_t fewest_clusters = 2;
  float split_variance = 9.0f;       ///< a cluster whose scores vary less is one population, squared nats
  double depth_extent_m = 0.04;      ///< what one unit of the clusters' depth coordinate is: a rough surface …
  double depth_extent_sigmas = 3.0;  ///< … and so many standard deviations of the depth there

  static constexpr float kLowest = -2.0f, kHighest = 10.0f;  ///< a single score is held between these, nats
  static constexpr float kAlone = -1.0f;  ///< log-odds of a feature that knows nothing and has no neighbours, nats

  void classify(const Observations& observations, const Evidence& evidence, span<Label> labels,
                Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const Regions& regions = observations.regions;
    const span<const FeatureScore> scores = evidence.scores;
    const Workspace::Scope scope(workspace);
    const span<float> common = workspace.take<float>(matches.size(), kNone);
    share_in_clusters(matches, scores, regions, labels, common, workspace);
    const auto level = static_cast<float>(evidence.threshold.level);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (std::isnan(common[i])) continue;
      common[i] -= level;
      if (matches.current.has_depth(i)) label_by_cluster(scores[i], common[i], level, labels[i]);
    }
    label_depthless(matches, scores, common, level, labels, workspace);
    const bool any_dynamic = std::any_of(regions.detections.begin(), regions.detections.end(),
                                         [](const Detection& found) { return found.mobility == Mobility::dynamic; });
    for (std::size_t i = 0; i < matches.size(); ++i)
      labels[i].log_odds += shift(regions.of_feature[i], any_dynamic, matches.current.has_depth(i));
  }

 private:
  static constexpr float kMostShared = 4.0f;        // nats of a cluster's mean: who clearly stands is not outvoted
  static constexpr std::size_t kFewestMembers = 3;  // of each part of a split
  static constexpr int kMaxIterations = 3;          // of K-means: a fourth and a fifth changed nothing
  static constexpr double kExtent_px = 40.0;        // what one unit of the clusters' lateral coordinates is
  static constexpr float kSplitExplained = 0.8f;    // share of the variance that two populations must explain
  static constexpr float kNeighbour_px = 25.0f;     // how far a feature without a depth looks for others
  static constexpr float kNeighbourShare = 0.7f;    // of their evidence it takes over where it has none …
  // … and what its own and theirs count where it was compared at a supposed depth: rounded coefficients of a logistic
  // regression over such features of Bonn's crowd and of the kitchen with holes.
  static constexpr float kDepthlessOwn = 0.4f, kDepthlessNeighbours = 0.4f;
  static constexpr float kOutsideShift = -0.6f;  // nats; in no region when a detector has found something dynamic
  static constexpr float kMovableShift = 0.2f;   // nats
  static constexpr float kFixedShift = -0.3f;    // nats
  static constexpr std::uint64_t kSeed = Random::kDefaultSeed;
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

  /// What the prior adds. In a box, what has no depth may lie before or behind the object.
  float shift(const Membership& region, bool any_dynamic, bool has_depth) const noexcept {
    const bool in_any = region.in_dynamic || region.in_movable || region.in_fixed;
    if (in_any && !has_depth) return 0.0f;
    return region.in_dynamic   ? options.dynamic_shift
           : region.in_movable ? kMovableShift
           : region.in_fixed   ? kFixedShift
           : any_dynamic       ? kOutsideShift
                               : 0.0f;
  }

  float clamped(const FeatureScore& score) const noexcept { return std::clamp(score.value, kLowest, kHighest); }

  /// The feature's own evidence and its cluster's.
  /// @param common  score of its cluster above the threshold, nats
  void label_by_cluster(const FeatureScore& score, float common, float level, Label& label) const noexcept {
    const float own = score.scored() ? clamped(score) - level : common;
    label.log_odds = options.own_share * own + (1 - options.own_share) * std::min(common, kMostShared - level);
    label.reason = score.scored() ? Reason::consistent : Reason::neighbours;
  }

  /// A feature without depth is judged by its cluster where older frames confirm its surface, else by its own score and
  /// by the features around it. How often depth is missing on dynamic features shifts the odds. Features that were not
  /// compared are not shifted: the matcher's corners are such, and on a mover their dynamic prior must rise.
  void label_depthless(const Matches& matches, span<const FeatureScore> scores, span<const float> common, float level,
                       span<Label> labels, Workspace& workspace) const {
    const auto has_depth = [&](std::size_t i) { return matches.current.has_depth(i); };
    const float reach_px = matches.pixel_scale * kNeighbour_px;
    const PixelGrid grid(matches.current.pixel, 0.5f * reach_px, workspace,
                         [&](std::size_t i) { return has_depth(i) && !std::isnan(common[i]); });
    const span<Surroundings> around = workspace.take<Surroundings>(matches.size());
    DepthlessPrior prior;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (has_depth(i)) {
        if (!std::isnan(common[i])) prior.add_with_depth(labels[i].log_odds > 0);
      } else if (matches.state[i] != MatchState::outside) {
        around[i] = Surroundings::of(matches.current.pixel[i], reach_px, grid, common, labels);
        prior.add_without_depth(around[i]);
      }
    }
    const float missing_depth = prior.log_ratio();
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (has_depth(i) && !std::isnan(common[i])) continue;
      const bool is_known = !std::isnan(common[i]) && !matches.past_observations.is_guess(i);
      const float others = around[i].any ? around[i].evidence : kAlone;
      Label& label = labels[i];
      if (is_known) {
        label_by_cluster(scores[i], common[i], level, label);
        label.log_odds += missing_depth;
      } else if (scores[i].scored()) {
        label.log_odds = kDepthlessOwn * (clamped(scores[i]) - level) + kDepthlessNeighbours * others + missing_depth;
        label.reason = Reason::consistent;
      } else {
        label.log_odds = around[i].any ? kNeighbourShare * others : kAlone;
        label.reason = matches.state[i] == MatchState::outside ? Reason::outside_image : Reason::no_depth;
      }
    }
  }

  /// Of the surface that a feature lies on: measured, borrowed from an older frame, or that of what is beside it; 0
  /// none.
  static double surface_depth_m(const Matches& matches, std::size_t i) noexcept {
    if (matches.current.has_depth(i)) return matches.current.depth_m[i];
    if (i >= matches.past_observations.point.size()) return 0.0;
    const double supposed_m = matches.past_observations.point[i].z();
    return supposed_m > 0 ? supposed_m : 0.0;
  }

  /// `common[i]` becomes the mean score of the population of feature i; NaN where it has no depth.
  void share_in_clusters(const Matches& matches, span<const FeatureScore> scores, const Regions& regions,
                         span<Label> labels, span<float> common, Workspace& workspace) const {
    const span<std::uint32_t> member = workspace.take<std::uint32_t>(matches.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (surface_depth_m(matches, i) > 0) member[count++] = static_cast<std::uint32_t>(i);
    if (count == 0) return;
    const PointArrays points = coordinates(matches, member.first(count), regions, workspace);
    const std::size_t wanted = std::max(fewest_clusters, count / options.features_per_cluster);
    Random random(kSeed);
    const KMeansResult clusters =
        lloyd(points, k_means_plus_plus(points, std::min(wanted, count), random, workspace), kMaxIterations, workspace);
    const span<std::size_t> begin = workspace.take<std::size_t>(clusters.centre.size() + 1);
    for (std::size_t c = 0; c < clusters.centre.size(); ++c) begin[c + 1] = begin[c] + clusters.member_count[c];
    const span<std::size_t> next = workspace.take<std::size_t>(clusters.centre.size());
    std::copy_n(begin.begin(), next.size(), next.begin());
    const span<std::uint32_t> sorted = workspace.take<std::uint32_t>(count);
    for (std::size_t j = 0; j < count; ++j) {
      sorted[next[static_cast<std::size_t>(clusters.cluster[j])]++] = member[j];
      labels[member[j]].cluster = clusters.cluster[j];
    }
    const span<float> values = workspace.take<float>(count);
    for (std::size_t c = 0; c < clusters.centre.size(); ++c)
      share(sorted.subspan(begin[c], begin[c + 1] - begin[c]), scores, values, common);
  }

  /// Of each member: lateral and depth in units in which noise is round. Regions are so far apart that they share no
  /// cluster.
  PointArrays coordinates(const Matches& matches, span<const std::uint32_t> member, const Regions& regions,
                          Workspace& workspace) const {
    PointArrays points(member.size(), workspace);
    const Workspace::Scope scope(workspace);
    const span<double> whitened = workspace.take<double>(member.size());
    whiten(matches, member, whitened, workspace);
    const double apart = std::max(1000.0, 2.0 * *std::max_element(whitened.begin(), whitened.end()));
    for (std::size_t j = 0; j < member.size(); ++j) {
      const std::size_t i = member[j];
      const Vector2d lateral =
          to_double(matches.current.pixel[i]) / (kExtent_px * static_cast<double>(matches.pixel_scale));
      points.set(j, {lateral.x(), lateral.y(), whitened[j] + apart * (regions.of_feature[i].dynamic_region + 1)});
    }
    return points;
  }

  /// Depth in units of its own noise: ∫ dz / extent(z), by the trapezoidal rule over the members in the order of depth.
  /// One whose depth was not measured has the extent of the next nearer one.
  void whiten(const Matches& matches, span<const std::uint32_t> member, span<double> whitened,
              Workspace& workspace) const {
    struct ByDepth {
      double depth_m = 0;  // beside the index: what is compared is not looked up again
      std::uint32_t member = 0;
    };
    const span<ByDepth> order = workspace.take<ByDepth>(member.size());
    for (std::size_t j = 0; j < order.size(); ++j)
      order[j] = {surface_depth_m(matches, member[j]), static_cast<std::uint32_t>(j)};
    std::sort(order.begin(), order.end(), [](const ByDepth& a, const ByDepth& b) {
      return a.depth_m != b.depth_m ? a.depth_m < b.depth_m : a.member < b.member;
    });
    double sum = 0, last_m = order[0].depth_m, last_density = 1.0 / depth_extent_m;
    for (const auto& [depth_m, j] : order) {
      const double extent_m = depth_extent_m + depth_extent_sigmas * matches.current.depth_sigma_m[member[j]];
      const double density = matches.current.has_depth(member[j]) ? 1.0 / extent_m : last_density;
      sum += 0.5 * (density + last_density) * (depth_m - last_m);
      whitened[j] = sum;
      last_m = depth_m;
      last_density = density;
    }
  }

  /// Writes the mean of the cluster, or of each of its two populations.
  void share(span<const std::uint32_t> members, span<const FeatureScore> scores, span<float> values,
             span<float> common) const {
    std::size_t count = 0;
    for (const std::uint32_t i : members)
      if (scores[i].scored()) values[count++] = clamped(scores[i]);
    if (count == 0) return;
    std::sort(values.begin(), values.begin() + count);
    const Split split = best_split(values.first(count));
    for (const std::uint32_t i : members) {
      if (!scores[i].scored())
        common[i] = split.mean;
      else
        common[i] = clamped(scores[i]) < split.at ? split.low_mean : split.high_mean;
    }
  }

  struct Split {
    float at;  ///< scores from here on belong to the upper population
    float low_mean, high_mean, mean;
  };

  /// Otsu's threshold (IEEE Trans. SMC 1979): the cut with the most variance between its parts. Where two populations
  /// do not explain the scores, both means are the cluster's.
  Split best_split(span<const float> sorted) const {
    const auto n = static_cast<float>(sorted.size());
    float sum = 0, sum_squares = 0;
    for (const float value : sorted) {
      sum += value;
      sum_squares += value * value;
    }
    const float mean = sum / n, variance = sum_squares / n - mean * mean;
    Split best{0.0f, mean, mean, mean};
    if (!(variance > split_variance)) return best;
    float below = 0, most = kSplitExplained * variance;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      below += sorted[k - 1];
      if (k < kFewestMembers || sorted.size() - k < kFewestMembers) continue;
      const auto nk = static_cast<float>(k);
      const float low = below / nk, high = (sum - below) / (n - nk);
      const float between = nk * (n - nk) / (n * n) * (high - low) * (high - low);
      if (!(between > most)) continue;
      most = between;
      best = {0.5f * (sorted[k - 1] + sorted[k]), low, high, mean};
    }
    return best;
  }
};

template <class Visit>
void each_option(SurfaceClusters& stage, Visit& visit) {
  visit("features_per_cluster", stage.options.features_per_cluster, OptionRange{1, 1e6});
  visit("own_share", stage.options.own_share, OptionRange{0, 1});
  visit("dynamic_shift", stage.options.dynamic_shift, OptionRange{-100, 100});
  if constexpr (sees_code_only<Visit>::value) {
    visit("fewest_clusters", stage.fewest_clusters, OptionRange{1, 1e6});
    visit("split_variance", stage.split_variance, OptionRange{0, 1e9});
    visit("depth_extent_m", stage.depth_extent_m, OptionRange{1e-3, 1e3});
    visit("depth_extent_sigmas", stage.depth_extent_sigmas, OptionRange{0, 1e3});
  }
}

}  // namespace stillpoint
