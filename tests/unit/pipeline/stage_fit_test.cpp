// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every single replacement of a stage in every set that we ship, and the pairs that only go together: it does not
// compile, or it finds who walks.

#include "stillpoint/pipeline/stage_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "backends/followed_corners.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/depth/no_depth_registration.hpp"
#include "stillpoint/depth/no_hole_filling.hpp"
#include "stillpoint/depth/temporal_hole_filling.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/match/corner_tracker.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/pipeline/scene_run.hpp"

// The sanitizers' build sees each stage in the other tests: sixty filters more would take it minutes to compile.
#ifndef __SANITIZE_ADDRESS__

namespace stillpoint::stage_fit_test {
namespace {

// clang-format off
template <class Set, class T> struct WithDepthNoise : Set { using DepthNoise = T; };
template <class Set, class T> struct WithDepthRegistration : Set { using DepthRegistration = T; };
template <class Set, class T> struct WithHoleFilling : Set { using HoleFilling = T; };
template <class Set, class T> struct WithDepthLookup : Set { using DepthLookup = T; };
template <class Set, class T> struct WithPrior : Set { using Prior = T; };
template <class Set, class T> struct WithMatcher : Set { using Matcher = T; };
template <class Set, class T> struct WithEgoMotion : Set { using EgoMotion = T; };
template <class Set, class T> struct WithScorer : Set { using Scorer = T; };
template <class Set, class T> struct WithGate : Set { using Gate = T; };
template <class Set, class T> struct WithClassifier : Set { using Classifier = T; };
template <class Set, class T> struct WithMemory : Set { using Memory = T; };
template <class Set, class T> struct WithKeepFloor : Set { using KeepFloor = T; };
// clang-format on

/// A function of the host's: three times the noise of a Kinect.
struct ThreeKinects {
  double operator()(double depth_m) const { return 3 * KinectNoise{}.sigma(depth_m); }
};
using FunctionOfTheHost = FunctorNoise<ThreeKinects>;

constexpr std::array<std::uint64_t, 3> kSeeds = {1, 2, 3};  // in one scene RANSAC finds 0.06 more or less by rounding

/// Two people walk past a hand-held camera; every keypoint knows where it was, as optical flow saw it.
struct Walk {
  struct Frame {
    SyntheticFrame images;
    std::vector<Vector2f> pixels, reference_pixels;
  };
  synthetic::Scene scene;
  std::vector<Frame> frames;

  explicit Walk(std::uint64_t seed) : scene(synthetic::walking_people(scene_run::small(40, seed))) {
    SyntheticSequence sequence(scene);
    examples::FollowedCorners corners(300);
    for (int f = 0; f < sequence.size(); ++f) {
      Frame frame;
      sequence.render(f, frame.images);
      corners.next(as_mat(frame.images.gray.view()));
      frame.pixels = corners.pixels;
      frame.reference_pixels = corners.reference_pixels;
      frames.push_back(std::move(frame));
    }
  }
  static const std::vector<Walk>& all() {
    static const std::vector<Walk> walks(kSeeds.begin(), kSeeds.end());
    return walks;
  }
};

/// Recall and false-positive rate of a set on all walks, with a box round each person.
template <class Set>
FilterScore score_of() {
  FilterScore score;
  for (const Walk& walk : Walk::all()) {
    FrameFilter<Set> filter(walk.scene.camera);
    for (const Walk::Frame& frame : walk.frames) {
      if constexpr (!std::is_same_v<typename Set::Prior, NoPrior>)
        for (const synthetic::TruthBox& box : frame.images.boxes)
          filter.prior.detections.push_back({{static_cast<float>(box.x), static_cast<float>(box.y),
                                              static_cast<float>(box.width), static_cast<float>(box.height)},
                                             Mobility::dynamic,
                                             1.0f});
      if constexpr (std::is_same_v<typename Set::Matcher, ProvidedMatches>)
        filter.matcher.reference_pixels = frame.reference_pixels;
      const FrameResult& result = filter.filter_frame(frame.images.view(), frame.pixels);
      score.add_frame(frame.images.labels.view(), frame.pixels, result.keep());
    }
  }
  return score;
}

/// What a set does to the walk, or that it would not compile.
struct Expected {
  double least_recall, most_false_positives;
};

template <class Set>
void expect_finds_or_refused(const char* name, const Expected& expected, std::string& refused) {
  if constexpr (fit_together(NeedsOf<Set>{})) {
    const FilterScore score = score_of<Set>();
    EXPECT_GE(*score.recall(), expected.least_recall) << name;
    EXPECT_LE(*score.false_positive_rate(), expected.most_false_positives) << name;
    EXPECT_GE(*score.recall(), 2.0 * *score.false_positive_rate()) << name << ": chance would do as much";
  } else {
    refused += std::string(refused.empty() ? "" : ", ") + name;
  }
}

#define EXPECT_REPLACED(STAGE, TYPE)                        \
  if constexpr (!std::is_same_v<typename Set::STAGE, TYPE>) \
  expect_finds_or_refused<With##STAGE<Set, TYPE>>(#TYPE, expected, refused)

/// @return  the replacements that do not compile
template <class Set>
std::string replace_each(const Expected& expected) {
  std::string refused;
  expect_finds_or_refused<Set>("as it is", expected, refused);
  EXPECT_EQ(refused, "");
  EXPECT_REPLACED(DepthNoise, KinectNoise);
  EXPECT_REPLACED(DepthNoise, StereoNoise);
  EXPECT_REPLACED(DepthNoise, TimeOfFlightNoise);
  EXPECT_REPLACED(DepthNoise, FunctionOfTheHost);
  EXPECT_REPLACED(DepthLookup, RoundedDepth);
  EXPECT_REPLACED(DepthLookup, GuardedDepth);
  EXPECT_REPLACED(DepthLookup, NoDepth);
  EXPECT_REPLACED(Prior, BoxPrior);
  EXPECT_REPLACED(Prior, ForegroundPrior);
  EXPECT_REPLACED(Prior, PropagatedPrior);
  EXPECT_REPLACED(Matcher, LucasKanade);
  EXPECT_REPLACED(Matcher, PatchMatcher);
  EXPECT_REPLACED(Matcher, ProvidedMatches);
  EXPECT_REPLACED(Matcher, CornerTracker);
  EXPECT_REPLACED(EgoMotion, EpipolarMotion);
  EXPECT_REPLACED(EgoMotion, MonocularMotion);
  EXPECT_REPLACED(EgoMotion, RigidMotion);
  EXPECT_REPLACED(EgoMotion, SupportMotion);
  EXPECT_REPLACED(Scorer, OffsetScore);
  EXPECT_REPLACED(Scorer, SampsonScore);
  EXPECT_REPLACED(Scorer, ReprojectionScore);
  EXPECT_REPLACED(Gate, MeanGate);
  EXPECT_REPLACED(Gate, TailGate);
  EXPECT_REPLACED(Classifier, RegionClusters);
  EXPECT_REPLACED(Classifier, SurfaceClusters);
  EXPECT_REPLACED(Classifier, FlowNeighbours);
  EXPECT_REPLACED(Memory, NoMemory);
  EXPECT_REPLACED(Memory, EvidenceMemory);
  EXPECT_REPLACED(KeepFloor, NoKeepFloor);
  EXPECT_REPLACED(KeepFloor, stillpoint::KeepFloor);
  if constexpr (std::is_same_v<DepthRegistrationOf<Set>, NoDepthRegistration>)
    expect_finds_or_refused<WithDepthRegistration<Set, DepthRegistration>>("DepthRegistration", expected, refused);
  else
    expect_finds_or_refused<WithDepthRegistration<Set, NoDepthRegistration>>("NoDepthRegistration", expected, refused);
  if constexpr (std::is_same_v<HoleFillingOf<Set>, NoHoleFilling>)
    expect_finds_or_refused<WithHoleFilling<Set, TemporalHoleFilling>>("TemporalHoleFilling", expected, refused);
  else
    expect_finds_or_refused<WithHoleFilling<Set, NoHoleFilling>>("NoHoleFilling", expected, refused);
  expect_finds_or_refused<WithMovers<Set>>("WithMovers", expected, refused);
  return refused;
}

TEST(StageFit, EachReplacementInDefaultPoliciesFindsWhoWalksOrIsRefused) {
  EXPECT_EQ(
      (replace_each<DefaultPolicies>({0.75, 0.06})),
      "NoDepth, LucasKanade, CornerTracker, MonocularMotion, OffsetScore, SampsonScore, MeanGate, RegionClusters, "
      "NoMemory")
      << "SampsonScore needs the host's matches";
}

// What moves along its epipolar line is not found by what is left.
TEST(StageFit, EachReplacementInMonocularPoliciesFindsWhoWalksOrIsRefused) {
  EXPECT_EQ((replace_each<MonocularPolicies>({0.25, 0.04})),
            "PatchMatcher, CornerTracker, EpipolarMotion, RigidMotion, SupportMotion, OffsetScore, ReprojectionScore, "
            "MeanGate, RegionClusters, SurfaceClusters, NoMemory, WithMovers")
      << "MeanGate and NoMemory do not go with FlowNeighbours, the others need depth";
}

constexpr const char* kRefusedByThePaper =
    "NoDepth, ForegroundPrior, PropagatedPrior, PatchMatcher, CornerTracker, MonocularMotion, ReprojectionScore, "
    "TailGate, SurfaceClusters, FlowNeighbours, EvidenceMemory";

// The paper drops what lies in the boxes' corners as well.
TEST(StageFit, EachReplacementInPaperPoliciesFindsWhoWalksOrIsRefused) {
  EXPECT_EQ((replace_each<PaperPolicies>({0.3, 0.4})), kRefusedByThePaper);
}

TEST(StageFit, EachReplacementInPaperRigidPoliciesFindsWhoWalksOrIsRefused) {
  EXPECT_EQ((replace_each<PaperRigidPolicies>({0.25, 0.4})),
            "NoDepth, ForegroundPrior, PropagatedPrior, PatchMatcher, CornerTracker, MonocularMotion, SampsonScore, "
            "ReprojectionScore, TailGate, SurfaceClusters, FlowNeighbours, EvidenceMemory")
      << "SampsonScore does not go with RigidMotion";
}

TEST(StageFit, WithoutAPriorTheDefaultFindsWhoWalksAndThePaperNothing) {
  EXPECT_GE((*score_of<WithPrior<DefaultPolicies, NoPrior>>().recall()), 0.75);
  EXPECT_GE((*score_of<WithPrior<MonocularPolicies, NoPrior>>().recall()), 0.25);
  EXPECT_EQ((*score_of<WithPrior<PaperPolicies, NoPrior>>().recall()), 0.0) << "it tests features inside boxes only";
  EXPECT_EQ((*score_of<WithPrior<PaperRigidPolicies, NoPrior>>().recall()), 0.0);
}

// ---- Stages that only go together ----

template <class T>
constexpr const char* kName = "";
#define NAMED(TYPE) \
  template <>       \
  constexpr const char* kName<TYPE> = #TYPE
NAMED(RoundedDepth);
NAMED(GuardedDepth);
NAMED(NoDepth);
NAMED(BoxPrior);
NAMED(ForegroundPrior);
NAMED(PropagatedPrior);
NAMED(LucasKanade);
NAMED(PatchMatcher);
NAMED(ProvidedMatches);
NAMED(CornerTracker);
NAMED(EpipolarMotion);
NAMED(MonocularMotion);
NAMED(RigidMotion);
NAMED(SupportMotion);
NAMED(OffsetScore);
NAMED(SampsonScore);
NAMED(ReprojectionScore);
NAMED(MeanGate);
NAMED(TailGate);
NAMED(RegionClusters);
NAMED(SurfaceClusters);
NAMED(FlowNeighbours);
NAMED(NoMemory);
NAMED(EvidenceMemory);

template <class Stage>
struct Type {
  using type = Stage;
};
template <class... Stages>
struct Types {};
using Depths = Types<RoundedDepth, GuardedDepth, NoDepth>;
using Priors = Types<BoxPrior, ForegroundPrior, PropagatedPrior>;
using Matchers = Types<LucasKanade, PatchMatcher, ProvidedMatches, CornerTracker>;
using Motions = Types<EpipolarMotion, MonocularMotion, RigidMotion, SupportMotion>;
using Scorers = Types<OffsetScore, SampsonScore, ReprojectionScore>;
using Gates = Types<MeanGate, TailGate>;
using Classifiers = Types<RegionClusters, SurfaceClusters, FlowNeighbours>;
using Memories = Types<NoMemory, EvidenceMemory>;

/// A pair that compiles although one of the two alone does not.
template <class Set, template <class, class> class WithA, template <class, class> class WithB, class A, class B>
void expect_pair(const Expected& expected, std::string& pairs) {
  using Both = WithA<WithB<Set, B>, A>;
  constexpr bool is_alone = fit_together(NeedsOf<WithA<Set, A>>{}) && fit_together(NeedsOf<WithB<Set, B>>{});
  if constexpr (!is_alone && fit_together(NeedsOf<Both>{})) {
    const std::string name = std::string(kName<A>) + " and " + kName<B>;
    std::string refused;
    expect_finds_or_refused<Both>(name.c_str(), expected, refused);
    pairs += (pairs.empty() ? "" : ", ") + name;
  }
}

template <class Set, template <class, class> class WithA, template <class, class> class WithB, class... As, class... Bs>
void each_pair(Types<As...>, Types<Bs...>, const Expected& expected, std::string& pairs) {
  const auto with = [&](auto a, auto... b) {
    (expect_pair<Set, WithA, WithB, typename decltype(a)::type, typename decltype(b)::type>(expected, pairs), ...);
  };
  (with(Type<As>{}, Type<Bs>{}...), ...);
}

/// All pairs of stages of which one needs something of the other (`NeedsOf`).
/// @return  those that only go together
template <class Set>
std::string replace_pairs(const Expected& expected) {
  std::string pairs;
  each_pair<Set, WithMatcher, WithDepthLookup>(Matchers{}, Depths{}, expected, pairs);
  each_pair<Set, WithEgoMotion, WithDepthLookup>(Motions{}, Depths{}, expected, pairs);
  each_pair<Set, WithScorer, WithDepthLookup>(Scorers{}, Depths{}, expected, pairs);
  each_pair<Set, WithClassifier, WithDepthLookup>(Classifiers{}, Depths{}, expected, pairs);
  each_pair<Set, WithClassifier, WithPrior>(Classifiers{}, Priors{}, expected, pairs);
  each_pair<Set, WithEgoMotion, WithMatcher>(Motions{}, Matchers{}, expected, pairs);
  each_pair<Set, WithScorer, WithMatcher>(Scorers{}, Matchers{}, expected, pairs);
  each_pair<Set, WithClassifier, WithMatcher>(Classifiers{}, Matchers{}, expected, pairs);
  each_pair<Set, WithScorer, WithEgoMotion>(Scorers{}, Motions{}, expected, pairs);
  each_pair<Set, WithGate, WithScorer>(Gates{}, Scorers{}, expected, pairs);
  each_pair<Set, WithClassifier, WithScorer>(Classifiers{}, Scorers{}, expected, pairs);
  each_pair<Set, WithClassifier, WithGate>(Classifiers{}, Gates{}, expected, pairs);
  each_pair<Set, WithMemory, WithClassifier>(Memories{}, Classifiers{}, expected, pairs);
  return pairs;
}

TEST(StageFit, EachPairThatOnlyGoesTogetherFindsWhoWalks) {
  EXPECT_EQ((replace_pairs<DefaultPolicies>({0.3, 0.06})),
            "SampsonScore and LucasKanade, SampsonScore and ProvidedMatches");
  EXPECT_EQ((replace_pairs<MonocularPolicies>({0.25, 0.06})),
            "EpipolarMotion and RoundedDepth, EpipolarMotion and GuardedDepth, SupportMotion and RoundedDepth, "
            "SupportMotion and GuardedDepth, SurfaceClusters and RoundedDepth, SurfaceClusters and GuardedDepth");
  EXPECT_EQ((replace_pairs<PaperPolicies>({0.3, 0.4})),
            "ReprojectionScore and PatchMatcher, ReprojectionScore and ProvidedMatches, SampsonScore and "
            "MonocularMotion, TailGate and SampsonScore");
  EXPECT_EQ((replace_pairs<PaperRigidPolicies>({0.25, 0.4})),
            "ReprojectionScore and PatchMatcher, ReprojectionScore and ProvidedMatches, SampsonScore and "
            "EpipolarMotion, SampsonScore and MonocularMotion, SampsonScore and SupportMotion");
}

struct PaperDecides : DefaultPolicies {  // the engine's evidence, the paper's clusters
  using Prior = BoxPrior;
  using Classifier = RegionClusters;
  using Memory = NoMemory;
  using Gate = MeanGate;
};
struct TwoFrames : DefaultPolicies {  // Lucas-Kanade and the paper's score
  using Prior = BoxPrior;
  using Matcher = LucasKanade;
  using Scorer = OffsetScore;
  using Gate = MeanGate;
  using Classifier = RegionClusters;
  using Memory = NoMemory;
};
TEST(StageFit, SetsWhoseStagesNeedEachOtherFindWhoWalks) {
  std::string refused;
  expect_finds_or_refused<PaperDecides>("RegionClusters, BoxPrior, NoMemory, MeanGate", {0.9, 0.4}, refused);
  expect_finds_or_refused<TwoFrames>("LucasKanade and OffsetScore", {0.8, 0.4}, refused);
  EXPECT_EQ(refused, "");
}

}  // namespace
}  // namespace stillpoint::stage_fit_test

#endif
