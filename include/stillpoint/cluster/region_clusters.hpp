// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which features move together?   The paper's classifier, Eq. 11 to 14: clusters of the features in dynamic boxes, each
// judged by its mean score.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "stillpoint/cluster/k_means.hpp"
#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// V_other, the features inside dynamic boxes, are clustered by their 3D points (k = m / 10 over all boxes together); a
/// cluster whose mean score τ_k exceeds φ is dynamic, all of it (Eq. 14).
/// Features without a score are `unknown`: kept outside dynamic boxes, dropped inside (the paper leaves it open).
class RegionClusters {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::whole_boxes>;
  using Provides = Capabilities<capability::verdicts>;

  struct Options {
    std::size_t features_per_cluster = 10;  ///< k = m / 10; fewer than that many: each is its own cluster
    int max_iterations = 100;               ///< the paper: until assignments no longer change
    std::uint64_t seed = Random::kDefaultSeed;
  };
  Options options;

  void classify(const Observations& observations, const Evidence& evidence, span<Label> labels,
                Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const Regions& regions = observations.regions;
    const span<const FeatureScore> scores = evidence.scores;
    const Workspace::Scope scope(workspace);
    const span<std::size_t> tested = workspace.take<std::size_t>(matches.size());
    std::size_t m = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const bool inside = regions.of_feature[i].in_dynamic;
      if (inside && scores[i].scored())
        tested[m++] = i;
      else
        labels[i] = untested(matches, i, scores[i].scored(), inside);
    }
    if (m > 0) judge_clusters(matches, scores, evidence.threshold, tested.first(m), labels, workspace);
  }

 private:
  static Label untested(const Matches& matches, std::size_t i, bool scored, bool inside) noexcept {
    Label label;
    label.keep = !inside;
    label.verdict = scored ? Verdict::kept : Verdict::unknown;
    label.reason = scored                                    ? Reason::outside_regions
                   : matches.state[i] == MatchState::outside ? Reason::outside_image
                   : !matches.matched(i)                     ? Reason::no_match
                                                             : Reason::no_depth;
    return label;
  }

  void judge_clusters(const Matches& matches, span<const FeatureScore> scores, const Threshold& threshold,
                      span<const std::size_t> tested, span<Label> labels, Workspace& workspace) const {
    const std::size_t m = tested.size();
    const std::size_t k =
        m < options.features_per_cluster ? m : m / std::max<std::size_t>(options.features_per_cluster, 1);
    PointArrays points(m, workspace);
    for (std::size_t j = 0; j < m; ++j) points.set(j, matches.current.point[tested[j]]);
    Random random(options.seed);
    const KMeansResult clusters =
        lloyd(points, k_means_plus_plus(points, k, random, workspace), options.max_iterations, workspace);

    const span<double> mean = workspace.take<double>(k);  // τ_k, Eq. 13
    for (std::size_t j = 0; j < m; ++j) {
      const auto c = static_cast<std::size_t>(clusters.cluster[j]);
      mean[c] += static_cast<double>(scores[tested[j]].value) / static_cast<double>(clusters.member_count[c]);
    }
    for (std::size_t j = 0; j < m; ++j) {
      const bool moving = mean[static_cast<std::size_t>(clusters.cluster[j])] > threshold.level;  // Eq. 14
      Label& label = labels[tested[j]];
      label.verdict = moving ? Verdict::dynamic : Verdict::kept;
      label.reason = moving ? Reason::moving_cluster : Reason::static_cluster;
      label.keep = !moving;
      label.cluster = clusters.cluster[j];
    }
  }
};

template <class Visit>
void each_option(RegionClusters& stage, Visit& visit) {
  visit("features_per_cluster", stage.options.features_per_cluster, OptionRange{1, 1e6});
  visit("max_iterations", stage.options.max_iterations, OptionRange{1, 1000});
  visit.seed("seed", stage.options.seed);
}

}  // namespace stillpoint
