// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What did we know of this feature, and of this place?   Two memories, from frame to frame.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/memory/neighbour_steps.hpp"
#include "stillpoint/memory/remembered_points.hpp"

namespace stillpoint {

/// Log-odds add up over frames and decay; they give the verdicts. The dynamic prior decays slowly: it is the memory
/// that something moved here. New features inherit it from the majority of their neighbours on the same surface. It
/// only lowers the weight in the ego-motion, because a person who stops may start again and would then drag the pose. A
/// neighbour that is new itself knows little, and has little of a vote: where depth comes and goes, half of a person's
/// corners are new in each frame. Surface cells inherit it, too: a sleeve that comes into view belongs to the man whose
/// collar was seen moving. If the dynamic prior drove verdicts, false positives would spread from surface to surface.
class EvidenceMemory {
 public:
  using Needs = Capabilities<capability::log_odds>;

  struct Options {
    double log_odds_decay_s = 0.0935;     ///< time in which log-odds fall by e
    double dynamic_prior_rise_s = 0.065;  ///< a flicker at a silhouette leaves no lasting prior
    double dynamic_prior_decay_s = 4.0;   ///< time in which the dynamic prior falls by e
  };
  Options options;

  /// Nats that evidence must be stronger for each factor e of frames that are fewer than at 30 Hz; no option in files.
  /// On kitchen_static at 10 and 5 Hz the false-positive rate was 1.2 and 1.5 % without it, at 30 Hz it is 0.5 %.
  float caution = 0.55f;

  /// Looks every feature and surface cell up in what is remembered, and says what static prior and log-odds they have.
  void recall(const Matches& matches, Remembered& remembered, Workspace& workspace) {
    refill(recalled_, matches.size(), Memory{});
    refill(recalled_of_cell_, matches.past_observations.surfaces.size(), Memory{});
    if (matches.unjudged_s > 0) dynamic_.clear();  // what the map said was of the frame that was to come then
    if (pixel_.empty()) return;
    const Workspace::Scope scope(workspace);
    const float neighbour_px = matches.pixel_scale * kNeighbour_px;
    const float feature_px = matches.pixel_scale * kFeature_px;
    const NeighbourSteps steps(matches, neighbour_px, workspace);
    const double age_s = matches.elapsed_s + matches.unjudged_s;
    dynamic_prior_left_ = static_cast<float>(std::exp(-age_s / options.dynamic_prior_decay_s));
    const float log_odds_left = static_cast<float>(std::exp(-matches.unjudged_s / options.log_odds_decay_s));
    const RememberedPoints points(pixel_, remembered_, {neighbour_px, feature_px}, workspace);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Vector2f here = matches.current.pixel[i];
      const double depth_m = matches.current.depth_m[i];
      const double tolerance_m = kSameSurface.at(matches.current.depth_sigma_m[i]);
      const Vector2f pixel = matches.matched(i) ? matches.reference.pixel[i]
                                                : steps.before(here, depth_m, tolerance_m, matches.predicted[i]);
      recalled_[i] = look_up(points, pixel, depth_m, tolerance_m);
      if (settled(matches.occupied_views[i], matches.space_static_prior[i])) recalled_[i].dynamic_prior = 0;
      recalled_[i].by_map = evidence_of_map(pixel, depth_m, tolerance_m, neighbour_px);
      remembered.static_prior[i] = std::min(matches.space_static_prior[i], static_prior(recalled_[i].dynamic_prior));
      remembered.log_odds[i] = log_odds_left * recalled_[i].log_odds;
    }
    for (std::size_t s = 0; s < recalled_of_cell_.size(); ++s) {
      const SurfaceCell& cell = matches.past_observations.surfaces[s];
      const double depth_m = cell.point.z(), tolerance_m = kSameSurface.at(cell.depth_sigma_m);
      recalled_of_cell_[s] =
          look_up(points, steps.before(cell.pixel, depth_m, tolerance_m, cell.predicted), depth_m, tolerance_m);
      if (settled(cell.occupied_views, cell.space_static_prior)) recalled_of_cell_[s].dynamic_prior = 0;
      remembered.surface_static_prior[s] =
          std::min(cell.space_static_prior, static_prior(recalled_of_cell_[s].dynamic_prior));
    }
  }

  /// Adds this frame's log-odds to what is remembered, and decides.
  void update(const Observations& observations, const Motion&, const Evidence&, span<Label> labels, Workspace&) {
    const Matches& matches = observations.matches;
    pixel_.clear();
    remembered_.clear();
    dynamic_.clear();
    const auto persistence_over = [this](double age_s) {
      return static_cast<float>(std::exp(-age_s / options.log_odds_decay_s));
    };
    const float persistence = persistence_over(matches.elapsed_s + matches.unjudged_s);
    const auto gain = [&matches](double rise_s) {
      return static_cast<float>(exponential_share(matches.elapsed_s, rise_s));
    };
    const float dynamic_prior_gain = gain(options.dynamic_prior_rise_s), certainty_gain = gain(kCertaintyRise_s);
    const auto watched = [certainty_gain](Memory memory) {
      memory.certainty += certainty_gain * (1.0f - memory.certainty);
      return memory;
    };
    const float cautious = caution_at(persistence_over(matches.elapsed_s));
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Memory before = recalled_[i];
      Label& label = labels[i];
      const float now = label.log_odds;
      const float least = -kMostLogOdds * (1.0f - kLowerBoundLoss * before.dynamic_prior);
      label.log_odds = std::clamp(persistence * before.log_odds + now + before.by_map - cautious, least, kMostLogOdds);
      label.static_prior = observations.remembered.static_prior[i];
      decide(label, now);
      Memory after = watched(before);
      after.log_odds = label.log_odds;
      if (label.log_odds > kPriorRisesAbove) after.dynamic_prior += dynamic_prior_gain * (1.0f - before.dynamic_prior);
      remember(matches.current.pixel[i], matches.current.depth_m[i], after, true);
    }
    for (std::size_t s = 0; s < recalled_of_cell_.size(); ++s) {
      const SurfaceCell& cell = matches.past_observations.surfaces[s];
      remember(cell.pixel, cell.point.z(), watched(recalled_of_cell_[s]), false);
    }
  }

  /// Features of the last frame that move by the host's map: evidence against what is near them in the coming frame.
  /// The map must say so in every frame.
  /// @param is_dynamic  one byte per keypoint
  void expect_dynamic(span<const std::uint8_t> is_dynamic) {
    dynamic_.clear();
    const std::size_t count = std::min(is_dynamic.size(), remembered_.size());
    for (std::size_t i = 0; i < count; ++i)
      if (is_dynamic[i] != 0) dynamic_.push_back(remembered_[i]);
  }

  void reset() noexcept {
    pixel_.clear();
    remembered_.clear();
    dynamic_.clear();
    recalled_.clear();
    recalled_of_cell_.clear();
  }

 private:
  static constexpr float kMostLogOdds = 3.0f;      // log-odds are held within ± this, nats
  static constexpr float kDropAbove = 0.0f;        // nats: even odds; the gate's rate sets how much evidence that takes
  static constexpr float kPriorRisesAbove = 2.0f;  // log-odds above which the dynamic prior rises, nats
  static constexpr float kLowerBoundLoss = 0.6f;   // of the lower bound, at a dynamic prior of 1: it may start again
  static constexpr float kMapEvidence = 6.0f;      // nats: several points of a map outweigh two frames that agree
  static constexpr float kLeastStaticPrior = 0.01f;  // static prior at a dynamic prior of 1
  static constexpr double kCertaintyRise_s = 1.0;    // time in which all but 1 / e is known of what is watched
  static constexpr float kFeature_px = 15.0f;        // how far a feature may have moved and still be recognised
  static constexpr float kNeighbour_px = 25.0f;      // neighbours that hand the dynamic prior on
  static constexpr float kMinority =
      0.25f;  // dynamic prior of the neighbours below which none is handed on; above 1 − this, all
  static constexpr DepthTolerance kSameSurface{0.06};
  static constexpr double kUsualInterval_s = 1.0 / 30.0;

  struct Memory {
    float log_odds = 0;
    float dynamic_prior = 0;  ///< 0 to 1
    float by_map = 0;         ///< nats, of a host's map
    float certainty = 0;      ///< of the dynamic prior, 0 to 1
  };

  void remember(const Vector2f& pixel, double depth_m, const Memory& memory, bool is_feature) {
    pixel_.push_back(pixel);
    remembered_.push_back(
        {pixel, static_cast<float>(depth_m), memory.log_odds, memory.dynamic_prior, is_feature, memory.certainty});
  }

  /// Two views of seconds ago saw it in its place, and none saw through: it is static.
  static bool settled(std::uint8_t occupied_views, float space_static_prior) noexcept {
    return occupied_views >= 2 && space_static_prior >= 1.0f;
  }

  /// At a low rate of frames less evidence is averaged, and its noise is larger: 1 / (1 − persistence) frames count.
  /// The gate's level is for 30 Hz.
  float caution_at(float persistence) const noexcept {
    const auto usual = static_cast<float>(std::exp(-kUsualInterval_s / options.log_odds_decay_s));
    return std::max(0.0f, caution * std::log((1.0f - persistence) / (1.0f - usual)));
  }

  static float static_prior(float dynamic_prior) noexcept { return 1.0f - (1.0f - kLeastStaticPrior) * dynamic_prior; }

  Memory look_up(const RememberedPoints& points, const Vector2f& pixel, double depth_m, double tolerance_m) const {
    const RememberedPoints::Sums near =
        points.around(pixel, static_cast<float>(depth_m), static_cast<float>(tolerance_m));
    Memory memory;
    if (near.feature_weight > 0) memory.log_odds = near.log_odds / near.feature_weight;
    if (near.asked > 0) memory.certainty = near.votes / near.asked;
    if (near.votes > 0) {
      const float majority = (near.dynamic_prior / near.votes - kMinority) / (1 - 2 * kMinority);
      memory.dynamic_prior = dynamic_prior_left_ * std::clamp(majority, 0.0f, 1.0f);
    }
    return memory;
  }

  /// Of what the map called dynamic near a place, on its surface.
  float evidence_of_map(const Vector2f& pixel, double depth_m, double tolerance_m, float neighbour_px) const noexcept {
    for (const RememberedPoint& point : dynamic_) {
      if (!((point.pixel - pixel).squaredNorm() <= neighbour_px * neighbour_px)) continue;  // nor where one is NaN
      const bool has_depths = depth_m > 0 && point.depth_m > 0;
      if (!has_depths || std::abs(static_cast<double>(point.depth_m) - depth_m) < tolerance_m) return kMapEvidence;
    }
    return 0.0f;
  }

  static void decide(Label& label, float now) noexcept {
    const bool dynamic = label.log_odds > kDropAbove;
    label.keep = !dynamic;
    label.probability = 1.0f / (1.0f + std::exp(-label.log_odds));
    const bool knows = label.reason == Reason::consistent || label.reason == Reason::neighbours;
    label.verdict = dynamic ? Verdict::dynamic : knows ? Verdict::kept : Verdict::unknown;
    if (!dynamic) return;
    if (!(now > 0))
      label.reason = Reason::remembered;
    else
      label.reason = label.reason == Reason::consistent ? Reason::inconsistent : Reason::neighbours;
  }

  float dynamic_prior_left_ = 1.0f;  // of what was remembered when a frame was judged last
  // Of the last frame, its features before its surface cells.
  std::vector<Vector2f> pixel_;
  std::vector<RememberedPoint> remembered_;
  std::vector<RememberedPoint> dynamic_;  // those of them that move by the host's map
  std::vector<Memory> recalled_, recalled_of_cell_;
};

template <class Visit>
void each_option(EvidenceMemory& stage, Visit& visit) {
  visit("log_odds_decay_s", stage.options.log_odds_decay_s, OptionRange{0, 3600});
  visit("dynamic_prior_rise_s", stage.options.dynamic_prior_rise_s, OptionRange{0, 3600});
  visit("dynamic_prior_decay_s", stage.options.dynamic_prior_decay_s, OptionRange{0, 3600});
  if constexpr (sees_code_only<Visit>::value) visit("caution", stage.caution, OptionRange{0, 10});
}

}  // namespace stillpoint
