// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// After the largest frame has been seen, our own code takes nothing from the heap.

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "clip.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/policies.hpp"
#include "unit/counted_allocations.hpp"

namespace stillpoint::allocation_test {
namespace {

using counted_allocations::count_in;
using counted_allocations::counting;

/// Lucas-Kanade with what OpenCV allocates left out.
struct UncountedLucasKanade : LucasKanade {
  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    const bool was_counting = counting.exchange(false);
    LucasKanade::match(reference, current, matches);
    counting = was_counting;
  }
};

struct RigidOnTracks : PaperRigidPolicies {
  using Matcher = ProvidedMatches;
};
struct EpipolarOnTracks : PaperPolicies {
  using Matcher = ProvidedMatches;
};
struct DefaultOnTracks : DefaultPolicies {
  using Matcher = ProvidedMatches;
};
struct RigidOnImages : PaperRigidPolicies {
  using Matcher = UncountedLucasKanade;
};
struct EpipolarOnImages : PaperPolicies {
  using Matcher = UncountedLucasKanade;
};

void hand_over(const mock::Clip::Frame& frame, ProvidedMatches& matcher) {
  matcher.reference_pixels.assign(frame.reference_pixels.begin(), frame.reference_pixels.end());
}
void hand_over(const mock::Clip::Frame&, LucasKanade&) {}

template <class Policies>
class AllocationTest : public testing::Test {};
using PolicySets = testing::Types<RigidOnTracks, EpipolarOnTracks, RigidOnImages, EpipolarOnImages>;
TYPED_TEST_SUITE(AllocationTest, PolicySets);

TYPED_TEST(AllocationTest, NothingIsAllocatedInSteadyState) {
  mock::Clip clip(1, 12);
  FrameFilter<TypeParam> filter(mock::Clip::camera());
  filter.prior.detections = clip.detections;
  std::size_t judged_frames = 0, after_warm_up = 0;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    hand_over(clip.frames[f], filter.matcher);
    const std::size_t allocated = count_in([&] {
      judged_frames += judged(filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints).status());
    });
    if (f == 0) {
      EXPECT_GT(allocated, 0u) << "the counter counts";
    }
    if (f >= 4) after_warm_up += allocated;
  }
  EXPECT_GE(judged_frames, 10u) << "a filter that judges nothing proves nothing";
  EXPECT_EQ(after_warm_up, 0u);
}

// The filter that looks back fills a history, and its tables grow with corners and keypoints: the fullest frames
// first, then others with fewer keypoints, some outside of the image, and some without any depth.
TEST(Allocation, DefaultPoliciesAllocateNothingOnceTheFullestFrameHasBeenSeen) {
  mock::Clip clip(3, 40);
  FrameFilter<DefaultPolicies> filter(mock::Clip::camera());
  ASSERT_GE(mock::Clip(3, 1).frames[0].keypoints.size(), 200u);
  std::size_t judged_frames = 0, after_warm_up = 0;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    mock::Clip::Frame& frame = clip.frames[f];
    constexpr std::size_t kWarmUp = 20;  // the history holds 16 frames
    if (f >= kWarmUp && f % 3 == 0) frame.keypoints.resize(frame.keypoints.size() / 2);
    if (f >= kWarmUp && f % 4 == 0) frame.keypoints[0] = {1e30f, -5.0f};
    if (f == 30) frame.depth.setTo(0);
    if (f % 4 == 0) filter.prior.detections = clip.detections;  // carried in the frames between
    const std::size_t allocated = count_in([&] {
      if (f % 8 == 6) filter.prior.detected(clip.frames[f - 3].time_s, clip.detections);
      judged_frames += judged(filter.filter_frame(frame.view(), frame.keypoints).status());
    });
    if (f >= kWarmUp) after_warm_up += allocated;
  }
  EXPECT_GE(judged_frames, 35u) << "a filter that judges nothing proves nothing";
  EXPECT_FALSE(filter.prior.objects().empty());
  EXPECT_EQ(after_warm_up, 0u);
}

// Tracks are chained over the history: all frames are as full from the first on.
TEST(Allocation, TheDefaultEngineOnTracksAllocatesNothingOnceItsHistoryIsFull) {
  mock::Clip clip(3, 30);
  FrameFilter<DefaultOnTracks> filter(mock::Clip::camera());
  std::size_t judged_frames = 0, after_warm_up = 0;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    constexpr std::size_t kWarmUp = 20;
    hand_over(clip.frames[f], filter.matcher);
    const std::size_t allocated = count_in([&] {
      judged_frames += judged(filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints).status());
    });
    if (f >= kWarmUp) after_warm_up += allocated;
  }
  EXPECT_GE(judged_frames, 25u) << "a filter that judges nothing proves nothing";
  EXPECT_EQ(after_warm_up, 0u);
}

TEST(Allocation, ColourFramesAndMasksReuseTheirMemoryToo) {
  mock::Clip clip(2, 10);
  FrameFilter<RigidOnTracks> filter(mock::Clip::camera());
  ImageBuffer mask;
  std::size_t judged_frames = 0, after_warm_up = 0;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    cv::Mat colour;
    cv::cvtColor(clip.frames[f].gray, colour, cv::COLOR_GRAY2BGR);
    hand_over(clip.frames[f], filter.matcher);
    const FrameView frame(colour, DepthView::tum(clip.frames[f].depth), clip.frames[f].time_s);
    const std::size_t allocated = count_in([&] {
      const FrameResult& result = filter.filter_frame(frame, clip.frames[f].keypoints);
      result.mask(mask);
      judged_frames += judged(result.status());
      filter.feedback(Pose::Identity());
    });
    if (f >= 4) after_warm_up += allocated;
  }
  EXPECT_GE(judged_frames, 8u) << "a filter that judges nothing proves nothing";
  EXPECT_EQ(after_warm_up, 0u);
}

}  // namespace
}  // namespace stillpoint::allocation_test
