// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The same input gives the same bytes: again, in turn with another filter, and in two threads.

#include <gtest/gtest.h>

#include <thread>

#include "clip.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint::determinism_test {
namespace {

template <class Policies>
class DeterminismTest : public testing::Test {
 protected:
  struct Run {
    const mock::Clip& clip;
    FrameFilter<Policies> filter{mock::Clip::camera()};
    mock::Answer answer;
    std::size_t judged_frames = 0, dropped = 0;

    explicit Run(const mock::Clip& c) : clip(c) {}
    void step(std::size_t f) {
      if (f % 2 == 0) filter.prior.detections = clip.detections;
      const FrameResult& result = filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints);
      answer.add(result);
      judged_frames += judged(result.status());
      dropped += result.size() - result.kept_count();
    }
    void all() {
      for (std::size_t f = 0; f < clip.frames.size(); ++f) step(f);
    }
  };

  static const mock::Clip& first() {
    static const mock::Clip clip(11, 5);
    return clip;
  }
  static const mock::Clip& second() {
    static const mock::Clip clip(12, 5);
    return clip;
  }
};
using PolicySets = testing::Types<PaperRigidPolicies, PaperPolicies, DefaultPolicies>;
TYPED_TEST_SUITE(DeterminismTest, PolicySets);

TYPED_TEST(DeterminismTest, TheSameFramesGiveTheSameBytes) {
  typename TestFixture::Run once(this->first()), again(this->first()), other(this->second());
  once.all();
  again.all();
  other.all();
  EXPECT_EQ(once.answer, again.answer);
  EXPECT_FALSE(once.answer == other.answer) << "the comparison can fail";
  EXPECT_GE(once.judged_frames, 4u);
  EXPECT_GT(once.dropped, 0u);
}

TYPED_TEST(DeterminismTest, AResetFilterIsANewFilter) {
  typename TestFixture::Run fresh(this->second()), used(this->second());
  fresh.all();
  for (const mock::Clip::Frame& frame : this->first().frames) used.filter.filter_frame(frame.view(), frame.keypoints);
  used.filter.reset();
  used.all();
  EXPECT_EQ(fresh.answer, used.answer);
}

TYPED_TEST(DeterminismTest, TwoFiltersInTurnGiveTheSameBytes) {
  typename TestFixture::Run a(this->first()), b(this->second()), a_in_turn(this->first()), b_in_turn(this->second());
  a.all();
  b.all();
  for (std::size_t f = 0; f < this->first().frames.size(); ++f) {
    a_in_turn.step(f);
    b_in_turn.step(f);
  }
  EXPECT_EQ(a.answer, a_in_turn.answer);
  EXPECT_EQ(b.answer, b_in_turn.answer);
}

TYPED_TEST(DeterminismTest, TwoFiltersInTwoThreadsGiveTheSameBytes) {
  typename TestFixture::Run a(this->first()), b(this->second());
  a.all();
  b.all();
  for (int repetition = 0; repetition < 2; ++repetition) {
    typename TestFixture::Run threaded_a(this->first()), threaded_b(this->second());
    std::thread thread([&threaded_a] { threaded_a.all(); });
    threaded_b.all();
    thread.join();
    ASSERT_EQ(a.answer, threaded_a.answer);
    ASSERT_EQ(b.answer, threaded_b.answer);
  }
}

TYPED_TEST(DeterminismTest, NothingOfTheHostsIsChanged) {
  mock::Clip used(11, 5);
  typename TestFixture::Run run(used);
  run.all();
  for (std::size_t f = 0; f < used.frames.size(); ++f) {
    EXPECT_EQ(cv::norm(used.frames[f].gray, this->first().frames[f].gray, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(used.frames[f].depth, this->first().frames[f].depth, cv::NORM_INF), 0.0);
    EXPECT_EQ(used.frames[f].keypoints, this->first().frames[f].keypoints);
  }
}

}  // namespace
}  // namespace stillpoint::determinism_test
