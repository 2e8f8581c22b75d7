// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A camera that comes round again, past people who walk: what a loop mends, and what the map keeps.

#include <gtest/gtest.h>
#include <stillpoint/compiled.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "slam_run.hpp"
#include "stillpoint/null_filter.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace slam_circuit_test {
namespace {

constexpr int kPerRound = 100;
constexpr double kTurn_rad = 2 * 3.14159265358979;

/// Looks around from a circle of 0.3 m in the middle of the room, a round in ten seconds.
stillpoint::synthetic::Scene circuit(int rounds) {
  stillpoint::synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frame_rate_hz = slam_run::kSlamRate_hz;
  options.frames = rounds * kPerRound;
  stillpoint::synthetic::Scene scene = stillpoint::synthetic::walking_people(options);
  constexpr int kKeys = 8;
  std::vector<stillpoint::synthetic::Waypoint> keys;
  for (int k = -1; k <= rounds * kKeys + 1; ++k) {
    const double angle = kTurn_rad * k / kKeys;
    keys.push_back({kPerRound / slam_run::kSlamRate_hz * k / kKeys,
                    {0.3 * std::sin(angle), -1.42, 0.5 + 0.3 * std::cos(angle)},
                    angle,
                    -0.19,
                    0.0});
  }
  scene.camera_path = {stillpoint::synthetic::Path(keys, stillpoint::synthetic::Blend::spline), {}};
  return scene;
}

double mean(const std::vector<double>& values, std::size_t first, std::size_t count) {
  double sum = 0;
  for (std::size_t i = first; i < first + count; ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

// Both people stand still when the camera comes round again, elsewhere than at first. Three quarters of a drift of 8 mm
// and more; below, as exactly as then: a loop is measured to 2 mm in images of 320 pixels, however small the drift.
TEST(Circuit, TheLoopTakesTheDrift) {
  const stillpoint::synthetic::Scene scene = circuit(2);
  slam_run::SlamRun run(scene.camera, stillpoint::FrameFilter<stillpoint::CompiledPolicies>(scene.camera));
  std::vector<double> error_m;
  std::size_t closed_at = 0;
  for (const slam_run::RenderedFrame& frame : slam_run::rendered(scene)) {
    error_m.push_back(run.track(frame));
    ASSERT_FALSE(std::isnan(error_m.back())) << "frame " << error_m.size() - 1;
    if (closed_at == 0 && !run.loops().empty()) closed_at = error_m.size() - 1;
  }
  ASSERT_EQ(run.loops().size(), 1u) << "one place is seen again, and no other looks like it";
  EXPECT_GE(closed_at, kPerRound - 10u) << "the view of 62 degrees begins to show what the first frame showed";
  EXPECT_LE(closed_at, kPerRound + 10u);
  constexpr std::size_t kFrames = 10;
  const double before_m = mean(error_m, closed_at - kFrames, kFrames), after_m = mean(error_m, closed_at + 3, kFrames);
  EXPECT_LT(after_m, std::max(0.002, 0.25 * before_m)) << before_m;
  EXPECT_LT(after_m, 0.5 * before_m);
  for (std::size_t i = closed_at; i < error_m.size(); ++i) EXPECT_LT(error_m[i], 0.015) << "frame " << i;
}

struct Size {
  std::size_t keyframes, points, described, resident_kb;
};

std::size_t resident_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      std::size_t kb = 0;
      status >> kb;
      return kb;
    }
  return 0;
}

/// The map after each of some rounds past what stands still. A round is rendered once: the noise of its images repeats.
std::vector<Size> sizes_after(int rounds) {
  stillpoint::synthetic::Scene scene = circuit(1);
  scene.movers.clear();
  const std::vector<slam_run::RenderedFrame> frames = slam_run::rendered(scene);
  slam_run::SlamRun run(scene.camera, stillpoint::NullFilter());
  std::vector<Size> sizes;
  for (int round = 0; round < rounds; ++round) {
    for (const slam_run::RenderedFrame& frame : frames) EXPECT_LT(run.track(frame), 0.03) << "frame " << run.count - 1;
    sizes.push_back({run.map().keyframes().size(), run.map().point_count(),
                     run.tracker.backend.keeper().loop_closing.index.size(), resident_kb()});
    std::printf("round %d: %zu keyframes, %zu points, %zu descriptors, %zu MB\n", round, sizes.back().keyframes,
                sizes.back().points, sizes.back().described, sizes.back().resident_kb / 1024);
  }
  return sizes;
}

void expect_bounded(const std::vector<Size>& sizes, std::size_t settled) {
  const Size &first = sizes[settled], &last = sizes.back();
  EXPECT_LE(last.keyframes, first.keyframes + first.keyframes / 10);
  EXPECT_LE(last.points, first.points + first.points / 10);
  EXPECT_LE(last.described, first.described + first.described / 10);
  EXPECT_LE(last.resident_kb, first.resident_kb + first.resident_kb / 10);
}

TEST(Circuit, TheMapGrowsByTheAreaNotByTime) { expect_bounded(sizes_after(4), 2); }

// Ten minutes, by hand: --gtest_also_run_disabled_tests --gtest_filter='Circuit.*Ten*'.
TEST(Circuit, DISABLED_TenThousandFramesAreNoMoreThanFiveHundred) { expect_bounded(sizes_after(100), 4); }

}  // namespace
}  // namespace slam_circuit_test
