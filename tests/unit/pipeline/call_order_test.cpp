// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default pipeline calls its stages in the order that docs/extending.md lists: the real stages, each of which
// writes down what it is asked before it answers.

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <opencv2/core.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "clip.hpp"
#include "mock_policies.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/policies/with_movers.hpp"

namespace stillpoint::call_order_test {
namespace {

using Calls = std::vector<std::string>;

// A member of a recording stage is there for exactly the arguments that the real one takes: what the pipeline finds by
// its form, it finds here.

struct RecordingPrior : PropagatedPrior, mock::Stage {
  template <class... A>
  auto regions(A&&... a) -> decltype(std::declval<PropagatedPrior&>().regions(std::forward<A>(a)...)) {
    return note("prior.regions"), PropagatedPrior::regions(std::forward<A>(a)...);
  }
  template <class... A>
  auto observe(A&&... a) -> decltype(std::declval<PropagatedPrior&>().observe(std::forward<A>(a)...)) {
    return note("prior.observe"), PropagatedPrior::observe(std::forward<A>(a)...);
  }
  void reset() { note("prior.reset"), PropagatedPrior::reset(); }
};

struct RecordingMatcher : PatchMatcher, mock::Stage {
  template <class... A>
  auto align(A&&... a) -> decltype(std::declval<PatchMatcher&>().align(std::forward<A>(a)...)) {
    return note("matcher.align"), PatchMatcher::align(std::forward<A>(a)...);
  }
  template <class... A>
  auto match(A&&... a) -> decltype(std::declval<PatchMatcher&>().match(std::forward<A>(a)...)) {
    return note("matcher.match"), PatchMatcher::match(std::forward<A>(a)...);
  }
  template <class... A>
  auto contradicts(A&&... a) const -> decltype(std::declval<const PatchMatcher&>().contradicts(std::forward<A>(a)...)) {
    return note("matcher.contradicts"), PatchMatcher::contradicts(std::forward<A>(a)...);
  }
  template <class... A>
  auto choose_keyframes(A&&... a) -> decltype(std::declval<PatchMatcher&>().choose_keyframes(std::forward<A>(a)...)) {
    return note("matcher.choose_keyframes"), PatchMatcher::choose_keyframes(std::forward<A>(a)...);
  }
  template <class... A>
  auto reproject_into_past(A&&... a)
      -> decltype(std::declval<PatchMatcher&>().reproject_into_past(std::forward<A>(a)...)) {
    return note("matcher.reproject_into_past"), PatchMatcher::reproject_into_past(std::forward<A>(a)...);
  }
  template <class... A>
  auto learn(A&&... a) -> decltype(std::declval<PatchMatcher&>().learn(std::forward<A>(a)...)) {
    return note("matcher.learn"), PatchMatcher::learn(std::forward<A>(a)...);
  }
  void reset() { note("matcher.reset"), PatchMatcher::reset(); }
};

/// Asked for each feature: calls in a row count as one.
struct RecordingDepthLookup : GuardedDepth, mock::Stage {
  template <class... A>
  auto at(A&&... a) const -> decltype(std::declval<const GuardedDepth&>().at(std::forward<A>(a)...)) {
    if (log != nullptr && (log->calls.empty() || log->calls.back() != "depth_lookup.at")) note("depth_lookup.at");
    return GuardedDepth::at(std::forward<A>(a)...);
  }
};

struct RecordingDepthRegistration : DepthRegistration, mock::Stage {
  template <class... A>
  auto undo(A&&... a) -> decltype(std::declval<DepthRegistration&>().undo(std::forward<A>(a)...)) {
    return note("depth_registration.undo"), DepthRegistration::undo(std::forward<A>(a)...);
  }
  template <class... A>
  auto undo_along_flow(A&&... a)
      -> decltype(std::declval<DepthRegistration&>().undo_along_flow(std::forward<A>(a)...)) {
    return note("depth_registration.undo_along_flow"), DepthRegistration::undo_along_flow(std::forward<A>(a)...);
  }
  template <class... A>
  auto observe(A&&... a) -> decltype(std::declval<DepthRegistration&>().observe(std::forward<A>(a)...)) {
    return note("depth_registration.observe"), DepthRegistration::observe(std::forward<A>(a)...);
  }
  void reset() { note("depth_registration.reset"), DepthRegistration::reset(); }
};

struct RecordingHoleFilling : TemporalHoleFilling, mock::Stage {
  template <class... A>
  auto fill(A&&... a) -> decltype(std::declval<TemporalHoleFilling&>().fill(std::forward<A>(a)...)) {
    return note("hole_filling.fill"), TemporalHoleFilling::fill(std::forward<A>(a)...);
  }
  template <class... A>
  auto fill_along_flow(A&&... a)
      -> decltype(std::declval<TemporalHoleFilling&>().fill_along_flow(std::forward<A>(a)...)) {
    return note("hole_filling.fill_along_flow"), TemporalHoleFilling::fill_along_flow(std::forward<A>(a)...);
  }
  void reset() { note("hole_filling.reset"), TemporalHoleFilling::reset(); }
};

struct RecordingEgoMotion : SupportMotion, mock::Stage {
  template <class... A>
  auto estimate(A&&... a) -> decltype(std::declval<SupportMotion&>().estimate(std::forward<A>(a)...)) {
    return note("ego_motion.estimate"), SupportMotion::estimate(std::forward<A>(a)...);
  }
  template <class... A>
  auto refine(A&&... a) -> decltype(std::declval<SupportMotion&>().refine(std::forward<A>(a)...)) {
    return note("ego_motion.refine"), SupportMotion::refine(std::forward<A>(a)...);
  }
};

struct RecordingScorer : ReprojectionScore, mock::Stage {
  template <class... A>
  auto score(A&&... a) -> decltype(std::declval<ReprojectionScore&>().score(std::forward<A>(a)...)) {
    return note("scorer.score"), ReprojectionScore::score(std::forward<A>(a)...);
  }
};

struct RecordingGate : TailGate, mock::Stage {
  template <class... A>
  auto threshold(A&&... a) -> decltype(std::declval<TailGate&>().threshold(std::forward<A>(a)...)) {
    return note("gate.threshold"), TailGate::threshold(std::forward<A>(a)...);
  }
  template <class... A>
  auto learn(A&&... a) -> decltype(std::declval<TailGate&>().learn(std::forward<A>(a)...)) {
    return note("gate.learn"), TailGate::learn(std::forward<A>(a)...);
  }
  void reset() { note("gate.reset"), TailGate::reset(); }
};

struct RecordingClassifier : SurfaceClusters, mock::Stage {
  template <class... A>
  auto classify(A&&... a) -> decltype(std::declval<SurfaceClusters&>().classify(std::forward<A>(a)...)) {
    return note("classifier.classify"), SurfaceClusters::classify(std::forward<A>(a)...);
  }
};

struct RecordingMemory : EvidenceMemory, mock::Stage {
  template <class... A>
  auto recall(A&&... a) -> decltype(std::declval<EvidenceMemory&>().recall(std::forward<A>(a)...)) {
    return note("memory.recall"), EvidenceMemory::recall(std::forward<A>(a)...);
  }
  template <class... A>
  auto update(A&&... a) -> decltype(std::declval<EvidenceMemory&>().update(std::forward<A>(a)...)) {
    return note("memory.update"), EvidenceMemory::update(std::forward<A>(a)...);
  }
  void reset() { note("memory.reset"), EvidenceMemory::reset(); }
};

struct RecordingKeepFloor : KeepFloor, mock::Stage {
  template <class... A>
  auto apply(A&&... a) -> decltype(std::declval<KeepFloor&>().apply(std::forward<A>(a)...)) {
    return note("keep_floor.apply"), KeepFloor::apply(std::forward<A>(a)...);
  }
};

struct RecordingMovers : MoverTracking, mock::Stage {
  template <class... A>
  auto track(A&&... a) -> decltype(std::declval<MoverTracking&>().track(std::forward<A>(a)...)) {
    return note("movers.track"), MoverTracking::track(std::forward<A>(a)...);
  }
  void reset() { note("movers.reset"), MoverTracking::reset(); }
};

/// Camera and depth noise have no place in the order: they are asked all the time.
struct RecordingPolicies : DefaultPolicies {
  using Prior = RecordingPrior;
  using Matcher = RecordingMatcher;
  using DepthLookup = RecordingDepthLookup;
  using DepthRegistration = RecordingDepthRegistration;
  using HoleFilling = RecordingHoleFilling;
  using EgoMotion = RecordingEgoMotion;
  using Scorer = RecordingScorer;
  using Gate = RecordingGate;
  using Classifier = RecordingClassifier;
  using Memory = RecordingMemory;
  using KeepFloor = RecordingKeepFloor;
  using Movers = RecordingMovers;
};
template <class Recording, class Real>
constexpr bool records = std::is_base_of_v<Real, Recording>;
static_assert(records<RecordingPrior, DefaultPolicies::Prior> && records<RecordingMatcher, DefaultPolicies::Matcher> &&
                  records<RecordingDepthLookup, DefaultPolicies::DepthLookup> &&
                  records<RecordingDepthRegistration, DefaultPolicies::DepthRegistration> &&
                  records<RecordingHoleFilling, DefaultPolicies::HoleFilling> &&
                  records<RecordingEgoMotion, DefaultPolicies::EgoMotion> &&
                  records<RecordingScorer, DefaultPolicies::Scorer> && records<RecordingGate, DefaultPolicies::Gate> &&
                  records<RecordingClassifier, DefaultPolicies::Classifier> &&
                  records<RecordingMemory, DefaultPolicies::Memory> &&
                  records<RecordingKeepFloor, DefaultPolicies::KeepFloor> &&
                  records<RecordingMovers, WithMovers<>::Movers>,
              "the stages of WithMovers<DefaultPolicies>");

/// The numbered lines below a heading of docs/extending.md, each of which begins with `stage.member`; but what is asked
/// only in doubt.
Calls documented(const std::string& heading) {
  std::ifstream page(STILLPOINT_DOCUMENTS "/extending.md");
  const std::regex call("[0-9]+\\. `([a-z_]+\\.[a-z_]+)`.*");
  Calls calls;
  std::smatch found;
  bool is_below = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind('#', 0) == 0)
      is_below = line == heading;
    else if (is_below && std::regex_match(line, found, call) && found[1] != "matcher.contradicts")
      calls.push_back(found[1]);
  }
  return calls;
}

class CallOrder : public testing::Test {
 protected:
  CallOrder() {
    filter_.prior.log = filter_.matcher.log = filter_.depth_lookup.log = filter_.ego_motion.log = &log_;
    filter_.scorer.log = filter_.gate.log = filter_.classifier.log = filter_.memory.log = filter_.keep_floor.log =
        filter_.movers.log = filter_.depth_registration.log = filter_.hole_filling.log = &log_;
  }

  const FrameResult& run(std::size_t f) {
    log_.calls.clear();
    return filter_.filter_frame(clip_.frames[f].view(), clip_.frames[f].keypoints);
  }

  const Calls of_frame_ = documented("### Of a frame"), of_reset_ = documented("### Of a reset");
  mock::Clip clip_{31, 5};
  mock::Log log_;
  FrameFilter<RecordingPolicies> filter_{mock::Clip::camera()};
};

TEST_F(CallOrder, OfEachFrameIsTheDocumentedOne) {
  ASSERT_FALSE(of_frame_.empty()) << "docs/extending.md, Of a frame";
  run(0);
  for (std::size_t f = 1; f < 5; ++f) {
    EXPECT_EQ(run(f).status(), Status::ok);
    EXPECT_EQ(log_.calls, of_frame_) << "frame " << f;
  }
}

TEST_F(CallOrder, AFrameWithoutAMotionEndsAfterThePriorHasObserved) {
  run(0);
  run(1);
  clip_.frames[2].gray.setTo(100);  // the lens is covered
  EXPECT_EQ(run(2).status(), Status::too_few_matches);
  Calls expected;
  for (const std::string& call : of_frame_) {
    expected.push_back(call);
    if (call == "prior.observe") break;
  }
  EXPECT_EQ(expected.back(), "prior.observe");
  EXPECT_EQ(log_.calls, expected);
}

TEST_F(CallOrder, OfAFrameWithoutKeypointsIsThatOfAnyFrame) {
  run(0);
  run(1);
  clip_.frames[2].keypoints.clear();
  EXPECT_EQ(run(2).status(), Status::no_keypoints);
  EXPECT_EQ(log_.calls, of_frame_);
}

TEST_F(CallOrder, OfAResetIsTheDocumentedOne) {
  ASSERT_FALSE(of_reset_.empty()) << "docs/extending.md, Of a reset";
  EXPECT_EQ(run(0).status(), Status::first_frame);
  EXPECT_EQ(log_.calls, of_reset_) << "the first frame resets every stage";
  run(1);
  log_.calls.clear();
  filter_.reset();
  EXPECT_EQ(log_.calls, of_reset_);
}

TEST_F(CallOrder, RecordingStagesAnswerAsTheRealOnes) {
  FrameFilter<WithMovers<>> real(mock::Clip::camera());
  mock::Answer recorded, expected;
  for (std::size_t f = 0; f < 5; ++f) {
    recorded.add(run(f));
    expected.add(real.filter_frame(clip_.frames[f].view(), clip_.frames[f].keypoints));
  }
  EXPECT_EQ(recorded, expected);
}

}  // namespace
}  // namespace stillpoint::call_order_test
