// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every adapter that compacts a host's parallel arrays runs through the same claims. A new one is one struct here.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "stillpoint/adapters/opencv_tracker.hpp"
#include "stillpoint/adapters/orb_slam.hpp"
#include "stillpoint/adapters/rtabmap.hpp"
#include "stillpoint/adapters/stella_vslam.hpp"
#include "stillpoint/adapters/vins.hpp"
#include "stillpoint/core/random.hpp"
#include "unit/adapters/look_alikes.hpp"
#include "unit/adapters/tagged_arrays.hpp"

namespace compaction_conformance_test {
namespace {

using look_alikes::Counted;
using look_alikes::Counter;
using look_alikes::Plain;
using Flags = std::vector<std::uint8_t>;
using KeepFlags = stillpoint::span<const std::uint8_t>;

// A case: the host's type, its parallel arrays, the adapter's call. `kNeverEmpty`: flags that drop all drop none.

struct OrbAfterDepth {
  template <template <class> class Element>
  using Host = look_alikes::OrbFrame<Element>;
  static constexpr bool kNeverEmpty = true;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.mvKeys, host.mvKeysUn, host.mvuRight, host.mvDepth, host.mDescriptors);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    const std::size_t kept = stillpoint::orb_slam::compact_after_depth(keep, host);
    EXPECT_EQ(host.N, static_cast<int>(kept)) << "N is set once: it must follow";
    return kept;
  }
};

struct OrbAfterExtraction {
  template <template <class> class Element>
  using Host = look_alikes::OrbFrame<Element>;
  static constexpr bool kNeverEmpty = true;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.mvKeys, host.mDescriptors);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    const std::size_t kept = stillpoint::orb_slam::compact_after_extraction(keep, host);
    EXPECT_EQ(host.N, -7) << "the host sets N itself";
    return kept;
  }
};

struct OrbMonoFirst : OrbAfterExtraction {
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    int mono_count = static_cast<int>(keep.size() / 2);
    return stillpoint::orb_slam::compact_mono_first(keep, host.mvKeys, host.mDescriptors, mono_count);
  }
};

struct StellaKeypoints {
  template <template <class> class Element>
  using Host = look_alikes::StellaObservation<Element>;
  static constexpr bool kNeverEmpty = false;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.undist_keypts_, host.descriptors_, host.bearings_, host.stereo_x_right_, host.depths_);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    std::vector<int> old_to_new;
    return stillpoint::stella_vslam::compact_observation(keep, host, old_to_new);
  }
};

struct RtabmapFeatures {
  template <template <class> class Element>
  using Host = look_alikes::RtabmapFeatures<Element>;
  static constexpr bool kNeverEmpty = false;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.keypoints, host.keypoints3D, host.descriptors);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    return stillpoint::rtabmap::compact_features(keep, host.keypoints, host.keypoints3D, host.descriptors);
  }
};

struct VinsTracks {
  template <template <class> class Element>
  using Host = look_alikes::VinsTracker<Element>;
  static constexpr bool kNeverEmpty = false;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.cur_pts, host.ids, host.track_cnt, host.prev_pts);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    return stillpoint::vins::compact_tracks(keep, host, host.prev_pts);
  }
};

struct OpenCvTracks : VinsTracks {
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    return stillpoint::opencv_tracker::compact_tracks(keep, host.prev_pts, host.cur_pts, host.ids, host.track_cnt);
  }
};

struct OpenCvFeatures {
  template <template <class> class Element>
  using Host = stillpoint::opencv_tracker::Features<Element<cv::KeyPoint>>;
  static constexpr bool kNeverEmpty = false;
  template <class H>
  static auto arrays(H& host) {
    return std::tie(host.keypoints, host.descriptors, host.ids);
  }
  template <class H>
  static std::size_t compact(KeepFlags keep, H& host) {
    host.compact(keep);
    return host.keypoints.size();
  }
};

template <class Case>
class AdapterCompaction : public testing::Test {
 protected:
  using Host = typename Case::template Host<Plain>;

  static Host filled(int count) {
    Host host;
    look_alikes::fill_all(Case::arrays(host), count);
    return host;
  }
  static bool holds(Host& host, const std::vector<int>& indices) {
    return look_alikes::all_hold(Case::arrays(host), indices);
  }
  static std::vector<int> all(int count) {
    std::vector<int> indices(static_cast<std::size_t>(count));
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
  }
};

using Cases = testing::Types<OrbAfterDepth, OrbAfterExtraction, OrbMonoFirst, StellaKeypoints, RtabmapFeatures,
                             VinsTracks, OpenCvTracks, OpenCvFeatures>;
struct CaseNames {
  template <class Case>
  static std::string GetName(int index) {
    return std::vector<std::string>{"OrbAfterDepth",   "OrbAfterExtraction", "OrbMonoFirst", "StellaKeypoints",
                                    "RtabmapFeatures", "VinsTracks",         "OpenCvTracks", "OpenCvFeatures"}
        .at(static_cast<std::size_t>(index));
  }
};
TYPED_TEST_SUITE(AdapterCompaction, Cases, CaseNames);

TYPED_TEST(AdapterCompaction, KeepsEveryArrayAlignedInOrderAndBitEqual) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    stillpoint::Random random(seed);
    const int count = 1 + static_cast<int>(random.index(600));
    const double share = random.uniform();
    Flags keep(static_cast<std::size_t>(count));
    std::vector<int> expected;
    for (int i = 0; i < count; ++i) {
      const bool kept = i == 0 || random.uniform() < share;
      keep[static_cast<std::size_t>(i)] = kept ? static_cast<std::uint8_t>(1 + random.index(255)) : 0;
      if (kept) expected.push_back(i);
    }
    auto host = this->filled(count);
    ASSERT_EQ(TypeParam::compact(keep, host), expected.size());
    ASSERT_TRUE(this->holds(host, expected)) << "seed " << seed;
  }
}

TYPED_TEST(AdapterCompaction, NothingToDropChangesNothing) {
  auto host = this->filled(9);
  EXPECT_EQ(TypeParam::compact(Flags(9, 1), host), 9u);
  EXPECT_TRUE(this->holds(host, this->all(9)));
}

TYPED_TEST(AdapterCompaction, TakesAFrameWithoutFeatures) {
  auto host = this->filled(0);
  EXPECT_EQ(TypeParam::compact(Flags(), host), 0u);
  EXPECT_TRUE(this->holds(host, {}));
}

TYPED_TEST(AdapterCompaction, AllDroppedLeavesWhatTheHostBears) {
  auto host = this->filled(9);
  const std::vector<int> left = TypeParam::kNeverEmpty ? this->all(9) : std::vector<int>();
  EXPECT_EQ(TypeParam::compact(Flags(9, 0), host), left.size());
  EXPECT_TRUE(this->holds(host, left));
}

TYPED_TEST(AdapterCompaction, AnArrayOfAnotherSizeIsNamedAndNothingChanges) {
  constexpr std::size_t count =
      std::tuple_size_v<decltype(TypeParam::arrays(std::declval<typename TypeParam::template Host<Plain>&>()))>;
  for (std::size_t wrong = 0; wrong < count; ++wrong) {
    for (const std::uint8_t flag : {std::uint8_t{0}, std::uint8_t{1}}) {  // a frame of ORB-SLAM is left alone by all 0
      auto host = this->filled(9);
      std::size_t position = 0;
      const auto resize_one = [&](auto& array) {
        if (position++ == wrong) look_alikes::fill(array, 8);
      };
      std::apply([&](auto&... array) { (resize_one(array), ...); }, TypeParam::arrays(host));
      try {
        Flags keep(9, flag);
        TypeParam::compact(keep, host);
        FAIL() << "array " << wrong << " has 8 entries";
      } catch (const stillpoint::Error& error) {
        EXPECT_NE(std::string(error.what()).find(" has 8 entries, expected one for each of the 9 keep flags"),
                  std::string::npos)
            << error.what();
      }
      position = 0;
      const auto expect_unchanged = [&](auto& array) {
        EXPECT_TRUE(look_alikes::holds(array, this->all(position++ == wrong ? 8 : 9)));
      };
      std::apply([&](auto&... array) { (expect_unchanged(array), ...); }, TypeParam::arrays(host));
    }
  }
}

TYPED_TEST(AdapterCompaction, MovesEachEntryAtMostOnce) {
  constexpr int count = 10000;
  typename TypeParam::template Host<Counted> host;
  const auto arrays = TypeParam::arrays(host);
  look_alikes::fill_all(arrays, count);
  Flags keep(count, 1);
  keep[0] = 0;  // erasing one by one would move nearly all of them, for each that is dropped
  for (std::size_t i = 1; i < keep.size(); i += 2) keep[i] = 0;
  Counter::moves = 0;
  EXPECT_EQ(TypeParam::compact(keep, host), 4999u);  // the even indices but the first
  EXPECT_LE(Counter::moves, 4999u * std::tuple_size_v<decltype(arrays)>);
  EXPECT_GE(Counter::moves, 4999u) << "the counter is at work";
}

}  // namespace
}  // namespace compaction_conformance_test
