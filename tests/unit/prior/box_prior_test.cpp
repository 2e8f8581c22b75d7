// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/prior/box_prior.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint::box_prior_test {
namespace {

static_assert(is_prior<BoxPrior>::value && is_prior<NoPrior>::value);
struct Mute {};
static_assert(!is_prior<Mute>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(BoxPrior, HandsDetectionsOnInTheirOrder) {
  BoxPrior prior;
  prior.detections = {{{1, 2, 3, 4}, Mobility::dynamic, 0.9f}, {{5, 6, 7, 8}, Mobility::fixed, 0.1f}};
  Regions regions;
  regions.detections.resize(5);  // of the frame before
  prior.regions(FrameView(), regions);
  ASSERT_EQ(regions.detections.size(), 2u);
  EXPECT_EQ(regions.detections[0].box.x, 1);
  EXPECT_EQ(regions.detections[0].mobility, Mobility::dynamic);
  EXPECT_EQ(regions.detections[1].box.height, 8);
  EXPECT_EQ(regions.detections[1].confidence, 0.1f);
  EXPECT_EQ(prior.detections.size(), 2u) << "they hold until the host writes again";
}

TEST(BoxPrior, LeavesOutBoxesThatAreNone) {
  BoxPrior prior;
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    prior.detections.push_back({{bad, 2, 3, 4}, Mobility::dynamic, 1});
    prior.detections.push_back({{1, bad, 3, 4}, Mobility::dynamic, 1});
    prior.detections.push_back({{1, 2, bad, 4}, Mobility::dynamic, 1});
    prior.detections.push_back({{1, 2, 3, bad}, Mobility::dynamic, 1});
  }
  prior.detections.push_back({{1, 2, 0, 4}, Mobility::dynamic, 1});
  prior.detections.push_back({{1, 2, 3, -4}, Mobility::dynamic, 1});
  prior.detections.push_back({{-10, -20, 30, 40}, Mobility::dynamic, 1});  // partly outside the image: a box
  Regions regions;
  prior.regions(FrameView(), regions);
  ASSERT_EQ(regions.detections.size(), 1u);
  EXPECT_EQ(regions.detections[0].box.width, 30);
}

TEST(BoxPrior, LeavesOutMasksOfTheWrongSize) {
  BoxPrior prior;
  const auto with_mask = [&](BoxMask mask) {
    prior.detections.push_back({{1, 2, 3, 4}, Mobility::dynamic, 1});
    prior.detections.back().mask = std::make_shared<const BoxMask>(std::move(mask));
  };
  with_mask({2, 3, std::vector<std::uint8_t>(5)});
  with_mask({0, 0, {}});
  with_mask({-1, -1, {1}});
  with_mask({2, 3, std::vector<std::uint8_t>(6, 1)});
  Regions regions;
  prior.regions(FrameView(), regions);
  ASSERT_EQ(regions.detections.size(), 1u);
  EXPECT_EQ(regions.detections[0].mask->inside.size(), 6u);
}

TEST(BoxPrior, LeavesOutWhatTheDetectorDoubts) {
  BoxPrior prior;
  prior.options.lowest_confidence = 0.5f;
  for (const float confidence : {0.49f, 0.5f, 0.51f, kNaN})
    prior.detections.push_back({{1, 2, 3, 4}, Mobility::dynamic, confidence});
  Regions regions;
  prior.regions(FrameView(), regions);
  ASSERT_EQ(regions.detections.size(), 2u);
  EXPECT_EQ(regions.detections[0].confidence, 0.5f);
  EXPECT_EQ(regions.detections[1].confidence, 0.51f);
}

TEST(NoPrior, ForgetsTheFrameBefore) {
  Regions regions;
  regions.detections.resize(2);
  NoPrior{}.regions(FrameView(), regions);
  EXPECT_TRUE(regions.detections.empty());
}

}  // namespace
}  // namespace stillpoint::box_prior_test
