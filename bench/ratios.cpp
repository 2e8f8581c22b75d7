// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_ratios [FOLDER [REPETITIONS [FRAMES]]]: our time beside OpenCV's for the same task, as a ratio.
//
// Pairs are run in turn, ours, theirs, ours, theirs ..., so that both meet the same load of the machine; what counts is
// the processor time of the thread. Each item (a frame, a scene) has the median of its repetitions, and a line the mean
// over the items. Lines that begin with # say on what, and how exact both are.

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clip.hpp"
#include "filter_run.hpp"
#include "host_tracks.hpp"
#include "pairs.hpp"
#include "quantiles.hpp"
#include "stillpoint/core/error.hpp"
#include "thread_time.hpp"
#include "two_views.hpp"

namespace stillpoint::bench {
namespace {

struct Settings {
  std::filesystem::path folder;
  int repetitions = 5;
  std::size_t frames = 60;
};

template <class Function>
double time_ms(Function&& function) {
  const double start_ms = thread_ms();
  function();
  return thread_ms() - start_ms;
}

/// Times of one side: for each item those of all repetitions.
class Times {
 public:
  explicit Times(std::size_t items) : ms_(items) {}
  void add(std::size_t item, double ms) { ms_[item].push_back(ms); }

  /// Mean over the items of the median of each.
  double mean_ms() const {
    double sum = 0;
    for (const std::vector<double>& repetitions : ms_) sum += median(repetitions);
    return sum / static_cast<double>(ms_.size());
  }

 private:
  std::vector<std::vector<double>> ms_;
};

void print(const char* name, const Times& ours, const Times& theirs) {
  const double ours_ms = ours.mean_ms(), theirs_ms = theirs.mean_ms();
  std::printf("%-40s %9.4f %9.4f %7.3f\n", name, ours_ms, theirs_ms, ours_ms / theirs_ms);
  std::fflush(stdout);
}

/// Runs both sides of each pair in turn. One run that does not count warms up.
template <class Pair>
void compare(const char* name, std::deque<Pair>& pairs, int repetitions) {
  Times ours(pairs.size()), theirs(pairs.size());
  for (int r = -1; r < repetitions; ++r) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double ours_ms = time_ms([&] { pairs[i].ours(); });
      const double theirs_ms = time_ms([&] { pairs[i].theirs(); });
      if (r < 0) continue;
      ours.add(i, ours_ms);
      theirs.add(i, theirs_ms);
    }
  }
  print(name, ours, theirs);
}

/// Medians over the scenes, both sides.
template <class Pair>
void print_errors(const std::deque<Pair>& pairs, bool metric) {
  std::vector<double> ours_deg, theirs_deg, ours_way, theirs_way;
  for (const Pair& pair : pairs) {
    const PoseError ours = pair.our_error(), theirs = pair.their_error();
    ours_deg.push_back(ours.rotation_deg);
    theirs_deg.push_back(theirs.rotation_deg);
    ours_way.push_back(metric ? 1e3 * ours.translation_m : ours.direction_deg);
    theirs_way.push_back(metric ? 1e3 * theirs.translation_m : theirs.direction_deg);
  }
  std::printf("#   median error: rotation %.4f deg, theirs %.4f; translation %.3f %s, theirs %.3f\n", median(ours_deg),
              median(theirs_deg), median(ours_way), metric ? "mm" : "deg (direction)", median(theirs_way));
}

/// @param prefix  of the lines' names
template <class Policies>
void measure_filter(const Clip& clip, int repetitions, const std::string& prefix) {
  const std::size_t frames = clip.frames.size();
  FilterRun<Policies> run(clip);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  Times ours(frames - 1), theirs(frames - 1), rest(frames - 1), whole(frames - 1);
  std::size_t judged_frames = 0;
  for (int r = -1; r < repetitions; ++r) {
    run.begin();
    judged_frames = 0;
    for (std::size_t i = 1; i < frames; ++i) {
      const FrameResult* result = nullptr;
      // Stages are timed by the filter itself, with a clock on the wall: so is the whole to which they are compared.
      const auto start = std::chrono::steady_clock::now();
      const double ours_ms = time_ms([&] { result = &run.filter(i); });
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
      const Timings timings = result->timings();
      judged_frames += judged(result->status());
      const double theirs_ms =
          time_ms([&] { orb->detectAndCompute(clip.frames[i].gray, cv::noArray(), keypoints, descriptors); });
      if (r < 0) continue;
      ours.add(i - 1, ours_ms);
      theirs.add(i - 1, theirs_ms);
      whole.add(i - 1, elapsed.count());
      rest.add(i - 1, timings.total_ms() - timings[Stage::match]);
    }
  }
  print((prefix + "filter_frame_vs_orb").c_str(), ours, theirs);
  std::printf("#   %zu of %zu frames were judged\n", judged_frames, frames - 1);
  print((prefix + "stages_without_matching_vs_filter_frame").c_str(), rest, whole);
}

void measure_matching(const Clip& clip, int repetitions) {
  const std::size_t frames = clip.frames.size();
  LucasKanadePair pair(clip);
  Times ours(frames - 1), theirs(frames - 1);
  std::size_t our_matches = 0, their_matches = 0;
  for (int r = -1; r < repetitions; ++r) {
    our_matches = their_matches = 0;
    for (std::size_t i = 1; i < frames; ++i) {
      const double ours_ms = time_ms([&] { pair.ours(i); });
      const double theirs_ms = time_ms([&] { pair.theirs(i); });
      our_matches += pair.our_matches();
      their_matches += pair.their_matches(i);
      if (r < 0) continue;
      ours.add(i - 1, ours_ms);
      theirs.add(i - 1, theirs_ms);
    }
  }
  print("lucas_kanade_vs_opencv", ours, theirs);
  std::printf("#   matches a frame: %zu, theirs %zu\n", our_matches / (frames - 1), their_matches / (frames - 1));
}

void measure_clustering(int repetitions) {
  std::deque<KMeansPair> pairs;   // a deque, as pairs can't be moved
  pairs.emplace_back(1000, 100);  // k = m / 10, as the classifier has it
  compare("kmeans_vs_opencv", pairs, repetitions);
  std::printf("#   1000 points, 100 clusters, %d iterations; cost J %.6f, theirs %.6f\n", pairs[0].iterations(),
              pairs[0].our_cost(), pairs[0].their_cost());
}

void measure_motion(int repetitions) {
  constexpr std::size_t kScenes = 40;
  constexpr double kThreshold_px = 1.5;  // three times the noise
  const std::vector<TwoViews> scenes = make_two_views({}, kScenes);
  std::deque<EpipolarPair> epipolar;
  std::deque<RigidPair> rigid;
  for (const TwoViews& scene : scenes) {
    epipolar.emplace_back(scene, kThreshold_px);
    rigid.emplace_back(scene);
  }
  std::printf("# motion: %zu scenes of 1000 points, 40 %% outliers, noise 0.5 px\n", kScenes);
  compare("epipolar_vs_usac", epipolar, repetitions);
  print_errors(epipolar, false);
  compare("rigid_vs_affine3d", rigid, repetitions);
  print_errors(rigid, true);
}

void measure(const Settings& settings) {
  const bool recorded = is_recorded_clip(settings.folder);
  const Clip clip = recorded ? recorded_clip(settings.folder, settings.frames) : synthetic_clip(settings.frames);
  if (!recorded)
    std::printf("# '%s' has no camera.yaml and boxes.txt: measuring on the synthetic scene\n",
                settings.folder.string().c_str());
  std::printf("# %s, %zu frames of %d x %d; ORB with %d features; medians of %d repetitions, CPU time of one thread\n",
              clip.name.c_str(), clip.frames.size(), clip.camera.width(), clip.camera.height(), kFeatures,
              settings.repetitions);
  std::printf("# %-38s %9s %9s %7s\n", "name", "ours_ms", "theirs_ms", "ratio");
  measure_filter<DefaultPolicies>(clip, settings.repetitions, "");
  measure_filter<TrackPolicies>(with_followed_corners(clip), settings.repetitions, "tracks_");
  measure_filter<PaperPolicies>(clip, settings.repetitions, "paper_");
  measure_matching(clip, settings.repetitions);
  measure_clustering(settings.repetitions);
  measure_motion(settings.repetitions);
}

/// @throws Error for a number that is none or too small
int number(const char* name, const char* text, int least) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (end == text || *end != '\0' || value < least || value > 100000)
    throw Error(std::string(name) + ": found '" + text + "', expected a number from " + std::to_string(least));
  return static_cast<int>(value);
}

}  // namespace
}  // namespace stillpoint::bench

int main(int argc, char** argv) {
  using namespace stillpoint::bench;
  cv::setNumThreads(1);
  try {
    Settings settings;
    settings.folder = argc > 1 ? argv[1] : STILLPOINT_SHARED_DATA "/kitchen_walk";
    if (argc > 2) settings.repetitions = number("REPETITIONS", argv[2], 1);
    if (argc > 3) settings.frames = static_cast<std::size_t>(number("FRAMES", argv[3], 2));
    measure(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_ratios: %s\n", error.what());
    return 2;
  }
  return 0;
}
