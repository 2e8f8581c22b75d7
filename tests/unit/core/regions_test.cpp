// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace stillpoint::regions_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Box kBox{10, 20, 30, 40};  // x 10 to 40, y 20 to 60

Regions located(std::vector<Detection> detections, const std::vector<Vector2f>& pixels) {
  Regions regions;
  regions.detections = std::move(detections);
  regions.locate(pixels);
  return regions;
}

TEST(Box, HoldsItsOutline) {
  EXPECT_TRUE(kBox.contains({25, 40}));
  EXPECT_TRUE(kBox.contains({10, 20}) && kBox.contains({40, 60}));
  EXPECT_FALSE(kBox.contains({9.9f, 40}) || kBox.contains({40.1f, 40}));
  EXPECT_FALSE(kBox.contains({25, 19.9f}) || kBox.contains({25, 60.1f}));
  EXPECT_FALSE(kBox.contains({kNaN, 40}) || kBox.contains({25, kNaN}));
}

TEST(Box, EdgeDistanceInsideAndOutside) {
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({12, 40}), 2.0f);   // left 2, right 28, top 20, bottom 20
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({25, 57}), 3.0f);   // bottom
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({25, 40}), 15.0f);  // the middle
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({10, 40}), 0.0f);   // on the outline
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({3, 40}), 7.0f);    // to the left
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({25, 65}), 5.0f);   // below
  EXPECT_FLOAT_EQ(kBox.edge_distance_px({43, 64}), 5.0f);   // beyond the corner: 3 and 4
}

TEST(Detection, HoldsWhatItsMaskCovers) {
  Detection detection{kBox, Mobility::dynamic};
  // Two columns of 15 px, four rows of 10 px; the thing is the right column of the second row: x 25 to 40, y 30 to 40.
  detection.mask = std::make_shared<const BoxMask>(BoxMask{2, 4, {0, 0, 0, 1, 0, 0, 0, 0}});
  EXPECT_TRUE(detection.holds({25, 30}, 0));
  EXPECT_TRUE(detection.holds({40, 39.9f}, 0));
  EXPECT_FALSE(detection.holds({24.9f, 35}, 0));
  EXPECT_FALSE(detection.holds({30, 29.9f}, 0));
  EXPECT_FALSE(detection.holds({30, 40}, 0));
  EXPECT_FALSE(detection.holds({41, 35}, 0));
  // The mask goes with its box, and grows with it.
  detection.box = {110, 20, 60, 80};
  EXPECT_TRUE(detection.holds({140, 40}, 0));
  EXPECT_FALSE(detection.holds({30, 35}, 0));
}

TEST(Regions, OverlappingStaticAndDynamicBoxesBothHold) {
  const Detection table{{0, 0, 100, 100}, Mobility::fixed, 1.0f};
  const Detection person{{50, 0, 100, 100}, Mobility::dynamic, 1.0f};
  const Detection chair{{60, 40, 20, 20}, Mobility::movable, 1.0f};
  const Regions regions = located({table, person, chair}, {{20, 50}, {70, 50}, {130, 50}, {200, 50}});

  const Membership& in_table = regions.of_feature[0];
  EXPECT_TRUE(in_table.in_fixed && !in_table.in_dynamic && !in_table.in_movable);
  EXPECT_EQ(in_table.dynamic_region, Membership::kNone);
  EXPECT_FLOAT_EQ(in_table.edge_distance_px, 20.0f);

  const Membership& in_all = regions.of_feature[1];
  EXPECT_TRUE(in_all.in_fixed && in_all.in_dynamic && in_all.in_movable);
  EXPECT_EQ(in_all.dynamic_region, 1);
  EXPECT_FLOAT_EQ(in_all.edge_distance_px, 20.0f);  // the person's left edge; the chair's, 10, does not count

  EXPECT_TRUE(regions.of_feature[2].in_dynamic && !regions.of_feature[2].in_fixed);
  const Membership& outside = regions.of_feature[3];
  EXPECT_FALSE(outside.in_fixed || outside.in_dynamic || outside.in_movable);
  EXPECT_FLOAT_EQ(outside.edge_distance_px, 50.0f);  // to the person's right edge at 150
}

TEST(Regions, TheSmallestDynamicRegionOwnsTheFeature) {
  const Detection crowd{{0, 0, 200, 200}, Mobility::dynamic, 1.0f};
  const Detection child{{40, 40, 20, 40}, Mobility::dynamic, 1.0f};
  const Detection adult{{30, 20, 60, 120}, Mobility::dynamic, 1.0f};
  const std::vector<Vector2f> pixels = {{50, 50}, {80, 50}, {150, 150}};
  const Regions regions = located({crowd, child, adult}, pixels);
  EXPECT_EQ(regions.of_feature[0].dynamic_region, 1);
  EXPECT_EQ(regions.of_feature[1].dynamic_region, 2);
  EXPECT_EQ(regions.of_feature[2].dynamic_region, 0);
  const Regions other_order = located({adult, child, crowd}, pixels);
  EXPECT_EQ(other_order.of_feature[0].dynamic_region, 1);
  EXPECT_EQ(other_order.of_feature[2].dynamic_region, 2);
  EXPECT_EQ(located({child, child}, pixels).of_feature[0].dynamic_region, 0) << "of two alike the first";
}

// Raw output of a network without a threshold: more boxes than 16 bits count, each smaller than the last.
TEST(Regions, MayBeMoreThanSixteenBitsCount) {
  std::vector<Detection> many;
  for (int k = 0; k < 33000; ++k)
    many.push_back({{0, 0, 100.0f - 0.001f * static_cast<float>(k), 100}, Mobility::dynamic});
  EXPECT_EQ(located(many, {{50, 50}}).of_feature[0].dynamic_region, 32999);
}

TEST(Regions, NothingHoldsWhatIsNoPixel) {
  const Regions regions = located({{kBox, Mobility::dynamic, 1.0f}, {kBox, Mobility::fixed, 1.0f}},
                                  {{kNaN, 40}, {kNaN, kNaN}, {kInfinity, 40}});
  for (const Membership& feature : regions.of_feature) {
    EXPECT_FALSE(feature.in_dynamic || feature.in_fixed);
    EXPECT_EQ(feature.edge_distance_px, kInfinity);
  }
}

TEST(Regions, MovableAndUnknownBoxesHaveNoEdge) {
  const Regions regions = located({{kBox, Mobility::movable, 1.0f}, {kBox, Mobility::unknown, 1.0f}}, {{12, 40}});
  EXPECT_TRUE(regions.of_feature[0].in_movable);
  EXPECT_FALSE(regions.of_feature[0].in_fixed || regions.of_feature[0].in_dynamic);
  EXPECT_EQ(regions.of_feature[0].edge_distance_px, kInfinity);
}

TEST(Regions, LocateForgetsTheFrameBefore) {
  Regions regions = located({{kBox, Mobility::dynamic, 1.0f}}, {{25, 40}, {25, 41}});
  ASSERT_TRUE(regions.of_feature[0].in_dynamic);
  regions.detections.clear();
  const std::vector<Vector2f> pixels = {{25, 40}};
  regions.locate(pixels);
  ASSERT_EQ(regions.of_feature.size(), 1u);
  EXPECT_FALSE(regions.of_feature[0].in_dynamic);
}

}  // namespace
}  // namespace stillpoint::regions_test
