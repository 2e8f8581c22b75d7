// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// After the largest frame has been seen, our own code takes nothing from the heap. This file replaces the program's
// operator new.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <opencv2/imgproc.hpp>

#include "clip.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/policies.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::size_t> allocations{0};

void* counted_new(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t padded = (size + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, padded == 0 ? alignment : padded);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Not inlined: g++ would see new paired with free, and warn.
[[gnu::noinline]] void release(void* memory) noexcept { std::free(memory); }

}  // namespace

void* operator new(std::size_t size) { return counted_new(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return counted_new(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted_new(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted_new(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace stillpoint {
namespace {

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
    allocations = 0;
    counting = true;
    const FrameResult& result = filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints);
    counting = false;
    judged_frames += judged(result.status());
    if (f == 0) {
      EXPECT_GT(allocations, 0u) << "the counter counts";
    }
    if (f >= 4) after_warm_up += allocations;
  }
  EXPECT_GE(judged_frames, 10u) << "a filter that judges nothing proves nothing";
  EXPECT_EQ(after_warm_up, 0u);
}

// The filter that looks back fills a history, and its tables grow with corners and key points: the fullest frames
// first, then others with fewer key points, some outside of the image, and some without any depth.
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
    allocations = 0;
    counting = true;
    if (f % 8 == 6) filter.prior.detected(clip.frames[f - 3].time_s, clip.detections);
    const FrameResult& result = filter.filter_frame(frame.view(), frame.keypoints);
    counting = false;
    judged_frames += judged(result.status());
    if (f >= kWarmUp) after_warm_up += allocations;
  }
  EXPECT_GE(judged_frames, 35u) << "a filter that judges nothing proves nothing";
  EXPECT_FALSE(filter.prior.things().empty());
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
    allocations = 0;
    counting = true;
    const FrameResult& result = filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints);
    counting = false;
    judged_frames += judged(result.status());
    if (f >= kWarmUp) after_warm_up += allocations;
  }
  EXPECT_GE(judged_frames, 25u) << "a filter that judges nothing proves nothing";
  EXPECT_EQ(after_warm_up, 0u);
}

TEST(Allocation, ColourFramesAndMasksReuseTheirMemoryToo) {
  mock::Clip clip(2, 10);
  FrameFilter<RigidOnTracks> filter(mock::Clip::camera());
  ImageBuffer mask;
  std::size_t after_warm_up = 0;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    cv::Mat colour;
    cv::cvtColor(clip.frames[f].gray, colour, cv::COLOR_GRAY2BGR);
    hand_over(clip.frames[f], filter.matcher);
    const FrameView frame(colour, DepthView(clip.frames[f].depth), clip.frames[f].time_s);
    allocations = 0;
    counting = true;
    filter.filter_frame(frame, clip.frames[f].keypoints).mask(mask);
    filter.feedback(Pose::Identity());
    counting = false;
    if (f >= 4) after_warm_up += allocations;
  }
  EXPECT_EQ(after_warm_up, 0u);
}

}  // namespace
}  // namespace stillpoint
