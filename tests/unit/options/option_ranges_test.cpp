// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every option has a range. Within it nothing crashes, hangs or fills the memory; beyond it no frame is judged.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "stillpoint/core/options.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "unit/pipeline/clip.hpp"

namespace stillpoint {
namespace {

using mock::Clip;

enum class Place { below, least, most, beyond };

/// Sets one option, the n-th of those with a range, to an end of its range or beyond it.
struct SetOne {
  using SeesCodeOnly = void;

  std::size_t wanted;
  Place place;
  std::size_t count = 0;
  std::string name = {}, path = {};

  template <class T>
  void operator()(const char* option, T& value, const OptionRange& range) {
    if (count++ != wanted) return;
    name = path + option;
    if (place == Place::least) value = static_cast<T>(range.least);
    if (place == Place::most) value = static_cast<T>(range.most);
    if (place == Place::below) value = std::is_unsigned_v<T> ? std::numeric_limits<T>::max() : lower(value, range);
    if (place == Place::beyond) value = std::numeric_limits<T>::max();
  }
  template <class T>
  void operator()(const char* group, T& value) {
    if constexpr (has_options<T, SetOne>::value) {
      const std::string outer = path;
      path += std::string(group) + '.';
      each_option(value, *this);
      path = outer;
    }
  }
  template <class T>
  void seed(const char*, T&) {}
  template <class T, class... Words>
  void choice(const char*, T&, Words...) {}

 private:
  template <class T>
  static T lower(T, const OptionRange& range) {
    if (std::is_floating_point_v<T>) return std::numeric_limits<T>::quiet_NaN();
    return static_cast<T>(range.least - 1);
  }
};

struct TrackPolicies : DefaultPolicies {
  using Matcher = ProvidedMatches;
};
struct StereoPolicies : DefaultPolicies {
  using DepthNoise = StereoNoise;
};
struct TimeOfFlightPolicies : DefaultPolicies {
  struct DepthNoise : AnyDepthNoise {
    DepthNoise() : AnyDepthNoise(TimeOfFlightNoise{}) {}
  };
};

template <class Policies>
class OptionRanges : public testing::Test {
 protected:
  using Filter = FrameFilter<Policies>;

  const FrameResult& judge(Filter& filter, std::size_t frame) const {
    const Clip::Frame& seen = clip.frames[frame];
    filter.prior.detections = clip.detections;
    if constexpr (std::is_same_v<Policies, TrackPolicies>)
      filter.matcher.reference_pixels = frame == 0 ? std::vector<Vector2f>() : seen.reference_pixels;
    return filter.filter_frame(seen.view(), seen.keypoints);
  }

  /// Calls `action(place_in_the_list, name)` for every option with a range.
  template <class Action>
  void each(Place place, const Action& action) const {
    for (std::size_t i = 0;; ++i) {
      Filter filter(Clip::camera());
      SetOne set{i, place};
      each_option(filter, set);
      if (set.name.empty()) {
        ASSERT_GE(i, 15u);
        return;
      }
      action(i, set.name);
    }
  }

  Clip clip{3, 5};
};

using RangedSets =
    testing::Types<WithMovers<DefaultPolicies>, TrackPolicies, PaperPolicies, PaperRigidPolicies, MonocularPolicies>;
TYPED_TEST_SUITE(OptionRanges, RangedSets);

// From the first frame on, and set between two frames.
TYPED_TEST(OptionRanges, BothEndsOfEachAreSafe) {
  for (const Place place : {Place::least, Place::most}) {
    this->each(place, [&](std::size_t option, const std::string& name) {
      const std::clock_t started = std::clock();  // processor time: the machine may be busy
      for (const std::size_t set_before : {0u, 3u}) {
        FrameFilter<TypeParam> filter(Clip::camera());
        ImageBuffer mask;
        for (std::size_t f = 0; f < this->clip.frames.size(); ++f) {
          SetOne set{option, place};
          if (f == set_before) each_option(filter, set);
          ASSERT_EQ(filter.options_error(), "") << name;
          const FrameResult& result = this->judge(filter, f);
          ASSERT_NE(result.status(), Status::invalid_options) << name;
          ASSERT_TRUE(result.motion().current_from_reference.matrix().allFinite()) << name;
          filter.predicted_keep_mask(this->clip.frames[f].time_s + 0.1, 12, mask);
          ASSERT_EQ(mask.view().width, Clip::kWidth);
        }
      }
      const double taken_s = static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC;
      EXPECT_LT(taken_s, 60.0) << name;
    });
  }
  rusage usage{};
  ASSERT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(usage.ru_maxrss, 1500000) << "kilobytes";
#endif
}

// A frame is kept whole, the message names the option, and the filter goes on where it was once it is mended.
TYPED_TEST(OptionRanges, BeyondThemNoFrameIsJudged) {
  for (const Place place : {Place::below, Place::beyond}) {
    this->each(place, [&](std::size_t option, const std::string& name) {
      FrameFilter<TypeParam> filter(Clip::camera());
      this->judge(filter, 0);
      SetOne set{option, place};
      each_option(filter, set);
      EXPECT_EQ(filter.options_error().rfind(name + " is ", 0), 0u) << filter.options_error();
      EXPECT_NE(filter.options_error().find(", expected a "), std::string::npos) << filter.options_error();
      const FrameResult& result = this->judge(filter, 1);
      EXPECT_EQ(result.status(), Status::invalid_options) << name;
      EXPECT_EQ(result.motion().status, Status::invalid_options);
      EXPECT_EQ(result.kept_count(), this->clip.frames[1].keypoints.size());
      ImageBuffer mask;
      filter.predicted_keep_mask(this->clip.frames[2].time_s, std::numeric_limits<int>::max(), mask);
      EXPECT_EQ(mask.row<std::uint8_t>(60)[80], 255);
    });
  }
}

template <class Policies>
class DepthNoiseRanges : public OptionRanges<Policies> {};
using NoiseSets = testing::Types<StereoPolicies, TimeOfFlightPolicies>;
TYPED_TEST_SUITE(DepthNoiseRanges, NoiseSets);

TYPED_TEST(DepthNoiseRanges, BothEndsOfEachAreSafe) {
  for (const Place place : {Place::least, Place::most}) {
    int options = 0;
    this->each(place, [&](std::size_t option, const std::string& name) {
      if (name.rfind("depth_noise.", 0) != 0) return;
      ++options;
      FrameFilter<TypeParam> beyond(Clip::camera());
      SetOne set_beyond{option, Place::beyond};
      each_option(beyond, set_beyond);
      EXPECT_EQ(beyond.options_error().rfind(name + " is ", 0), 0u) << beyond.options_error();
      FrameFilter<TypeParam> filter(Clip::camera());
      SetOne set{option, place};
      each_option(filter, set);
      for (std::size_t f = 0; f < this->clip.frames.size(); ++f)
        EXPECT_TRUE(this->judge(filter, f).motion().current_from_reference.matrix().allFinite()) << name;
    });
    EXPECT_EQ(options, 3) << "its two or three parameters; of any model, the scale";
  }
}

TEST(InvalidOptions, AreMendedBetweenFrames) {
  const Clip clip(3, 3);
  FrameFilter<PaperPolicies> filter(Clip::camera());
  const auto judge = [&](std::size_t f) {
    return filter.filter_frame(clip.frames[f].view(), clip.frames[f].keypoints).status();
  };
  EXPECT_EQ(judge(0), Status::first_frame);
  filter.matcher.options.pyramid_levels = 1000;
  EXPECT_EQ(judge(1), Status::invalid_options);
  EXPECT_EQ(filter.options_error(), "matcher.pyramid_levels is 1000, expected a whole number from 0 to 16");
  filter.matcher.options.pyramid_levels = 2;
  EXPECT_TRUE(judged(judge(2)));
}

TEST(InvalidOptions, AnEnumeratorThatIsNoneIsOne) {
  FrameFilter<PaperPolicies> filter(Clip::camera());
  filter.ego_motion.options.solver = static_cast<EpipolarMotion::Solver>(7);
  EXPECT_EQ(filter.options_error(), "ego_motion.solver is 7, expected seven or eight");
}

TEST(MaskRadius, MayBeAnyNumber) {
  constexpr int kLargest = std::numeric_limits<int>::max(), kLeast = std::numeric_limits<int>::min();
  ImageBuffer mask;
  const auto dropped = [&](const Vector2f& centre, int radius_px) {
    keep_everywhere(40, 30, mask);
    drop_disc(centre, radius_px, mask);
    int count = 0;
    for (int v = 0; v < 30; ++v)
      for (int u = 0; u < 40; ++u) count += mask.row<std::uint8_t>(v)[u] == kMaskDrops;
    return count;
  };
  EXPECT_EQ(dropped({20, 15}, kLargest), 40 * 30);
  EXPECT_EQ(dropped({-1e9f, 15}, kLargest), 40 * 30);
  EXPECT_EQ(dropped({-2e9f, -2e9f}, kLargest), 0);
  EXPECT_EQ(dropped({20, 15}, kLeast), 0);
  EXPECT_EQ(dropped({20, 15}, -1), 0);
  EXPECT_EQ(dropped({20, 15}, 1), 5);
}

}  // namespace
}  // namespace stillpoint
