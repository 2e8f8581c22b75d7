// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default engine on the host's own tracks, in place of its patch search.

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "backends/followed_corners.hpp"
#include "clip.hpp"
#include "scene_run.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint::provided_tracks_test {
namespace {

using scene_run::Outcome;
using scene_run::small;

struct OnTracks : DefaultPolicies {
  using Matcher = ProvidedMatches;
};

template <class Policies>
Outcome run(const synthetic::Scene& scene) {
  FrameFilter<Policies> filter(scene.camera);
  examples::FollowedCorners corners(500);
  return scene_run::run(scene, [&](const SyntheticFrame& frame, std::vector<Vector2f>& pixels) -> const FrameResult& {
    corners.next(as_mat(frame.gray.view()));
    if constexpr (std::is_same_v<typename Policies::Matcher, ProvidedMatches>)
      filter.matcher.reference_pixels = corners.reference_pixels;
    pixels = corners.pixels;
    return filter.filter_frame(frame.view(), pixels);
  });
}

TEST(ProvidedTracks, ABoxThatIsPushedIsFoundAsByThePatchSearch) {
  const synthetic::Scene scene = synthetic::pushed_box(small(60));
  const Outcome tracks = run<OnTracks>(scene), patches = run<DefaultPolicies>(scene);
  EXPECT_EQ(tracks.judged, tracks.frames);
  ASSERT_GT(tracks.score.moving().features, 1000u);
  EXPECT_GE(*tracks.score.recall(), *patches.score.recall() - 0.02);
  EXPECT_LE(*tracks.score.false_positive_rate(), *patches.score.false_positive_rate() + 0.01);
}

TEST(ProvidedTracks, AStaticRoomIsKept) {
  const Outcome tracks = run<OnTracks>(synthetic::static_room(small(30)));
  EXPECT_EQ(tracks.judged, tracks.frames);
  ASSERT_GT(tracks.score.background().features, 5000u);
  EXPECT_LE(*tracks.score.false_positive_rate(), 0.02);
}

// ---- Tracks that are known exactly ----

class ProvidedTracksOfClip : public testing::Test {
 protected:
  /// Filters a frame of the clip.
  const FrameResult& filter(std::size_t f) { return filter_.filter_frame(clip_.frames[f].view(), keypoints(f)); }
  const FrameResult& filter_on_tracks(std::size_t f) {
    filter_.matcher.reference_pixels = clip_.frames[f].reference_pixels;
    return filter(f);
  }
  const std::vector<Vector2f>& keypoints(std::size_t f) const { return clip_.frames[f].keypoints; }

  /// Share of the mover's keypoints that a frame drops, and of all others.
  double dropped(const FrameResult& result, std::size_t f, bool of_mover) const {
    int count = 0, dropped = 0;
    for (std::size_t i = 0; i < keypoints(f).size(); ++i) {
      const Vector2f pixel = keypoints(f)[i];
      const bool on_it = pixel.x() > 68 && pixel.x() < 92 && pixel.y() > 38 && pixel.y() < 82;
      const bool beside = pixel.x() > 55 && pixel.x() < 105 && pixel.y() > 25 && pixel.y() < 95;
      if (of_mover ? !on_it : beside) continue;
      ++count;
      dropped += result.keep()[i] == 0;
    }
    return static_cast<double>(dropped) / count;
  }

  mock::Clip clip_{1, 24};
  FrameFilter<OnTracks> filter_{mock::Clip::camera()};
};

TEST_F(ProvidedTracksOfClip, WhatMovesAgainstTheMotionOfTheRestIsDropped) {
  for (std::size_t f = 0; f < 12; ++f) {
    const FrameResult& result = filter_on_tracks(f);
    if (f == 0) continue;
    ASSERT_TRUE(judged(result.status())) << f << ": " << to_string(result.status());
    EXPECT_NEAR(std::abs(result.motion().current_from_reference.translation().x()), mock::Clip::kCameraStep_m, 0.004)
        << f;
    if (f < 7) continue;  // evidence adds up
    EXPECT_GE(dropped(result, f, true), 0.9) << f;
    EXPECT_LE(dropped(result, f, false), 0.05) << f;
  }
}

TEST_F(ProvidedTracksOfClip, AFrameWithoutTracksIsNotJudgedAndTheNextOneIs) {
  for (std::size_t f = 0; f < 6; ++f) filter_on_tracks(f);
  EXPECT_FALSE(judged(filter(6).status())) << "there was nothing to tell the motion by";
  EXPECT_EQ(dropped(filter(7), 7, true), 0.0);
  filter_.matcher.reference_pixels.assign(3, Vector2f(20, 20));
  const FrameResult& wrong = filter(8);
  EXPECT_FALSE(judged(wrong.status())) << "a list of another length is none";
  EXPECT_EQ(wrong.kept_count(), wrong.size());
  for (std::size_t f = 9; f < 22; ++f) {
    const FrameResult& result = filter_on_tracks(f);
    EXPECT_TRUE(judged(result.status())) << f;
    if (f >= 17) {
      EXPECT_GE(dropped(result, f, true), 0.9) << f;
    }
  }
}

TEST_F(ProvidedTracksOfClip, NoTrackReachesAcrossAResetOrAGap) {
  for (std::size_t f = 0; f < 8; ++f) filter_on_tracks(f);
  filter_.reset();
  EXPECT_EQ(filter_on_tracks(8).status(), Status::first_frame);
  EXPECT_TRUE(judged(filter_on_tracks(9).status()));
  for (std::size_t f = 10; f < 24; ++f) clip_.frames[f].time_s += 60.0;
  EXPECT_FALSE(judged(filter_on_tracks(10).status())) << "a minute later";
  for (std::size_t f = 11; f < 18; ++f) EXPECT_TRUE(judged(filter_on_tracks(f).status())) << f;
  EXPECT_GE(dropped(filter_on_tracks(18), 18, true), 0.9);
}

}  // namespace
}  // namespace stillpoint::provided_tracks_test
