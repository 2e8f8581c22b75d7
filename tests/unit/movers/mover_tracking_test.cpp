// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Whole scenes: who crosses, who is covered, what is pushed, and that nothing moves in a static room.

#include "stillpoint/movers/mover_tracking.hpp"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/mover_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "stillpoint/pipeline/stage_fit.hpp"
#include "stillpoint/policies/monocular_policies.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/counted_allocations.hpp"

namespace stillpoint::mover_tracking_test {
namespace {

static_assert(is_movers<MoverTracking, Camera>::value);
static_assert(is_movers<NoMovers, Camera>::value);
static_assert(!is_movers<Camera, Camera>::value);
static_assert(std::is_same_v<MoversOf<DefaultPolicies>, NoMovers>);
static_assert(std::is_same_v<MoversOf<WithMovers<>>, MoverTracking>);
static_assert(fit_together(NeedsOf<WithMovers<DefaultPolicies>>{}));
static_assert(!fit_together(NeedsOf<WithMovers<MonocularPolicies>>{}), "one camera without depth knows no metres");

synthetic::SceneOptions vga(int frames) {
  synthetic::SceneOptions options;
  options.frames = frames;
  options.seed = 1;
  return options;
}
synthetic::SceneOptions small(int frames) {
  synthetic::SceneOptions options = vga(frames);
  options.width = 320;
  options.height = 240;
  return options;
}

/// A filter over a scene; what it says of the movers is scored.
struct SceneRun {
  struct Host {
    cv::Mat gray, depth;
    double depth_factor, time_s;
    std::vector<cv::KeyPoint> keypoints;
  };

  explicit SceneRun(const synthetic::Scene& scene) : score(scene.movers.size()), filter(scene.camera) {
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    const auto orb = cv::ORB::create(1000);
    std::vector<std::int32_t> object_of;
    std::vector<TrueObject> objects;
    for (int f = 0; f < sequence.size(); ++f) {
      sequence.render(f, frame);
      frames.push_back({as_mat(frame.gray.view()).clone(),
                        as_mat(frame.depth.view()).clone(),
                        frame.depth_factor,
                        frame.timestamp_s,
                        {}});
      std::vector<cv::KeyPoint>& keypoints = frames.back().keypoints;
      orb->detect(frames.back().gray, keypoints);
      objects.clear();
      object_of.clear();
      for (const Pose& pose : frame.world_from_mover) objects.push_back({pose, 0});
      for (const cv::KeyPoint& keypoint : keypoints) {
        const int u = cvRound(keypoint.pt.x), v = cvRound(keypoint.pt.y);
        object_of.push_back(static_cast<int>(frame.mover_ids.view().row<std::uint8_t>(v)[u]) - 1);
        if (object_of.back() >= 0 && frame.labels.view().row<std::uint8_t>(v)[u] == synthetic::kMoving)
          ++objects[static_cast<std::size_t>(object_of.back())].moving_features;
      }
      const FrameResult& result = look(frames.back());
      score.add_frame(frame.timestamp_s, frame.world_from_camera, objects, object_of, result);
      expect_consistent(result);
      places.push_back(places_of(result));
    }
  }

  /// The same frames again, after a reset: the same answers, without any allocation.
  void repeat() {
    filter.reset();
    std::size_t allocated = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const FrameResult* result = nullptr;
      allocated += counted_allocations::count_in([&] { result = &look(frames[f]); });
      EXPECT_EQ(places_of(*result), places[f]) << "frame " << f;
    }
    EXPECT_EQ(allocated, 0u);
  }

  const FrameResult& look(const Host& host) {
    return filter.filter_frame(FrameView(host.gray, DepthView(host.depth, host.depth_factor), host.time_s),
                               host.keypoints);
  }

  static std::vector<double> places_of(const FrameResult& result) {
    std::vector<double> places;
    for (const Mover& mover : result.movers())
      for (const double value : {mover.centroid.x(), mover.centroid.y(), mover.centroid.z(), mover.velocity.x()})
        places.push_back(value);
    return places;
  }

  /// `mover(i)`, `features(mover)` and `movers()` say the same.
  static void expect_consistent(const FrameResult& result) {
    std::size_t with_mover = 0, listed = 0;
    for (std::size_t i = 0; i < result.size(); ++i) with_mover += result.mover(i) != nullptr;
    std::uint32_t last_id = 0;
    for (const Mover& mover : result.movers()) {
      EXPECT_GT(mover.id, last_id);
      last_id = mover.id;
      for (const std::uint32_t i : result.features(mover)) EXPECT_EQ(result.mover(i), &mover);
      listed += result.features(mover).size();
      EXPECT_TRUE(mover.state != MoverState::lost || result.features(mover).empty());
      EXPECT_TRUE(mover.centroid.allFinite() && mover.velocity.allFinite());
    }
    EXPECT_EQ(with_mover, listed);
  }

  MoverScore score;
  FrameFilter<WithMovers<>> filter;
  std::vector<Host> frames;
  std::vector<std::vector<double>> places;
};

double median(const std::vector<double>& values) { return error_statistics(values).median; }

// They cross in the first 70 frames, and stop at once after 75: what stands then is still of who walked.
TEST(MoverTracking, TwoPeopleWhoCrossKeepTheirIdentifiers) {
  const SceneRun run(synthetic::crossing_people(vga(100)));
  for (const std::size_t person : {0u, 1u}) {
    const MoverFigures figures = run.score.figures(person);
    EXPECT_GE(figures.frames, 40u);
    EXPECT_EQ(figures.switches, 0u) << "person " << person;
    EXPECT_GE(*figures.found_share(), 0.85) << "person " << person;
    EXPECT_LE(median(figures.speed_m_s), 0.1) << "person " << person;
    if (person == 0) {
      EXPECT_LE(median(figures.carried_m), 0.05) << "limbs that swing are no turn of the body";
    }
  }
}

TEST(MoverTracking, TwoPeopleWhoCrossInASmallImageKeepTheirIdentifiers) {
  for (std::uint64_t seed = 2; seed <= 4; ++seed) {
    synthetic::SceneOptions options = small(100);
    options.seed = seed;
    const SceneRun run(synthetic::crossing_people(options));
    for (const std::size_t person : {0u, 1u}) {
      const MoverFigures figures = run.score.figures(person);
      EXPECT_EQ(figures.switches, 0u) << "seed " << seed << ", person " << person;
      EXPECT_GE(*figures.found_share(), 0.7) << "seed " << seed << ", person " << person;
    }
  }
}

TEST(MoverTracking, WhoIsCoveredForHalfASecondKeepsHisIdentifier) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    synthetic::SceneOptions options = small(70);
    options.seed = seed;
    SceneRun run(synthetic::person_behind_pillar(options));
    const MoverFigures figures = run.score.figures(0);
    EXPECT_LE(figures.frames, 65u) << "he is covered for some frames";
    EXPECT_GE(figures.found, 20u) << "seed " << seed;
    EXPECT_EQ(figures.switches, 0u) << "seed " << seed;
    if (seed == 1) run.repeat();
  }
}

TEST(MoverTracking, APushedBoxIsCarriedWithinThreeDegreesAndFiveCentimetresASecond) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    synthetic::SceneOptions options = small(75);  // the first slide with its turn
    options.seed = seed;
    const SceneRun run(synthetic::pushed_box(options));
    const MoverFigures figures = run.score.figures(0);
    EXPECT_EQ(figures.switches, 0u) << "seed " << seed;
    EXPECT_GE(*figures.found_share(), 0.8) << "seed " << seed;
    ASSERT_GE(figures.carried_m.size(), 10u) << "seed " << seed;
    EXPECT_LE(median(figures.carried_deg), 3.0) << "seed " << seed;
    EXPECT_LE(median(figures.carried_m), 0.05) << "seed " << seed;
    EXPECT_LE(median(figures.speed_m_s), 0.1) << "seed " << seed;
  }
}

/// A person walks by while the camera swings to the right by 0.45 rad in a third of a second.
struct Swing {
  /// @param unseen  in so many frames of the swing the lens is covered
  explicit Swing(int unseen) {
    synthetic::Scene scene = synthetic::crossing_people(vga(42));
    scene.movers.erase(scene.movers.begin());
    const Vector3d place = scene.camera_path.world_from_camera(0.0).translation();
    scene.camera_path = {synthetic::Path({{0.0, place, 0.10, -0.19, 0},
                                          {0.93, place, 0.10, -0.19, 0},
                                          {1.27, place, 0.55, -0.19, 0},
                                          {3, place, 0.55, -0.19, 0}},
                                         synthetic::Blend::eased),
                         {}};
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    FrameFilter<WithMovers<>> filter(scene.camera);
    const auto orb = cv::ORB::create(800);
    const cv::Mat covered(scene.camera.height(), scene.camera.width(), CV_8UC1, cv::Scalar(60));
    constexpr int kMiddle = 33;
    const int first = kMiddle - unseen / 2, last = first + unseen - 1;
    for (int f = 0; f <= last + 2; ++f) {  // the first behind them has nothing to be compared with
      sequence.render(f, frame);
      const bool is_covered = f >= first && f <= last;
      const cv::Mat gray = is_covered ? covered : as_mat(frame.gray.view());
      std::vector<cv::KeyPoint> keypoints;
      orb->detect(gray, keypoints);
      const FrameResult& result = filter.filter_frame({gray, frame.view().depth, frame.timestamp_s}, keypoints);
      if (f != first - 1 && f != last + 2) continue;
      std::vector<Mover>& movers = f < first ? before : after;
      movers.assign(result.movers().begin(), result.movers().end());
    }
  }

  std::vector<Mover> before, after;  ///< the covered frames
};

TEST(MoverTracking, AFrameOrTwoThatAreNotJudgedEndNoIdentifier) {
  const Swing swing(2);
  ASSERT_FALSE(swing.before.empty());
  const std::uint32_t id = swing.before[0].id;
  EXPECT_TRUE(std::any_of(swing.after.begin(), swing.after.end(), [&](const Mover& mover) { return mover.id == id; }));
}

// Where the camera looks after eleven nobody knows: what was told before lay 1.4 m beside the person, on a wall.
TEST(MoverTracking, AfterManyFramesThatAreNotJudgedNobodyKnowsWhereAnObjectIs) {
  const Swing swing(11);
  EXPECT_FALSE(swing.before.empty());
  EXPECT_TRUE(swing.after.empty());
}

TEST(MoverTracking, NothingMovesInAStaticRoom) {
  const SceneRun run(synthetic::static_room(small(40)));
  EXPECT_EQ(run.score.frames(), 39u);
  EXPECT_EQ(run.score.frames_with_movers(), 0u);
}

}  // namespace
}  // namespace stillpoint::mover_tracking_test
