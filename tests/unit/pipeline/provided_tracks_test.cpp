// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default engine on the host's own tracks, in place of its patch search.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "clip.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint {
namespace {

struct OnTracks : DefaultPolicies {
  using Matcher = ProvidedMatches;
};

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Corners that OpenCV follows from frame to frame, refilled up to a number: what a host with tracks has.
class Corners {
 public:
  std::vector<Vector2f> pixels, reference_pixels;

  void next(const cv::Mat& image) {
    constexpr int kMost = 500;
    std::vector<cv::Point2f> now, fresh;
    std::vector<unsigned char> found;
    if (!points_.empty()) cv::calcOpticalFlowPyrLK(last_, image, points_, now, found, cv::noArray());
    pixels.clear();
    reference_pixels.clear();
    cv::Mat is_free(image.size(), CV_8UC1, cv::Scalar(255));
    const cv::Rect2f inside(0, 0, static_cast<float>(image.cols - 1), static_cast<float>(image.rows - 1));
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] == 0 || !inside.contains(now[i])) continue;
      pixels.emplace_back(now[i].x, now[i].y);
      reference_pixels.emplace_back(points_[i].x, points_[i].y);
      cv::circle(is_free, now[i], 5, cv::Scalar(0), cv::FILLED);
    }
    if (static_cast<int>(pixels.size()) < kMost)
      cv::goodFeaturesToTrack(image, fresh, kMost - static_cast<int>(pixels.size()), 0.01, 5, is_free);
    for (const cv::Point2f& corner : fresh) {
      pixels.emplace_back(corner.x, corner.y);
      reference_pixels.emplace_back(kNaN, kNaN);
    }
    points_.clear();
    for (const Vector2f& pixel : pixels) points_.emplace_back(pixel.x(), pixel.y());
    last_ = image.clone();
  }

 private:
  cv::Mat last_;
  std::vector<cv::Point2f> points_;
};

struct Outcome {
  FilterScore score;
  int judged = 0, frames = 0;
};

template <class Policies>
Outcome run(const synthetic::Scene& scene) {
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  FrameFilter<Policies> filter(scene.camera);
  Corners corners;
  Outcome outcome;
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    corners.next(as_mat(frame.gray.view()));
    if constexpr (std::is_same_v<typename Policies::Matcher, ProvidedMatches>)
      filter.matcher.reference_pixels = corners.reference_pixels;
    const FrameResult& result = filter.filter_frame(frame.view(), corners.pixels);
    outcome.score.add_frame(frame.labels.view(), corners.pixels, result.keep());
    if (f == 0) continue;
    ++outcome.frames;
    outcome.judged += judged(result.status());
  }
  return outcome;
}

synthetic::SceneOptions small(int frames) {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frames = frames;
  options.seed = 1;
  return options;
}

TEST(ProvidedTracks, ABoxThatIsPushedIsFoundAsByThePatchSearch) {
  const synthetic::Scene scene = synthetic::pushed_box(small(60));
  const Outcome tracks = run<OnTracks>(scene), patches = run<DefaultPolicies>(scene);
  EXPECT_EQ(tracks.judged, tracks.frames);
  ASSERT_GT(tracks.score.moving().features, 1000u);
  EXPECT_GE(*tracks.score.recall(), *patches.score.recall() - 0.02);
  EXPECT_LE(*tracks.score.false_alarms(), *patches.score.false_alarms() + 0.01);
}

TEST(ProvidedTracks, AStaticRoomIsKept) {
  const Outcome tracks = run<OnTracks>(synthetic::static_room(small(30)));
  EXPECT_EQ(tracks.judged, tracks.frames);
  ASSERT_GT(tracks.score.background().features, 5000u);
  EXPECT_LE(*tracks.score.false_alarms(), 0.02);
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

  /// Share of the mover's key points that a frame drops, and of all others.
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
}  // namespace stillpoint
