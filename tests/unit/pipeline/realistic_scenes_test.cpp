// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies without a detector on synthetic scenes with the difficulties of recordings: a depth sensor with
// shadows, flying pixels, holes and a delay, few frames per second, static objects beside what moves, a slow mover, a
// car.
//
// Figures are sums over several seeds. 1000 ORB features.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <opencv2/core.hpp>
#include <optional>
#include <ostream>
#include <vector>

#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/stereo/stereo_depth.hpp"
#include "stillpoint/synthetic/realistic_scenes.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/stereo.hpp"
#include "stillpoint/synthetic/street.hpp"
#include "stillpoint/synthetic/truth.hpp"
#include "unit/pipeline/scene_run.hpp"

namespace stillpoint::realistic_scenes_test {
namespace {

// Ten times as slow under the sanitizers. The limits are for the mean of the three: the first alone has 1.8 % of the
// books.
#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kSeeds[] = {2};
#else
constexpr std::uint64_t kSeeds[] = {1, 2, 3};
#endif
constexpr double kBend_m = 23.0;  // 2.5 degrees per frame, as in a bend that KITTI recorded

using scene_run::small;

/// Half of KITTI's size, or all of it.
synthetic::SceneOptions car(int frames, std::uint64_t seed, bool has_full_size) {
  synthetic::SceneOptions options = synthetic::car_options();
  options.width = has_full_size ? 1240 : 620;
  options.height = has_full_size ? 376 : 188;
  options.frames = frames;
  options.seed = seed;
  return options;
}

std::vector<Vector2f> corners(const SyntheticFrame& frame) { return scene_run::orb_corners(frame, 1000); }

/// Features of some runs, by what is there.
struct Outcome {
  DropCount moving, background, books;
  DropCount moving_in_last_frames;  ///< of each run
  int judged = 0, frames = 0;
};

void add(const DropCount& count, DropCount& sum) {
  sum.features += count.features;
  sum.dropped += count.dropped;
}

std::ostream& operator<<(std::ostream& out, const DropCount& count) {
  return out << count.dropped << " of " << count.features << " (" << count.share().value_or(0.0) << ")";
}
std::ostream& operator<<(std::ostream& out, const Outcome& outcome) {
  return out << "moving " << outcome.moving << ", background " << outcome.background << ", books " << outcome.books
             << ", moving in last frames " << outcome.moving_in_last_frames << ", judged " << outcome.judged << " of "
             << outcome.frames;
}

enum class DepthFrom { sensor, block_matching };

/// The depth that `StereoDepth` finds in the images of a car's two cameras.
class CarStereo {
 public:
  explicit CarStereo(const synthetic::Scene& scene)
      : right_sequence_(synthetic::right_of(scene, synthetic::kCarBaseline_m)),
        stereo_(scene.camera, synthetic::kCarBaseline_m, options()) {}

  const cv::Mat& depth_m(const SyntheticFrame& left) {
    right_sequence_.render(left.index, right_);
    stereo_.compute(as_mat(left.gray.view()), as_mat(right_.gray.view()), depth_m_);
    return depth_m_;
  }

 private:
  static StereoDepth::Options options() {
    StereoDepth::Options options;
    options.nearest_m = 4.0;
    return options;
  }

  SyntheticSequence right_sequence_;
  StereoDepth stereo_;
  SyntheticFrame right_;
  cv::Mat depth_m_;
};

/// Runs a new filter over a scene.
void run(const synthetic::Scene& scene, Outcome& outcome, DepthFrom depth_from = DepthFrom::sensor) {
  SyntheticSequence sequence(scene);
  std::optional<CarStereo> stereo;
  if (depth_from == DepthFrom::block_matching) stereo.emplace(scene);
  FrameFilter<> filter(scene.camera);
  if (scene.sensor.stereo_noise) filter.depth_noise = *scene.sensor.stereo_noise;
  SyntheticFrame frame;
  ImageBuffer book_labels;
  FilterScore score, book_score;
  DropCount moving_before;
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    const FrameView view =
        stereo ? FrameView(frame.gray.view(), stereo->depth_m(frame), frame.timestamp_s) : frame.view();
    const std::vector<Vector2f> pixels = corners(frame);
    const FrameResult& result = filter.filter_frame(view, pixels);
    moving_before = score.moving();
    score.add_frame(frame.labels.view(), pixels, result.keep());
    synthetic::labels_of(scene, synthetic::kBook, frame, book_labels);
    book_score.add_frame(book_labels.view(), pixels, result.keep());
    if (f == 0) continue;
    ++outcome.frames;
    outcome.judged += judged(result.status());
  }
  add(score.moving(), outcome.moving);
  add(score.background(), outcome.background);
  add(book_score.background(), outcome.books);
  add({score.moving().features - moving_before.features, score.moving().dropped - moving_before.dropped},
      outcome.moving_in_last_frames);
}

Outcome five_people() {
  Outcome outcome;
  for (const std::uint64_t seed : kSeeds) {
    synthetic::SceneOptions options = small(40, seed);
    options.frame_rate_hz = 5.0;
    run(synthetic::five_people(options), outcome);
  }
  return outcome;
}

// Measured: recall 0.980, false-positive rate 0.011.
TEST(RealisticScenes, FivePeopleAtFiveHertzAreFound) {
  const Outcome outcome = five_people();
  ASSERT_GT(outcome.moving.features, 8000 * std::size(kSeeds));
  EXPECT_GE(outcome.moving.share(), 0.95) << outcome;
  EXPECT_LE(outcome.background.share(), 0.02) << outcome;
}

// Measured: books 0.013; 0.019 where what the box has uncovered counts as changed.
TEST(RealisticScenes, ABoxAmongBooksIsFoundAndTheBooksAreKept) {
  Outcome outcome;
  for (const std::uint64_t seed : kSeeds) run(synthetic::box_among_books(small(50, seed)), outcome);
  ASSERT_GT(outcome.moving.features, 6000 * std::size(kSeeds));
  ASSERT_GT(outcome.books.features, 12000 * std::size(kSeeds));
  EXPECT_EQ(outcome.judged, outcome.frames);
  EXPECT_GE(outcome.moving.share(), 0.95) << outcome;
  EXPECT_LE(outcome.background.share(), 0.02) << outcome;
  EXPECT_LE(outcome.books.share(), 0.015) << outcome;
}

// The last frame is 0.4 s after the first step.
TEST(RealisticScenes, HalfOfAPersonAtATenthOfAMetrePerSecondIsDroppedWithinFourTenthsOfASecond) {
  constexpr int kFirstStep = 31, kFrames = kFirstStep + 12 + 1;
  Outcome outcome;
  for (const std::uint64_t seed : kSeeds) {
    const synthetic::Scene scene = synthetic::slow_walker(small(kFrames, seed));
    ASSERT_EQ(synthetic::first_moving_frame(scene, 0), kFirstStep);
    run(scene, outcome);
  }
  ASSERT_GT(outcome.moving_in_last_frames.features, 100 * std::size(kSeeds));
  EXPECT_GE(outcome.moving_in_last_frames.share(), 0.5) << outcome;
  EXPECT_LE(outcome.background.share(), 0.02) << outcome;
}

TEST(RealisticScenes, ACarOnAStraightStreetDoesNoHarm) {
  for (const DepthFrom depth_from : {DepthFrom::sensor, DepthFrom::block_matching}) {
    Outcome outcome;
    run(synthetic::street_from_car(car(30, 1, false)), outcome, depth_from);
    EXPECT_EQ(outcome.judged, outcome.frames);
    ASSERT_GT(outcome.background.features, 20000u);
    EXPECT_LE(outcome.background.share(), 0.015) << outcome;
  }
}

TEST(RealisticScenes, ACarInABendDoesNoHarm) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the full-sized images take minutes; the straight street runs";
#endif
  Outcome measured, matched;
  run(synthetic::street_from_car(car(20, 1, true), kBend_m), measured);
  run(synthetic::street_from_car(car(30, 1, false), kBend_m), matched, DepthFrom::block_matching);
  for (const Outcome* outcome : {&measured, &matched}) {
    EXPECT_EQ(outcome->judged, outcome->frames);
    ASSERT_GT(outcome->background.features, 18000u);
    EXPECT_LE(outcome->background.share(), 0.015) << *outcome;
  }
}

}  // namespace
}  // namespace stillpoint::realistic_scenes_test
